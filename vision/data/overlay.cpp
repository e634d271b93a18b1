#include "vision/data/overlay.h"

#include "base/error.h"
#include "base/parallel.h"
#include "vision/data/rocks_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

constexpr int kShift = 4;            // OpenCV takes points in 1/16 px
constexpr double kPointSpacing = 2;  // px along an outline, about
constexpr double kPixelsPerWidth = 600;
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

std::vector<cv::Point> outline_points(const Outline& outline) {
    const double length = std::sqrt(4.0 * 3.14159265 * outline_area(outline));
    constexpr std::array<int, 8> kSteps = {1, 2, 3, 4, 6, 9, 12, 18};
    int step = 1;
    for (const int candidate : kSteps)
        step = length / kRadii * candidate <= kPointSpacing ? candidate : step;
    std::vector<cv::Point> points;
    for (int k = 0; k < kRadii; k += step) {
        // OpenCV's whole coordinates are pixel centres, ours are corners.
        const glm::dvec2 p =
            glm::clamp((border_point(outline, k) - 0.5) * double{1 << kShift}, -3e7, 3e7);
        points.emplace_back(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)));
    }
    return points;
}

void draw_outlines(const std::vector<std::vector<cv::Point>>& shapes,
                   const std::vector<cv::Scalar>& colours, int width, cv::Mat& image) {
    // All casings first, so that none covers a neighbour's colour.
    for (const auto& points : shapes)
        cv::polylines(image, points, true, cv::Scalar(0, 0, 0), width + 1, cv::LINE_AA, kShift);
    for (std::size_t i = 0; i < shapes.size(); ++i)
        cv::polylines(image, shapes[i], true, colours[i], width, cv::LINE_AA, kShift);
}

}  // namespace

Photo draw_overlay(const Photo& photo, const RockSet& set, const OverlayOptions& options) {
    check(options);
    check_rock_set(set, "the set of rocks");
    if (photo.width() != set.width || photo.height() != set.height)
        fail<InvalidInput>("the photograph has ", photo.width(), " x ", photo.height(),
                           " pixels, its rocks were found on ", set.width, " x ", set.height);
    const double side = std::max(photo.width(), photo.height());
    const int width = options.line_width > 0
                          ? options.line_width
                          : std::max(1, static_cast<int>(std::lround(side / kPixelsPerWidth)));
    Photo out = photo;
    const auto kept = static_cast<unsigned>(std::lround(256.0 * (1.0 - options.dimming)));
    parallel_for_each_index(0, static_cast<std::size_t>(out.height()), 64, [&](std::size_t y) {
        std::uint8_t* bytes = &out.row(static_cast<int>(y))->x;
        for (int i = 0; i < 3 * out.width(); ++i)
            bytes[i] = static_cast<std::uint8_t>(bytes[i] * kept >> 8);
    });
    std::vector<std::vector<cv::Point>> shapes(set.rocks.size());
    std::vector<cv::Scalar> colours(set.rocks.size());
    parallel_for_each_index(0, shapes.size(), 32, [&](std::size_t i) {
        shapes[i] = outline_points(set.rocks[i].outline);
        const glm::dvec3 c = options.colour == OutlineColour::Hue
                                 ? hue_colour(i)
                                 : confidence_colour(set.rocks[i].outline.confidence);
        colours[i] = cv::Scalar(c.x, c.y, c.z);
    });
    cv::Mat image(out.height(), out.width(), CV_8UC3, out.data());
    draw_outlines(shapes, colours, width, image);
    return out;
}

}  // namespace scree::vision
