#pragma once

#include "terrain/grid/heightfield.h"
#include "terrain/material/description_map.h"
#include "terrain/scene/scene.h"

namespace scree::terrain {

/// Heights of a scene's ground: its picture or a plane at 0, plus its shapes.
/// @throw IoError, InvalidInput  the picture cannot be read, is larger than kMaxGroundSide along a
///                               side or holds no numbers; names scene and JSON path.
Heightfield build_heights(const Scene& scene);

/// What lies where: the scene's map, or its regions painted over its first material, one cell of
/// the map a cell of the ground.
/// @throw IoError, InvalidInput  the map cannot be read or breaks check_map().
DescriptionMap build_map(const Scene& scene, const Heightfield& heights);

}  // namespace scree::terrain
