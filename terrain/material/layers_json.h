#pragma once

#include "terrain/material/material_layers.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scree::terrain {

inline constexpr std::size_t kMaxLayers = 64;

/// One layer of a stack, before anything mixes.
struct LayerSpec {
    double thickness_m = 1.0;
    std::optional<int> material;  ///< Id of what it is of; none: as `map`, or as the uppermost.
    std::filesystem::path map;    ///< A description map of the same size; empty: none.
};

/// What lies below a map, uppermost layer first; that one is the map itself.
struct LayerStack {
    std::vector<LayerSpec> layers;
    double surface_depth_m = 0.0;  ///< What the deformer sees mixed; at least a layer's thickness.
};

/// Read a stack from JSON (docs/description-maps.md); materials are named by name or by id.
/// @param folder  What paths are relative to.
/// @throw InvalidInput  names `source` and the JSON path.
LayerStack layers_from_json(std::string_view text, const std::string& source,
                            const std::vector<Material>& materials,
                            const std::filesystem::path& folder);
/// @throw IoError, InvalidInput
LayerStack read_layers(const std::filesystem::path& path, const std::vector<Material>& materials);

/// The layers of a map by a stack.
/// @throw IoError, InvalidInput  as layers_of_map(); a layer's own map cannot be read, has another
///                               size, or holds an id that has no material in the table.
MaterialLayers make_layers(const DescriptionMap& map, const LayerStack& stack);

}  // namespace scree::terrain
