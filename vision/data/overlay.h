#pragma once

#include "base/options.h"
#include "vision/rock_data.h"

#include <span>
#include <string_view>

namespace scree::vision {

/// What the colour of an outline says.
enum class OutlineColour {
    Confidence,  ///< From red (0) by orange and yellow (0.5) to green and turquoise (1).
    Hue,         ///< Nothing; neighbours are told apart.
};

inline constexpr std::string_view kOutlineColourNames[] = {"confidence", "hue"};
constexpr std::span<const std::string_view> names_of(OutlineColour) {
    return kOutlineColourNames;
}

struct OverlayOptions {
    OutlineColour colour = OutlineColour::Confidence;
    int line_width = 0;     ///< px; 0: 2 for pictures of 600 px, more for larger ones.
    double dimming = 0.12;  ///< How far the photograph is darkened beneath, 0 to 1.
};

template <class Visitor>
void describe(OverlayOptions& o, Visitor&& field) {
    field("outline-colour", o.colour, {.help = "what the colour of an outline says"});
    field("line-width", o.line_width,
          {.min = 0, .max = 64, .unit = "px", .help = "width of an outline; 0 chooses by size"});
    field("dimming", o.dimming,
          {.min = 0, .max = 1, .help = "how far the photograph is darkened beneath"});
}

/// The photograph with every rock's outline on it, smoothed, on a dark casing.
/// @throw InvalidOption
/// @throw InvalidInput  the photograph and the set have different sizes, or the set breaks
///                      check_rock_set().
Photo draw_overlay(const Photo& photo, const RockSet& set, const OverlayOptions& options = {});

}  // namespace scree::vision
