#pragma once

#include "vision/outline.h"
#include "vision/thesis/ray_marching.h"
#include "vision/thesis/thesis_options.h"

#include <optional>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::vision {

/// Hits of all rays from one point, after the outlier filter.
struct RayPolygon {
    enum class Ray : std::uint8_t {
        Retained,  ///< Its hit is a vertex of the contour.
        Repeated,  ///< It hit the same pixel as the ray before: no vertex of its own.
        Outlier,   ///< The turning-angle filter deleted its hit.
        Missing,   ///< It left the picture.
    };
    std::vector<Ray> rays;
    std::vector<glm::dvec2> hits;      ///< Pixel centre per ray; meaningless where missing.
    std::vector<glm::dvec2> retained;  ///< The vertices, in ray order.
    double severity = 0.0;             ///< alpha_T that was accepted.
};

/// One finished equatorial slice, in pixels of the mask.
struct Slice {
    Outline outline;                  ///< Confidence: share of its rays that hit and were retained.
    std::vector<glm::dvec2> contour;  ///< E_C: retained hits and the points that fill gaps.
    float depth = 0.0F;               ///< h_i, px.
    double retained_share = 0.0;      ///< Of the vertices; the rest was filled in.
    double severity = 0.0;            ///< alpha_T of the last pass.
    int n_iterations = 0;             ///< Passes until the centre settled.
};

/// Turns one positional sample into a slice (`rocks-and-deformer.md` A.6 to A.11).
///
/// Pure: the result depends on the mask, the options and the sample alone, so samples may be
/// traced ahead of time and on any thread.
class SliceTracer {
public:
    SliceTracer(const Mask& edges, const ThesisOptions& options);

    const RayCaster& caster() const { return caster_; }

    /// Cast `rays` (or `final_rays`) rays and filter their hits; nothing if too few are left.
    std::optional<RayPolygon> cast_and_filter(glm::dvec2 centre, bool last_pass) const;

    /// The settled centre and the number of passes; nothing if the sample must be abandoned.
    struct Centre {
        glm::dvec2 point{0.0};
        int n_iterations = 0;
    };
    std::optional<Centre> settle(glm::dvec2 sample) const;

    /// The whole chain for one sample; nothing if it is rejected.
    std::optional<Slice> trace(glm::dvec2 sample) const;

private:
    std::optional<Slice> finish(const Centre& centre) const;
    bool passes_quality(const Slice& slice) const;

    ThesisOptions options_;
    RayCaster caster_;
    std::vector<glm::dvec2> directions_;
    std::vector<glm::dvec2> final_directions_;
};

}  // namespace scree::vision
