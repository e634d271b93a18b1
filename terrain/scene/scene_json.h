#pragma once

#include "terrain/json/json_values.h"
#include "terrain/scene/scene.h"

#include <filesystem>
#include <vector>

// For the .cpp files of this folder: parts of a scene from JSON.
namespace scree::terrain {

/// The path of a file, resolved, and noted among the scene's files.
std::filesystem::path file_of(const nlohmann::json& value, const JsonPlace& place,
                              const std::filesystem::path& folder, Scene& scene);

GroundSpec ground_from(const nlohmann::json& value, const JsonPlace& place,
                       const std::filesystem::path& folder, Scene& scene);
MaterialRegion region_from(const nlohmann::json& value, const JsonPlace& place,
                           const std::vector<Material>& materials);
SceneObject object_from(const nlohmann::json& value, const JsonPlace& place,
                        const std::filesystem::path& folder, Scene& scene);
ObjectMotion motion_from(const nlohmann::json& value, const JsonPlace& place);

}  // namespace scree::terrain
