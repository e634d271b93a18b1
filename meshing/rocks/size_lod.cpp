#include "meshing/rocks/size_lod.h"

#include "base/error.h"

#include <cmath>

namespace scree::meshing {

int segments_for_size(int largest, double share, int smallest) {
    if (smallest < kFewestSegments)
        fail<InvalidOption>("smallest is ", smallest, ", must be at least ", kFewestSegments);
    if (largest < smallest)
        fail<InvalidOption>("largest is ", largest, ", must be at least ", smallest);
    if (!(share >= 0.0 && share <= 1.0))
        fail<InvalidOption>("share is ", share, ", must be in [0, 1]");
    return static_cast<int>(std::floor((largest - smallest) * share)) + smallest;  // (3.13)
}

double segment_share(int largest, double share) {
    return static_cast<double>(segments_for_size(largest, share)) / largest;
}

int rings_for_segments(int segments) {
    if (segments < kFewestSegments)
        fail<InvalidOption>("segments is ", segments, ", must be at least ", kFewestSegments);
    return segments / 2 + 1;
}

}  // namespace scree::meshing
