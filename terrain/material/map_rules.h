#pragma once

#include "terrain/grid/heightfield.h"
#include "terrain/material/description_map.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scree::terrain {

/// What a rule asks of a place.
enum class RuleQuantity {
    Height,         ///< Metres.
    Slope,          ///< Degrees.
    Curvature,      ///< Half the Laplacian, 1/m: above zero in hollows, below on ridges.
    WaterDistance,  ///< Metres to the nearest cell at or below the water level.
};
inline constexpr std::size_t kRuleQuantities = 4;
inline constexpr std::array<std::string_view, kRuleQuantities> kRuleQuantityNames = {
    "height", "slope_deg", "curvature", "water_distance"};

/// Closed range of a quantity.
struct RuleRange {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    double soft = 0.0;  ///< Width over which parameters fade across either end; ids never do.
};

/// A material and what it asks for; a place must be in every range.
struct MapRule {
    int id = 0;
    std::array<RuleRange, kRuleQuantities> ranges;  ///< By RuleQuantity.
};

/// Rules in order: the first that fits gives the id.
struct RuleSet {
    std::vector<MapRule> rules;
    int otherwise = 0;                  ///< Id where none fits.
    std::optional<double> water_level;  ///< Metres; needed by rules on water.
};

inline constexpr std::size_t kMaxRules = 1024;

/// Read rules from JSON (docs/description-maps.md); materials are named by name or by id.
/// @throw InvalidInput  names `source` and the JSON path.
RuleSet rules_from_json(std::string_view text, const std::string& source,
                        const std::vector<Material>& materials);
/// @throw IoError, InvalidInput
RuleSet read_rules(const std::filesystem::path& path, const std::vector<Material>& materials);

/// A map of the ground's own cells by rules.
///
/// Where a range is soft, planes are made: every rule has a membership that rises over the soft
/// width, a half at the end of the range; a rule's share is its membership times what the rules
/// before it left, and the parameters are mixed by the shares.
/// @throw InvalidInput  the ground breaks check_heightfield(), an id has no material, a range is
///                      empty or no number, or rules ask for water without a level.
DescriptionMap map_from_rules(const Heightfield& ground, const RuleSet& rules,
                              const std::vector<Material>& materials);

}  // namespace scree::terrain
