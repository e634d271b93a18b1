#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::terrain {

/// A rectangle of ground, metres.
struct GroundArea {
    double x = 0.0;
    double z = 0.0;
    double width = 1.0;  ///< Along x.
    double depth = 1.0;  ///< Along z.
};

/// Control points of a patch: a triangle (0, 1, 2), counter-clockwise from above, and the corners
/// opposite its edges in the patches beyond them: 3 beyond edge (1, 2), 4 beyond (0, 1), 5 beyond
/// (0, 2). At the rim the triangle's own opposite corner stands there again.
using LatticePatch = std::array<std::uint32_t, 6>;

/// An isometric lattice (`rocks-and-deformer.md` C.10).
struct Lattice {
    std::vector<glm::vec2> positions;  ///< x and z, metres.
    std::vector<LatticePatch> patches;
    double step = 1.0;  ///< Edge of a triangle, metres.
};

/// Cover an area with equilateral triangles: rows sqrt(3)/2 steps apart, every other one moved by
/// half a step. Corners beyond the area are drawn onto its rim, so that the rim is straight.
/// @param columns  Steps along x, 1 to 4096.
/// @throw InvalidOption  columns out of range, or more than 2^28 corners.
/// @throw InvalidInput   an area without size.
Lattice make_lattice(const GroundArea& area, int columns);

}  // namespace scree::terrain
