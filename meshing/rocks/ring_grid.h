#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace scree::meshing {

/// How the vertices of a surface of rings and segments are shared.
enum class RingLayout {
    Shared,   ///< One vertex a point: a single vertex at each pole, no seam.
    Seamed,   ///< First column repeated at the end, a pole vertex per segment: for texture
              ///< coordinates that wrap round.
    Sheared,  ///< The source's index buffer: full rings at the poles and quads sheared by one
              ///< column, so that some triangles have no area.
};

/// A closed surface made of rings stacked from the south pole (ring 0) to the north pole (ring
/// `rings`), each cut into `segments` (`rocks-and-deformer.md` A.13 and A.14).
///
/// Vertices are numbered ring by ring, columns by growing azimuth.
struct RingGrid {
    int segments = 30;  ///< At least 3.
    int rings = 16;     ///< At least 2.
    RingLayout layout = RingLayout::Shared;
};

/// Throw InvalidOption unless there are 3 to 4096 segments and 2 to 4096 rings.
void check_grid(const RingGrid& grid);

/// Vertices in one ring.
int columns_of(const RingGrid& grid, int ring);

/// Vertices of the whole grid.
std::size_t vertex_count(const RingGrid& grid);

/// Triangles, counter-clockwise seen from outside where azimuth grows from +x towards +z and
/// rings climb along +y. Only RingLayout::Sheared has degenerate ones.
std::vector<glm::uvec3> ring_triangles(const RingGrid& grid);

}  // namespace scree::meshing
