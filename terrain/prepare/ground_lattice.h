#pragma once

#include "base/raster.h"
#include "meshing/mesh/tri_mesh.h"
#include "terrain/grid/heightfield.h"

#include <cstddef>

#include <glm/vec2.hpp>

namespace scree::terrain {

/// Most places of a lattice.
inline constexpr std::size_t kMostLatticePlaces = std::size_t{1} << 23U;

/// Heights at evenly spread places; where nothing is known of the ground they are NaN.
struct GroundLattice {
    FloatRaster heights;    ///< Metres, +Y up.
    glm::dvec2 first{0.0};  ///< x and z of place (0, 0), metres.
    glm::dvec2 step{1.0};   ///< Between neighbours along x and z, metres.

    glm::dvec2 place(int i, int j) const { return {first.x + i * step.x, first.y + j * step.y}; }
};

/// About `n` places spread over a rectangle, heights unknown; at least 2 along each side.
/// @throw InvalidInput  the rectangle is empty, or more than kMostLatticePlaces.
GroundLattice lattice_over(const glm::dvec2& low, const glm::dvec2& high, std::size_t n);

/// A ground at about `n` places between the centres of its outermost cells, bilinear.
/// @throw InvalidInput  check_heightfield() refuses the field; else as lattice_over().
GroundLattice lattice_of(const Heightfield& field, std::size_t n);

/// Height at a place, bilinear between those known around it; NaN outside and where none is known.
double height_at(const GroundLattice& ground, double x, double z);

/// Two triangles between every four known places and one between three, looking up. Pieces that
/// meet at a point alone get a vertex each; unknown places have none.
/// @throw InvalidInput  no three places side by side are known.
meshing::TriMesh lattice_mesh(const GroundLattice& ground);

}  // namespace scree::terrain
