#pragma once

#include "terrain/json/strict_json.h"
#include "terrain/material/description_map.h"

#include <vector>

// For .cpp files alone, not installed.
namespace scree::terrain {

/// The id of a material given by its name or by its id. @throw InvalidInput  there is none.
int material_id(const nlohmann::json& value, const JsonPlace& place,
                const std::vector<Material>& materials);

}  // namespace scree::terrain
