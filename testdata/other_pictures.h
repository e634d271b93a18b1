#pragma once

#include "base/raster.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace scree::test {

/// What people might show a program that looks for gravel.
enum class Subject { Black, White, Noise, Gradient, Clouds, Bricks, Text, Grass, Face, Stripes };
inline constexpr std::string_view kSubjectNames[] = {
    "black", "white", "noise", "gradient", "clouds", "bricks", "text", "grass", "face", "stripes"};
constexpr std::span<const std::string_view> names_of(Subject) {
    return kSubjectNames;
}

/// A picture of something that is no gravel. Same subject, size and seed, same bytes.
/// @throw InvalidOption  a side is not in [32, 4096].
Photo draw_subject(Subject subject, int width, int height, std::uint64_t seed = 1);

}  // namespace scree::test
