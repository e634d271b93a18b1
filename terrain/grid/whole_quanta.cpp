#include "terrain/grid/whole_quanta.h"

#include "base/error.h"

#include <cmath>

namespace scree::terrain {

void round_to_quanta(FloatRaster& displacement, float quantum) {
    const double unit = quantum;
    double carried = 0.0;
    for (float& value : displacement) {
        if (value == 0.0F)
            continue;
        const double wanted = double{value} + carried;
        const double rounded = std::round(wanted / unit) * unit;
        carried = wanted - rounded;
        value = static_cast<float>(rounded);
    }
}

void check_displacement(const FloatRaster& displacement, int width, int height) {
    constexpr float kGreatest = 1e9F;
    if (displacement.width() != width || displacement.height() != height)
        fail<InvalidInput>("the displacement has ", displacement.width(), " x ",
                           displacement.height(), " cells, the ground ", width, " x ", height);
    for (const float value : displacement)
        if (!(std::fabs(value) <= kGreatest))
            fail<InvalidInput>("the displacement holds ", value, " m, it must be within 1e9 m");
}

}  // namespace scree::terrain
