#include "vision/thesis/thesis_method.h"

#include "base/error.h"
#include "base/stopwatch.h"
#include "vision/thesis/ray_outline_finder.h"
#include "vision/thesis/sampling.h"
#include "vision/thesis/working_size.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <glm/common.hpp>
#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

const glm::u8vec3 kEdgeColour{255, 255, 255};
const glm::u8vec3 kSampleColour{70, 160, 255};
const glm::u8vec3 kContourColour{255, 220, 0};
const glm::u8vec3 kCentreColour{255, 60, 40};

Photo picture_of(const GreyRaster& grey) {
    Photo photo(grey.width(), grey.height());
    std::transform(grey.begin(), grey.end(), photo.begin(),
                   [](std::uint8_t v) { return glm::u8vec3(v); });
    return photo;
}

Photo picture_of(const FloatRaster& shares) {
    Photo photo(shares.width(), shares.height());
    std::transform(shares.begin(), shares.end(), photo.begin(), [](float v) {
        return glm::u8vec3(static_cast<std::uint8_t>(std::lround(255.0F * v)));
    });
    return photo;
}

Photo picture_of_mask(const Mask& mask) {
    Photo photo(mask.width(), mask.height());
    std::transform(mask.begin(), mask.end(), photo.begin(),
                   [](std::uint8_t on) { return on != 0 ? kEdgeColour : glm::u8vec3(0); });
    return photo;
}

void dot(Photo& photo, glm::dvec2 p, int half, glm::u8vec3 colour) {
    const glm::ivec2 c(glm::floor(p));
    for (int y = c.y - half; y <= c.y + half; ++y)
        for (int x = c.x - half; x <= c.x + half; ++x)
            if (photo.contains(x, y))
                photo(x, y) = colour;
}

Photo picture_of_samples(const Mask& edges, const ThesisOptions& options) {
    Photo photo = picture_of_mask(edges);
    for (const glm::ivec2 node : visiting_order(RayCaster(edges), options))
        photo(node.x, node.y) = kSampleColour;
    return photo;
}

Photo picture_of_contours(const Photo& working, const std::vector<Slice>& slices) {
    Photo photo = working;
    cv::Mat canvas(photo.height(), photo.width(), CV_8UC3, photo.data());
    constexpr int kShift = 4;  // sub-pixel corners, in sixteenths
    for (const Slice& slice : slices) {
        std::vector<cv::Point> corners;
        for (int k = 0; k < kRadii; k += 4) {
            const glm::dvec2 p = 16.0 * (border_point(slice.outline, k) - 0.5);
            corners.emplace_back(static_cast<int>(std::lround(p.x)),
                                 static_cast<int>(std::lround(p.y)));
        }
        const cv::Scalar colour(kContourColour.r, kContourColour.g, kContourColour.b);
        cv::polylines(canvas, corners, true, colour, 1, cv::LINE_AA, kShift);
        dot(photo, slice.outline.centre, 1, kCentreColour);
    }
    return photo;
}

Photo working_picture(const Photo& photo, const ThesisOptions& options) {
    if (photo.empty())
        fail<InvalidInput>("the photograph has no pixels, at least one is needed");
    return scaled_photo(photo,
                        working_size({photo.width(), photo.height()}, options.working_width));
}

bool comes_first(const Rock& a, const Rock& b) {
    const Outline& p = a.outline;
    const Outline& q = b.outline;
    return std::tuple(-p.confidence, p.centre.y, p.centre.x) <
           std::tuple(-q.confidence, q.centre.y, q.centre.x);
}

}  // namespace

ThesisResult find_thesis_rocks(const Photo& photo, const ThesisOptions& options,
                               Progress* progress) {
    check_thesis(options);
    ThesisResult result;
    Stopwatch watch;
    report_progress(progress, "edges", 0.0);
    const Photo working = working_picture(photo, options);
    const EdgeStages edges = detect_thesis_edges(working, options);
    result.edge_seconds = watch.lap();
    report_progress(progress, "outlines", 0.0);
    const SliceSet found = find_slices(edges.linked, options);
    const glm::dvec2 scale(static_cast<double>(photo.width()) / working.width(),
                           static_cast<double>(photo.height()) / working.height());
    for (const Slice& slice : found.slices) {
        Rock rock;
        rock.outline = scaled_outline(slice.outline, scale);
        rock.depth = static_cast<float>(slice.depth * std::min(scale.x, scale.y));
        result.rocks.push_back(rock);
    }
    std::stable_sort(result.rocks.begin(), result.rocks.end(), comes_first);
    result.n_samples = found.n_samples;
    result.n_traced = found.n_traced;
    result.slice_seconds = watch.lap();
    report_progress(progress, "outlines", 1.0);
    return result;
}

std::vector<std::pair<std::string, Photo>> thesis_stages(const Photo& photo,
                                                         const ThesisOptions& options) {
    check_thesis(options);
    const Photo working = working_picture(photo, options);
    const EdgeStages edges = detect_thesis_edges(working, options);
    const SliceSet found = find_slices(edges.linked, options);
    std::vector<std::pair<std::string, Photo>> stages;
    stages.emplace_back("grey", picture_of(edges.grey));
    stages.emplace_back("median", picture_of(edges.median));
    stages.emplace_back("accumulation", picture_of(edges.accumulation));
    stages.emplace_back("thresholded", picture_of_mask(edges.thresholded));
    stages.emplace_back("linked", picture_of_mask(edges.linked));
    stages.emplace_back("samples", picture_of_samples(edges.linked, options));
    stages.emplace_back("contours", picture_of_contours(working, found.slices));
    return stages;
}

}  // namespace scree::vision
