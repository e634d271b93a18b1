#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

namespace scree::terrain {

/// A box divided into equal cells; what lies outside counts to the nearest cell.
struct PointGrid {
    glm::vec3 origin{0.0F};
    float per_metre = 1.0F;  ///< One over the edge of a cell.
    glm::ivec3 size{1};

    glm::ivec3 cell_of(const glm::vec3& point) const {
        const glm::vec3 scaled = (point - origin) * per_metre;
        const glm::vec3 last = glm::vec3(size - 1);
        return glm::ivec3(glm::min(glm::max(glm::floor(scaled), glm::vec3(0.0F)), last));
    }
    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size.y) +
                static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(size.x) +
               static_cast<std::size_t>(x);
    }
    std::size_t n_cells() const {
        return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
               static_cast<std::size_t>(size.z);
    }
};

/// Cells of `edge` over a box, or larger ones if there would be more than `most`.
/// @pre  Finite, low <= high, edge > 0.
PointGrid make_cell_grid(const glm::vec3& low, const glm::vec3& high, float edge, std::size_t most);

/// Points sorted by the cell they lie in, in flat arrays; within a cell by their index.
class PointCells {
public:
    /// @pre  Points finite, edge > 0.
    PointCells(std::span<const glm::vec3> points, float edge);

    std::size_t size() const { return points_.size(); }
    /// The k-th point of the sorted order, and its index in the order given.
    const glm::vec3& sorted(std::size_t k) const { return points_[k]; }
    std::uint32_t index_of(std::size_t k) const { return order_[k]; }

    /// Call `visit(first, last)` for runs of the sorted order that together hold every point within
    /// `reach` of `centre`, and others.
    template <class Visit>
    void runs_near(const glm::vec3& centre, float reach, Visit&& visit) const {
        if (points_.empty())
            return;
        const glm::ivec3 low = grid_.cell_of(centre - reach);
        const glm::ivec3 high = grid_.cell_of(centre + reach);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y) {
                const std::uint32_t first = starts_[grid_.index(low.x, y, z)];
                const std::uint32_t last = starts_[grid_.index(high.x, y, z) + 1];
                if (first != last)
                    visit(first, last);
            }
    }

    /// Squared distance to the nearest point closer than `reach`; infinite if there is none.
    float nearest_squared(const glm::vec3& centre, float reach) const {
        float best = reach * reach;
        bool found = false;
        if (points_.empty() || glm::any(glm::lessThan(centre + 1.00001F * reach, low_)) ||
            glm::any(glm::greaterThan(centre - 1.00001F * reach, high_)))
            return std::numeric_limits<float>::infinity();
        // The little more keeps rounding from losing points on the rim.
        runs_near(centre, reach * 1.00001F, [&](std::uint32_t first, std::uint32_t last) {
            for (std::uint32_t k = first; k < last; ++k) {
                const glm::vec3 d = points_[k] - centre;
                const float squared = glm::dot(d, d);
                found = found || squared < best;
                best = std::min(best, squared);
            }
        });
        return found ? best : std::numeric_limits<float>::infinity();
    }

private:
    PointGrid grid_;
    glm::vec3 low_{0.0F}, high_{0.0F};
    std::vector<glm::vec3> points_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> starts_;  ///< Of each cell, and one past the last.
};

}  // namespace scree::terrain
