#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace scree::vision {

/// What a piece of ground is, as a photograph from above shows it.
enum class GroundClass {
    Sand,     ///< Grains too small to be seen one by one.
    Mud,      ///< Mud and bare soil: smooth, clods, cracks.
    Pebbles,  ///< Stones that are seen one by one.
    Rock,     ///< Surfaces of stone larger than the window of the features.
    Grass,
};
inline constexpr std::size_t kGroundClasses = 5;
inline constexpr std::array<std::string_view, kGroundClasses> kGroundClassNames = {
    "sand", "mud", "pebbles", "rock", "grass"};

}  // namespace scree::vision
