#pragma once

#include "vision/classical/region_hierarchy.h"

#include <limits>
#include <vector>

namespace scree::vision {

/// Tells in one comparison whether a pixel belongs to a region of a hierarchy.
///
/// Basins are numbered so that every region holds a run of consecutive numbers.
class RegionIndex {
public:
    explicit RegionIndex(const RegionHierarchy& hierarchy);

    int width() const { return order_.width(); }
    int height() const { return order_.height(); }

    /// Whether pixel (x, y) belongs to the region. @pre It lies in the picture.
    bool holds(int region, int x, int y) const {
        const Run& run = runs_[static_cast<std::size_t>(region)];
        const std::int32_t at = order_(x, y);
        return at >= run.first && at < run.last;
    }
    /// Pixels [x0, x1) x [y0, y1) that a region lies within.
    struct Box {
        int x0 = std::numeric_limits<int>::max();
        int y0 = std::numeric_limits<int>::max();
        int x1 = 0;
        int y1 = 0;
    };
    const Box& box(int region) const { return boxes_[static_cast<std::size_t>(region)]; }

    /// Whether pixel (x, y) belongs to no region at all. @pre It lies in the picture.
    bool is_open(int x, int y) const { return order_(x, y) == kNoBasin; }

private:
    struct Run {
        std::int32_t first = 0;
        std::int32_t last = 0;
    };
    Raster<std::int32_t> order_;
    std::vector<Run> runs_;
    std::vector<Box> boxes_;
};

}  // namespace scree::vision
