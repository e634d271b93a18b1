#include "vision/classical/complete_field.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

void check_size(const FloatRaster& channel, const Photo& photo, const char* name) {
    if (channel.width() != photo.width() || channel.height() != photo.height())
        fail<InvalidInput>("the ", name, " channel is ", channel.width(), " x ", channel.height(),
                           ", must be ", photo.width(), " x ", photo.height(),
                           " like the photograph");
}

FloatRaster grown_distance(const FloatRaster& boundary) {
    constexpr float kReach = 10.0F;
    cv::Mat clear(boundary.height(), boundary.width(), CV_8UC1), away;
    for (int y = 0; y < boundary.height(); ++y)
        for (int x = 0; x < boundary.width(); ++x)
            clear.at<std::uint8_t>(y, x) = boundary(x, y) < 0.5F ? 1 : 0;
    cv::distanceTransform(clear, away, cv::DIST_L2, cv::DIST_MASK_5);
    FloatRaster distance(boundary.width(), boundary.height());
    for (int y = 0; y < boundary.height(); ++y)
        for (int x = 0; x < boundary.width(); ++x)
            distance(x, y) = 1.0F - std::exp(-std::min(away.at<float>(y, x), 1e4F) / kReach);
    return distance;
}

}  // namespace

const EdgeField& complete_field(const Photo& photo, const EdgeField& field, EdgeField& storage) {
    check_size(field.boundary, photo, "boundary");
    if (!field.inside.empty())
        check_size(field.inside, photo, "inside");
    if (!field.distance.empty())
        check_size(field.distance, photo, "distance");
    if (!field.inside.empty() && !field.distance.empty())
        return field;
    storage = field;
    if (storage.inside.empty()) {
        storage.inside = field.boundary;
        for (float& value : storage.inside)
            value = 1.0F - value;
    }
    if (storage.distance.empty())
        storage.distance = grown_distance(field.boundary);
    return storage;
}

}  // namespace scree::vision
