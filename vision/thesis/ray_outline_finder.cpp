#include "vision/thesis/ray_outline_finder.h"

#include "base/error.h"
#include "vision/thesis/working_size.h"

#include <algorithm>
#include <tuple>

namespace scree::vision {

RayOutlineFinder::RayOutlineFinder(const ThesisOptions& options) : options_(options) {
    check_thesis(options);
}

std::vector<Outline> RayOutlineFinder::find(const Photo& photo, const EdgeField& field,
                                            Progress* progress) const {
    const FloatRaster& boundary = field.boundary;
    if (boundary.empty())
        fail<InvalidInput>("the edge field has no boundary channel, rays need one");
    if (boundary.width() != photo.width() || boundary.height() != photo.height())
        fail<InvalidInput>("the boundary channel has ", boundary.width(), " x ", boundary.height(),
                           " pixels, the photograph has ", photo.width(), " x ", photo.height());
    Mask mask(boundary.width(), boundary.height());
    std::transform(boundary.begin(), boundary.end(), mask.begin(),
                   [](float b) { return static_cast<std::uint8_t>(b >= 0.5F ? 1 : 0); });
    const glm::ivec2 size{mask.width(), mask.height()};
    const glm::ivec2 working = working_size(size, options_.working_width);
    stop_if_cancelled(progress, "finding outlines");
    const SliceSet found = find_slices(scaled_mask(mask, working), options_);
    return ordered_outlines(found.slices, glm::dvec2(size) / glm::dvec2(working));
}

std::vector<Outline> ordered_outlines(const std::vector<Slice>& slices, glm::dvec2 scale) {
    std::vector<Outline> outlines;
    outlines.reserve(slices.size());
    for (const Slice& slice : slices)
        outlines.push_back(scaled_outline(slice.outline, scale));
    std::stable_sort(outlines.begin(), outlines.end(), [](const Outline& a, const Outline& b) {
        return std::tuple(-a.confidence, a.centre.y, a.centre.x) <
               std::tuple(-b.confidence, b.centre.y, b.centre.x);
    });
    return outlines;
}

}  // namespace scree::vision
