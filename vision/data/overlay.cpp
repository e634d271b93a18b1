#include "vision/data/overlay.h"

#include "base/error.h"
#include "base/parallel.h"
#include "vision/data/rocks_json.h"
#include "vision/data/strokes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/common.hpp>

namespace scree::vision {
namespace {

constexpr double kPointSpacing = 2;  // px along an outline, about
constexpr double kPixelsPerWidth = 600;
constexpr float kCasing = 1.5F;             // px of dark on both sides of a line together
constexpr double kGoldenAngle = 137.50776;  // degrees; successive hues lie far apart

// Red, orange, yellow, green, turquoise at confidence 0, 1/4, 1/2, 3/4 and 1.
constexpr std::array<glm::dvec3, 5> kRamp = {
    {{240, 45, 45}, {255, 135, 35}, {255, 225, 55}, {120, 235, 75}, {40, 240, 225}}};

glm::dvec3 confidence_colour(double confidence) {
    const double at = std::clamp(confidence, 0.0, 1.0) * (kRamp.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(at), kRamp.size() - 2);
    return glm::mix(kRamp[low], kRamp[low + 1], at - static_cast<double>(low));
}

glm::dvec3 hue_colour(std::size_t rock) {
    const double hue = std::fmod(kGoldenAngle * static_cast<double>(rock), 360.0) / 60.0;
    const auto channel = [&](double shift) {
        const double distance = std::abs(std::fmod(hue + shift, 6.0) - 3.0);
        return 60.0 + 195.0 * std::clamp(distance - 1.0, 0.0, 1.0);
    };
    return {channel(0.0), channel(4.0), channel(2.0)};
}

std::vector<glm::vec2> outline_points(const Outline& outline) {
    const double length = std::sqrt(4.0 * 3.14159265 * outline_area(outline));
    constexpr std::array<int, 8> kSteps = {1, 2, 3, 4, 6, 9, 12, 18};
    int step = 1;
    for (const int candidate : kSteps)
        step = length / kRadii * candidate <= kPointSpacing ? candidate : step;
    std::vector<glm::vec2> points;
    for (int k = 0; k < kRadii; k += step)
        points.emplace_back(border_point(outline, k));
    return points;
}

}  // namespace

Photo draw_overlay(const Photo& photo, const RockSet& set, const OverlayOptions& options) {
    check(options);
    check_rock_set(set, "the set of rocks");
    if (photo.width() != set.width || photo.height() != set.height)
        fail<InvalidInput>("the photograph has ", photo.width(), " x ", photo.height(),
                           " pixels, its rocks were found on ", set.width, " x ", set.height);
    const double side = std::max(photo.width(), photo.height());
    const auto width = static_cast<float>(
        options.line_width > 0 ? options.line_width : 1 + std::lround(side / kPixelsPerWidth));
    Photo out = photo;
    const auto kept = static_cast<unsigned>(std::lround(256.0 * (1.0 - options.dimming)));
    parallel_for_each_index(0, static_cast<std::size_t>(out.height()), 64, [&](std::size_t y) {
        std::uint8_t* bytes = &out.row(static_cast<int>(y))->x;
        for (int i = 0; i < 3 * out.width(); ++i)
            bytes[i] = static_cast<std::uint8_t>(bytes[i] * kept >> 8);
    });
    std::vector<Stroke> strokes(set.rocks.size());
    parallel_for_each_index(0, strokes.size(), 32, [&](std::size_t i) {
        strokes[i].points = outline_points(set.rocks[i].outline);
    });
    // All casings first, so that none covers a neighbour's colour.
    draw_strokes(out, strokes, width + kCasing);
    for (std::size_t i = 0; i < strokes.size(); ++i)
        strokes[i].colour =
            glm::u8vec3(options.colour == OutlineColour::Hue
                            ? hue_colour(i)
                            : confidence_colour(double{set.rocks[i].outline.confidence}));
    draw_strokes(out, strokes, width);
    return out;
}

}  // namespace scree::vision
