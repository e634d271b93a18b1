#include "vision/classical/region_hierarchy.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

cv::Mat view(FloatRaster& raster) {
    return {raster.height(), raster.width(), CV_32FC1, raster.data()};
}

FloatRaster luma_of(const Photo& photo) {
    FloatRaster luma(photo.width(), photo.height());
    std::transform(photo.begin(), photo.end(), luma.begin(), [](const glm::u8vec3& c) {
        return (0.299F * c.r + 0.587F * c.g + 0.114F * c.b) / 255.0F;
    });
    return luma;
}

}  // namespace

RegionHierarchy region_hierarchy(const Photo& photo, const EdgeField& field,
                                 const HierarchyOptions& options) {
    FloatRaster relief = field.boundary;
    Mask mask(relief.width(), relief.height());
    const auto depth = static_cast<float>(options.depth);
    for (std::size_t i = 0; i < relief.size(); ++i) {
        relief.data()[i] -= depth * field.distance.data()[i];
        mask.data()[i] = field.inside.data()[i] >= static_cast<float>(options.inside) ? 1 : 0;
    }
    if (options.smooth > 0)
        cv::GaussianBlur(view(relief), view(relief), {0, 0}, options.smooth);
    RegionHierarchy result;
    result.basins = find_basins(relief, mask);
    result.tree =
        build_merge_tree(result.basins, field, luma_of(photo), static_cast<float>(options.highest));
    return result;
}

}  // namespace scree::vision
