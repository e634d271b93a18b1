#include "vision/thesis/working_size.h"

#include "base/parallel.h"
#include "vision/thesis/polygon.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

// Old pixels [first, last] that new pixel i touches.
struct Span {
    int first;
    int last;
};

Span touched(int i, int n_new, int n_old) {
    const auto begin = static_cast<long long>(i) * n_old;
    const auto end = static_cast<long long>(i + 1) * n_old;
    return {static_cast<int>(begin / n_new), static_cast<int>((end - 1) / n_new)};
}

}  // namespace

glm::ivec2 working_size(glm::ivec2 size, int width) {
    if (width == 0)
        return size;
    double factor = static_cast<double>(width) / size.x;
    factor = std::min(factor,
                      std::sqrt(kGreatestWorkingPixels / (static_cast<double>(size.x) * size.y)));
    const auto side = [factor](int n) {
        return std::max(1, static_cast<int>(std::lround(factor * n)));
    };
    return {side(size.x), side(size.y)};
}

Photo scaled_photo(const Photo& photo, glm::ivec2 size) {
    if (size.x == photo.width() && size.y == photo.height())
        return photo;
    Photo result(size.x, size.y);
    const cv::Mat from(photo.height(), photo.width(), CV_8UC3,
                       const_cast<glm::u8vec3*>(photo.data()));
    cv::Mat to(size.y, size.x, CV_8UC3, result.data());
    const bool shrinks = size.x <= photo.width() && size.y <= photo.height();
    cv::resize(from, to, to.size(), 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
    return result;
}

Mask scaled_mask(const Mask& mask, glm::ivec2 size) {
    if (size.x == mask.width() && size.y == mask.height())
        return mask;
    Mask result(size.x, size.y);
    parallel_for_each_index(0, static_cast<std::size_t>(size.y), 16, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        const Span rows = touched(y, size.y, mask.height());
        for (int x = 0; x < size.x; ++x) {
            const Span columns = touched(x, size.x, mask.width());
            for (int v = rows.first; v <= rows.last; ++v)
                for (int u = columns.first; u <= columns.last; ++u)
                    if (mask(u, v) != 0)
                        result(x, y) = 1;
        }
    });
    return result;
}

Outline scaled_outline(const Outline& outline, glm::dvec2 scale) {
    Outline result = outline;
    result.centre = outline.centre * scale;
    if (scale.x == scale.y) {
        for (float& r : result.radii)
            r = static_cast<float>(r * scale.x);
        return result;
    }
    std::vector<glm::dvec2> points;
    for (int k = 0; k < kRadii; ++k)
        points.push_back(border_point(outline, k) * scale);
    if (const auto radii = polygon_radii(points, result.centre))
        result.radii = *radii;
    return result;
}

}  // namespace scree::vision
