#include "meshing/rocks/ring_grid.h"

#include "base/error.h"
#include "meshing/rocks/size_lod.h"

#include <cstdint>

namespace scree::meshing {
namespace {

constexpr int kMost = 4096;

bool is_pole(const RingGrid& grid, int ring) {
    return ring == 0 || ring == grid.rings;
}

// Algorithm 3.1 with both loops inclusive; the stride is the segment count, not the ring's length.
std::vector<glm::uvec3> sheared_triangles(const RingGrid& grid) {
    std::vector<glm::uvec3> triangles;
    const auto stride = static_cast<std::uint32_t>(grid.segments);
    triangles.reserve(2U * static_cast<std::size_t>(grid.rings) * (stride + 1));
    std::uint32_t c = 0;
    for (int ring = 0; ring < grid.rings; ++ring) {
        for (int segment = 0; segment <= grid.segments; ++segment, ++c) {
            triangles.emplace_back(c, c + stride, c + stride + 1);
            triangles.emplace_back(c + stride + 1, c + 1, c);
        }
    }
    return triangles;
}

std::vector<glm::uvec3> plain_triangles(const RingGrid& grid) {
    const bool shared = grid.layout == RingLayout::Shared;
    const auto n = static_cast<std::uint32_t>(grid.segments);
    const std::uint32_t width = shared ? n : n + 1;  // of a ring between the poles
    const std::uint32_t pole_width = shared ? 1 : n;
    const auto vertex = [&](int ring, std::uint32_t column) {
        if (ring == 0)
            return shared ? 0 : column;
        const std::uint32_t start = pole_width + static_cast<std::uint32_t>(ring - 1) * width;
        if (ring == grid.rings)
            return shared ? start : start + column;
        return start + (shared && column == n ? 0 : column);
    };
    std::vector<glm::uvec3> triangles;
    triangles.reserve(2U * n * static_cast<std::size_t>(grid.rings - 1));
    for (int ring = 0; ring < grid.rings; ++ring) {
        const bool top = ring + 1 == grid.rings;
        for (std::uint32_t s = 0; s < n; ++s) {
            const std::uint32_t above = vertex(ring + 1, top ? s : s + 1);
            if (!top)
                triangles.emplace_back(vertex(ring, s), vertex(ring + 1, s), above);
            if (ring > 0)
                triangles.emplace_back(vertex(ring, s), above, vertex(ring, s + 1));
        }
    }
    return triangles;
}

}  // namespace

void check_grid(const RingGrid& grid) {
    if (grid.segments < kFewestSegments || grid.segments > kMost)
        fail<InvalidOption>("segments is ", grid.segments, ", must be in [", kFewestSegments, ", ",
                            kMost, "]");
    if (grid.rings < 2 || grid.rings > kMost)
        fail<InvalidOption>("rings is ", grid.rings, ", must be in [2, ", kMost, "]");
}

int columns_of(const RingGrid& grid, int ring) {
    switch (grid.layout) {
        case RingLayout::Shared:
            return is_pole(grid, ring) ? 1 : grid.segments;
        case RingLayout::Seamed:
            return is_pole(grid, ring) ? grid.segments : grid.segments + 1;
        case RingLayout::Sheared:
            break;
    }
    return grid.segments + 1;
}

std::size_t vertex_count(const RingGrid& grid) {
    const auto inner = static_cast<std::size_t>(grid.rings - 1);
    return inner * static_cast<std::size_t>(columns_of(grid, 1)) +
           2U * static_cast<std::size_t>(columns_of(grid, 0));
}

std::vector<glm::uvec3> ring_triangles(const RingGrid& grid) {
    check_grid(grid);
    return grid.layout == RingLayout::Sheared ? sheared_triangles(grid) : plain_triangles(grid);
}

}  // namespace scree::meshing
