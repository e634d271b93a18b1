#include "terrain/fluid/point_cells.h"

#include "base/parallel.h"

namespace scree::terrain {
namespace {

constexpr std::size_t kGrain = 4096;

}  // namespace

PointGrid make_cell_grid(const glm::vec3& low, const glm::vec3& high, float edge,
                         std::size_t most) {
    const glm::dvec3 extent = glm::dvec3(high) - glm::dvec3(low);
    double size = static_cast<double>(edge);
    const auto count = [&](double one) {
        const glm::dvec3 n = glm::floor(extent / one) + 1.0;
        return n.x * n.y * n.z;
    };
    while (count(size) > static_cast<double>(most))
        size *= 1.25;
    PointGrid grid;
    grid.origin = low;
    grid.per_metre = static_cast<float>(1.0 / size);
    grid.size = glm::ivec3(glm::floor(extent / size)) + 1;
    return grid;
}

PointCells::PointCells(std::span<const glm::vec3> points, float edge)
    : points_(points.size()), order_(points.size()) {
    const std::size_t n = points.size();
    if (n == 0) {
        starts_.assign(2, 0);
        return;
    }
    low_ = high_ = points[0];
    for (const glm::vec3& p : points) {
        low_ = glm::min(low_, p);
        high_ = glm::max(high_, p);
    }
    grid_ = make_cell_grid(low_, high_, edge, 65536 + 16 * n);

    std::vector<std::uint32_t> cells(n);
    parallel_for_each_index(0, n, kGrain, [&](std::size_t i) {
        const glm::ivec3 c = grid_.cell_of(points[i]);
        cells[i] = static_cast<std::uint32_t>(grid_.index(c.x, c.y, c.z));
    });
    starts_.assign(grid_.n_cells() + 1, 0);
    for (const std::uint32_t cell : cells)
        ++starts_[cell];
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts_) {
        sum += start;
        start = sum;  // the end of the cell; filling from behind turns it into the start
    }
    for (std::size_t i = n; i-- > 0;)
        order_[--starts_[cells[i]]] = static_cast<std::uint32_t>(i);
    parallel_for_each_index(0, n, kGrain, [&](std::size_t k) { points_[k] = points[order_[k]]; });
}

}  // namespace scree::terrain
