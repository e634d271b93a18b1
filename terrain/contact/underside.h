#pragma once

#include "base/raster.h"
#include "meshing/mesh/tri_mesh.h"
#include "terrain/grid/cell_window.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace scree::terrain {

/// The cells that objects are looked at through: a ground's extent and the edge of a cell.
struct CellGrid {
    CellWindow extent;
    double cell_size = 1.0;  ///< Metres.
};

/// Height of an object's lowest surface above every cell of a window, seen straight from below.
struct Underside {
    CellWindow window;    ///< The object's shadow on the ground, clipped to it; may be empty.
    FloatRaster heights;  ///< Metres, at the cells' centres; +infinity where there is no surface.
    int covered = 0;      ///< Cells with a surface.
    bool lost = false;    ///< All of it lies over the ground, but over no centre: it is smaller
                          ///< than a cell and leaves no track.
};

/// Depth map of a placed mesh from below (`rocks-and-deformer.md` F.4, the sound form of ADDH).
///
/// The lowest triangle over a cell's centre counts, whichever way it faces: meshes may be open,
/// have holes or hollow undersides. Triangles that stand upright or have no area add nothing. Costs
/// what the mesh and its window cost, whatever the ground's size.
/// @throw InvalidInput  check_mesh() refuses the mesh, the matrix puts a vertex at no finite place,
///                      or the cell size is not positive.
Underside underside_of(const meshing::TriMesh& mesh, const glm::dmat4& world_from_mesh,
                       const CellGrid& grid);

/// The same of a mesh that is known to pass check_mesh(): for one that moves step by step.
Underside underside_of_checked(const meshing::TriMesh& mesh, const glm::dmat4& world_from_mesh,
                               const CellGrid& grid);

/// The same of a sphere, in closed form (`rocks-and-deformer.md` C.9).
/// @throw InvalidInput  the radius is not positive or a number is not finite.
Underside underside_of_sphere(const glm::dvec3& centre, double radius, const CellGrid& grid);

}  // namespace scree::terrain
