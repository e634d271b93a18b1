#include "vision/rock_extraction.h"

#include "base/error.h"
#include "base/stopwatch.h"
#include "vision/classical/candidate_outline_finder.h"
#include "vision/classical/classical_edge_detector.h"
#include "vision/learned/learned_edge_detector.h"
#include "vision/thesis/ray_outline_finder.h"
#include "vision/thesis/thesis_edge_detector.h"
#include "vision/thesis/thesis_method.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace scree::vision {
namespace {

struct Chain {
    std::unique_ptr<EdgeDetector> detector;
    std::unique_ptr<OutlineFinder> finder;
};

Chain make_chain(const ExtractionOptions& options) {
    if (options.method == Method::Thesis) {
        const ThesisOptions thesis = thesis_options(options.reading);
        return {std::make_unique<ThesisEdgeDetector>(thesis),
                std::make_unique<RayOutlineFinder>(thesis)};
    }
    const CandidateOptions candidates{.min_size = options.min_size};
    if (options.method == Method::Learned) {
        return {std::make_unique<LearnedEdgeDetector>(
                    LearnedOptions{},
                    options.model.empty() ? shipped_network() : read_network(options.model)),
                std::make_unique<CandidateOutlineFinder>(candidates, learned_score_model())};
    }
    return {std::make_unique<ClassicalEdgeDetector>(),
            std::make_unique<CandidateOutlineFinder>(candidates)};
}

std::vector<Rock> unrefined(std::vector<Outline> outlines) {
    std::vector<Rock> rocks;
    rocks.reserve(outlines.size());
    for (Outline& outline : outlines) {
        const float depth = *std::min_element(outline.radii.begin(), outline.radii.end());
        rocks.push_back({std::move(outline), depth, 0.0F});
    }
    return rocks;
}

Photo grey_picture(const FloatRaster& channel) {
    Photo picture(channel.width(), channel.height());
    std::transform(channel.begin(), channel.end(), picture.begin(), [](float value) {
        return glm::u8vec3(
            static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F))));
    });
    return picture;
}

void keep_field(RockExtraction& result, const EdgeField& field) {
    const std::pair<const char*, const FloatRaster*> channels[] = {
        {"boundary", &field.boundary}, {"inside", &field.inside}, {"distance", &field.distance}};
    for (const auto& [name, channel] : channels)
        if (!channel->empty())
            result.stages.emplace_back(name, grey_picture(*channel));
}

}  // namespace

RockExtraction extract_rocks(const Photo& photo, const EdgeDetector& detector,
                             const OutlineFinder& finder, const ExtractionOptions& options,
                             Progress* progress) {
    check(options);
    if (photo.empty())
        fail<InvalidInput>("the photograph has no pixels");
    RockExtraction result;
    Stopwatch watch;
    report_progress(progress, "finding edges", 0.0);
    EdgeField field = detector.detect(photo, progress);
    result.edge_seconds = watch.lap();
    report_progress(progress, "finding outlines", 0.0);
    std::vector<Outline> outlines = finder.find(photo, field, progress);
    std::erase_if(outlines,
                  [&](const Outline& o) { return equivalent_diameter(o) < options.min_size; });
    result.outline_seconds = watch.lap();
    report_progress(progress, "refining outlines", 0.0);
    if (options.refine) {
        RefinedRocks refined = refine_outlines(photo, field, std::move(outlines), {}, progress);
        result.rocks.rocks = std::move(refined.rocks);
        result.refinement = refined.report;
    } else {
        result.rocks.rocks = unrefined(std::move(outlines));
    }
    std::erase_if(result.rocks.rocks,
                  [&](const Rock& r) { return equivalent_diameter(r.outline) < options.min_size; });
    result.refine_seconds = watch.lap();
    result.rocks.width = photo.width();
    result.rocks.height = photo.height();
    result.likeness = gravel_likeness(field.boundary, result.rocks.rocks);
    result.rocks.likeness = result.likeness.likeness;
    if (options.keep_stages)
        keep_field(result, field);
    result.boundary = std::move(field.boundary);
    return result;
}

RockExtraction extract_rocks(const Photo& photo, const ExtractionOptions& options,
                             Progress* progress) {
    check(options);
    if (!options.model.empty() && options.method != Method::Learned)
        fail<InvalidOption>("model is ", options.model.string(),
                            ", which only the method learned can use; leave it out or choose that");
    const Chain chain = make_chain(options);
    RockExtraction result = extract_rocks(photo, *chain.detector, *chain.finder, options, progress);
    if (options.keep_stages && options.method == Method::Thesis)
        result.stages = thesis_stages(photo, thesis_options(options.reading));
    result.rocks.method = names_of(options.method)[static_cast<std::size_t>(options.method)];
    return result;
}

}  // namespace scree::vision
