#include "vision/thesis/level_slicing.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <vector>

namespace scree::vision {
namespace {

struct Neighbours {
    int east, west, south, north;
};

Neighbours neighbours_of(const GreyRaster& grey, int x, int y, int offset) {
    const int right = std::min(x + offset, grey.width() - 1);
    const int left = std::max(x - offset, 0);
    const int below = std::min(y + offset, grey.height() - 1);
    const int above = std::max(y - offset, 0);
    return {grey(right, y), grey(left, y), grey(x, below), grey(x, above)};
}

// The one neighbour that decides. For a ratio f(p)/f(q) the least ratio belongs to the brightest q,
// so min and max over ratios become max and min over neighbours.
int deciding(const Neighbours& n, ChangeMode mode) {
    switch (mode) {
        case ChangeMode::Pair:
            return std::max(std::min(n.east, n.west), std::min(n.south, n.north));
        case ChangeMode::All:
            return std::min({n.east, n.west, n.south, n.north});
        default:
            return std::max({n.east, n.west, n.south, n.north});
    }
}

// Levels that fire for a pixel of value p beside a deciding neighbour q, over L.
float share_of_levels(int p, int q, const ThesisOptions& o) {
    const int n_levels = o.levels;
    int firing = 0;
    if (o.change == ChangeMode::Abs)
        firing = q > p ? n_levels * (q - p) / 255 : 0;
    else if (q > p)
        firing = n_levels - n_levels * p / q;  // A.4.2: L - floor(L rho)
    return static_cast<float>(firing) / static_cast<float>(n_levels);
}

// Does level i fire? Multiplied out, so that integers decide: f(p) < (i/L) f(q).
bool level_fires(int p, int q, int level, const ThesisOptions& o) {
    if (o.change == ChangeMode::Abs)
        return level > 0 && level * 255 <= o.levels * (q - p);
    return o.levels * p < level * q;
}

bool pixel_fires(int p, const Neighbours& n, int level, const ThesisOptions& o) {
    const bool east = level_fires(p, n.east, level, o);
    const bool west = level_fires(p, n.west, level, o);
    const bool south = level_fires(p, n.south, level, o);
    const bool north = level_fires(p, n.north, level, o);
    switch (o.change) {
        case ChangeMode::Pair:
            return (east && west) || (south && north);
        case ChangeMode::All:
            return east && west && south && north;
        default:
            return east || west || south || north;
    }
}

}  // namespace

FloatRaster accumulate_changes(const GreyRaster& grey, const ThesisOptions& options) {
    check_thesis(options);
    std::vector<float> table(256U * 256U);
    for (int p = 0; p < 256; ++p)
        for (int q = 0; q < 256; ++q)
            table[static_cast<std::size_t>(p * 256 + q)] = share_of_levels(p, q, options);
    FloatRaster result(grey.width(), grey.height());
    parallel_for_each_index(0, static_cast<std::size_t>(grey.height()), 32, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < grey.width(); ++x) {
            const int q = deciding(neighbours_of(grey, x, y, options.offset), options.change);
            result(x, y) = table[static_cast<std::size_t>(grey(x, y) * 256 + q)];
        }
    });
    return result;
}

FloatRaster accumulate_changes_by_levels(const GreyRaster& grey, const ThesisOptions& options) {
    check_thesis(options);
    FloatRaster result(grey.width(), grey.height());
    for (int y = 0; y < grey.height(); ++y)
        for (int x = 0; x < grey.width(); ++x) {
            const Neighbours around = neighbours_of(grey, x, y, options.offset);
            int firing = 0;
            for (int level = 0; level <= options.levels; ++level)
                firing += pixel_fires(grey(x, y), around, level, options) ? 1 : 0;
            result(x, y) = static_cast<float>(firing) / static_cast<float>(options.levels);
        }
    return result;
}

}  // namespace scree::vision
