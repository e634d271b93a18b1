#pragma once

#include <vector>

namespace scree::vision {

/// A stretch of rows or columns.
struct Span {
    int begin = 0;
    int size = 0;

    int end() const { return begin + size; }
    bool operator==(const Span&) const = default;
};

/// Cut a side of a picture into few stretches of one size that overlap by at least twice the
/// margin; the first begins at 0 and the last ends at `length`.
/// @pre  `length` and `most` are multiples of kNetworkStep; `most` is at least eight margins and
/// eight
///       steps.
/// @post Every begin and size is a multiple of kNetworkStep, no size is over `most`.
std::vector<Span> plan_tiles(int length, int most, int margin);

/// How much of each place a stretch gives, 0 to 1: the weights of all stretches add up to 1
/// everywhere. Where two overlap one hands over to the other evenly, over half of the overlap, in
/// its middle; at the ends of the side a stretch gives all.
std::vector<float> tile_weights(const std::vector<Span>& tiles, std::size_t which);

}  // namespace scree::vision
