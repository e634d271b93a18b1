#include "vision/thesis/ray_marching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

constexpr double kLeapMargin = 1e-6;  // keeps a leap inside ground known to be empty

Raster<std::uint8_t> chessboard_distance(const Mask& edges) {
    Raster<std::uint8_t> result(edges.width(), edges.height(), 255);
    if (edges.empty())
        return result;
    cv::Mat empty(edges.height(), edges.width(), CV_8U);
    std::transform(edges.begin(), edges.end(), empty.data,
                   [](std::uint8_t e) { return static_cast<std::uint8_t>(e == 0 ? 1 : 0); });
    cv::Mat distance;
    cv::distanceTransform(empty, distance, cv::DIST_C, 3);
    std::transform(distance.ptr<float>(), distance.ptr<float>() + result.size(), result.begin(),
                   [](float d) { return static_cast<std::uint8_t>(std::min(d, 255.0F)); });
    return result;
}

// Ray parameter of the next pixel border along one axis.
double next_border(double origin, double direction, int cell) {
    if (direction > 0.0)
        return (cell + 1 - origin) / direction;
    if (direction < 0.0)
        return (cell - origin) / direction;
    return std::numeric_limits<double>::max();
}

}  // namespace

std::vector<glm::dvec2> ray_directions(int n_rays) {
    std::vector<glm::dvec2> directions;
    for (int l = 0; l < n_rays; ++l) {
        const double azimuth = 2.0 * std::numbers::pi * l / n_rays;
        directions.emplace_back(std::cos(azimuth), std::sin(azimuth));
    }
    return directions;
}

RayCaster::RayCaster(const Mask& edges) : reach_(chessboard_distance(edges)) {}

bool RayCaster::is_open(glm::dvec2 point) const {
    if (!(point.x >= 0.0 && point.y >= 0.0 && point.x < width() && point.y < height()))
        return false;
    return reach_(static_cast<int>(point.x), static_cast<int>(point.y)) != 0;
}

std::optional<RayHit> RayCaster::cast(glm::dvec2 origin, glm::dvec2 direction) const {
    const double fastest = std::max(std::abs(direction.x), std::abs(direction.y));
    double t = 0.0;
    int x = static_cast<int>(std::floor(origin.x));
    int y = static_cast<int>(std::floor(origin.y));
    while (reach_.contains(x, y)) {
        const int clear = reach_(x, y);
        if (clear == 0)
            return RayHit{{x, y}, t};
        if (clear >= 2) {  // every pixel nearer than that, chessboard-wise, is empty
            t += (clear - 1 - kLeapMargin) / fastest;
            x = static_cast<int>(std::floor(origin.x + t * direction.x));
            y = static_cast<int>(std::floor(origin.y + t * direction.y));
            continue;
        }
        const double t_column = next_border(origin.x, direction.x, x);
        const double t_row = next_border(origin.y, direction.y, y);
        if (t_column < t_row) {
            x += direction.x > 0.0 ? 1 : -1;
            t = std::max(t, t_column);  // an origin on a border must not set it back
        } else {
            y += direction.y > 0.0 ? 1 : -1;
            t = std::max(t, t_row);
        }
    }
    return std::nullopt;
}

}  // namespace scree::vision
