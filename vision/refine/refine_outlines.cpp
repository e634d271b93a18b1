#include "vision/refine/refine_outlines.h"

#include "base/error.h"
#include "base/parallel.h"
#include "vision/refine/edge_hits.h"
#include "vision/refine/ellipsoid_fit.h"
#include "vision/refine/shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

constexpr double kBlur = 0.8;        // px, of the maps: the interpolator wants smooth ground
constexpr double kRaySpacing = 3.5;  // px between rays at the outline
constexpr int kLeastRays = 24;
constexpr int kMostRays = 80;
constexpr double kSupportKept = 0.97;  // share of its edge support an outline may lose

void check_channel(const FloatRaster& channel, const char* name, const Photo& photo) {
    if (channel.width() != photo.width() || channel.height() != photo.height())
        fail<InvalidInput>("the ", name, " channel is ", channel.width(), " x ", channel.height(),
                           ", the photograph ", photo.width(), " x ", photo.height());
}

void check_outlines(const std::vector<Outline>& outlines) {
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const Outline& outline = outlines[i];
        const bool placed = std::abs(outline.centre.x) < 1e6 && std::abs(outline.centre.y) < 1e6;
        const bool sized = std::all_of(outline.radii.begin(), outline.radii.end(),
                                       [](float r) { return r > 0.0F && r < 1e6F; });
        if (!placed || !sized)
            fail<InvalidInput>("outline ", i,
                               " has a centre or radius that is no positive number below 1e6 px");
    }
}

FloatRaster blurred(const FloatRaster& channel) {
    FloatRaster result(channel.width(), channel.height());
    if (channel.empty())
        return result;
    // const_cast: OpenCV has no view of constant data; the channel is only read.
    const cv::Mat in(channel.height(), channel.width(), CV_32FC1,
                     const_cast<float*>(channel.data()));
    cv::Mat out(result.height(), result.width(), CV_32FC1, result.data());
    cv::GaussianBlur(in, out, {5, 5}, kBlur, kBlur, cv::BORDER_REPLICATE);
    return result;
}

float least_radius(const Outline& outline) {
    return *std::min_element(outline.radii.begin(), outline.radii.end());
}

// The photograph shows nothing of a rock beyond its edge.
void cut_at_border(const FloatRaster& picture, Outline& outline) {
    const glm::dvec2 c = outline.centre;
    if (!(c.x > 0.0 && c.y > 0.0 && c.x < picture.width() && c.y < picture.height()))
        return;
    for (int k = 0; k < kRadii; ++k) {
        const glm::dvec2 d = border_point(outline, k) - outline.centre;
        double share = 1.0;
        if (d.x > 0.0)
            share = std::min(share, (picture.width() - outline.centre.x) / d.x);
        if (d.x < 0.0)
            share = std::min(share, -outline.centre.x / d.x);
        if (d.y > 0.0)
            share = std::min(share, (picture.height() - outline.centre.y) / d.y);
        if (d.y < 0.0)
            share = std::min(share, -outline.centre.y / d.y);
        float& radius = outline.radii[static_cast<std::size_t>(k)];
        radius = std::max(0.05F, static_cast<float>(share * radius));
    }
}

// True if the new outline stays within the window of the old one, seen from the new centre.
bool stays_near(const Outline& now, const Outline& before, double window) {
    for (int k = 0; k < kRadii; k += 3) {
        const glm::dvec2 arm = border_point(now, k) - before.centre;
        const double length = std::hypot(arm.x, arm.y);
        if (!(std::abs(length - radius_at(before, std::atan2(arm.y, arm.x))) <= 1.5 * window))
            return false;
    }
    return true;
}

struct Refined {
    Rock rock;
    std::size_t iterations = 0;
    bool changed = false;
};

Refined refine_one(const EdgeMaps& maps, const Outline& outline, const RefineOptions& options) {
    const double size = mean_radius(outline);
    const int n_rays = std::clamp(static_cast<int>(2.0 * std::numbers::pi * size / kRaySpacing),
                                  kLeastRays, kMostRays);
    const double window = std::clamp(options.window * size, options.least_window,
                                     std::max(options.least_window, options.most_window));
    Refined result;
    result.rock.outline = outline;
    result.rock.depth = least_radius(outline);
    Outline current = outline;
    EllipsoidFit fit;
    double reach = window;
    for (int pass = 0; pass < options.passes; ++pass, reach = std::max(1.0, 0.5 * reach)) {
        const auto hits = edge_hits(maps, current, n_rays, reach);
        fit = fit_ellipsoid(maps, hits, shape_of(current, harmonics_for(size)), reach, options);
        result.iterations += static_cast<std::size_t>(fit.iterations);
        if (!fit.usable)
            return result;
        sample_shape(fit.shape, current);
    }
    result.rock.uncertainty = static_cast<float>(fit.uncertainty);
    if (!stays_near(current, outline, window) ||
        edge_support(maps, current, n_rays) < kSupportKept * edge_support(maps, outline, n_rays))
        return result;
    if (outline.touches_border)
        cut_at_border(maps.boundary, current);
    result.rock.outline = current;
    result.rock.depth = least_radius(current);
    result.changed = true;
    return result;
}

}  // namespace

RefinedRocks refine_outlines(const Photo& photo, const EdgeField& field,
                             std::vector<Outline> outlines, const RefineOptions& options,
                             const Progress* progress) {
    check(options);
    check_channel(field.boundary, "boundary", photo);
    if (field.boundary.empty())
        fail<InvalidInput>("the boundary channel is empty");
    if (!field.inside.empty())
        check_channel(field.inside, "inside", photo);
    check_outlines(outlines);

    const EdgeMaps maps{blurred(field.boundary), blurred(field.inside)};
    std::vector<Refined> refined(outlines.size());
    parallel_for_each_index(0, outlines.size(), 8, [&](std::size_t i) {
        stop_if_cancelled(progress, "refining outlines");
        refined[i] = refine_one(maps, outlines[i], options);
    });
    RefinedRocks result;
    for (Refined& one : refined) {
        ++(one.changed ? result.report.refined : result.report.unchanged);
        result.report.iterations += one.iterations;
        result.rocks.push_back(one.rock);
    }
    return result;
}

}  // namespace scree::vision
