#pragma once

#include "base/raster.h"
#include "meshing/gltf/gltf_scene.h"
#include "meshing/rocks/procedural_rock.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace scree::apps {

/// Rocks of successive seeds, row by row on a square about the origin.
struct Collection {
    std::vector<meshing::ProceduralRock> rocks;
    std::vector<glm::vec3> places;  ///< Of their centres, metres.
    float side = 0.0F;              ///< Of the square, metres.
};

/// @pre  At least one rock.
/// @throw InvalidOption
Collection make_collection(const meshing::ProceduralRockOptions& options, int count);

/// A named node a rock.
meshing::GltfScene scene_of(const Collection& all, std::int64_t first_seed);

/// The rocks as clay on their square.
Photo picture_of(const Collection& all);

}  // namespace scree::apps
