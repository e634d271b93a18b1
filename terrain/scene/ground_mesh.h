#pragma once

#include "base/raster.h"
#include "meshing/mesh/tri_mesh.h"
#include "terrain/grid/heightfield.h"
#include "terrain/material/description_map.h"
#include "terrain/view/material_look.h"

#include <vector>

namespace scree::terrain {

/// A surface through heights, with normals and texture coordinates over the whole ground.
///
/// At most `most_side` vertices along a side, evenly spread from the first cell centre to the last;
/// of a finer ground the heights are interpolated there, so ruts keep their depth but lose what is
/// thinner than the vertices' distance.
/// @throw InvalidInput  the field is none, or most_side is below 2.
meshing::TriMesh ground_mesh(const Heightfield& field, int most_side);

/// Colours of the ground as one picture from above, `side` pixels along the longer side: every
/// pixel shows its cell's material, repeated by its size in metres.
Photo ground_picture(const Heightfield& field, const DescriptionMap& map,
                     const std::vector<MaterialLook>& looks, int side);

}  // namespace scree::terrain
