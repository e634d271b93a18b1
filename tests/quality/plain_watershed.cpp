#include "tests/quality/plain_watershed.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <queue>
#include <tuple>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace scree::test {
namespace {

constexpr double kBlur = 1.0;         // px
constexpr float kProminence = 0.12F;  // of a peak that becomes a marker
constexpr float kLeastPeak = 0.3F;    // its least relative distance
constexpr float kLeastPeakInside = 0.4F;
constexpr float kLeastInside = 0.5F;  // of a flooded pixel
constexpr float kDepth = 0.5F;        // weight of the distance in the relief

struct Waiting {
    float level;  // the lowest goes first
    std::int64_t order;
    int x, y;
    bool operator<(const Waiting& o) const {
        return std::tie(level, order) > std::tie(o.level, o.order);
    }
};

template <class Visit>
void for_neighbours(int x, int y, int width, int height, Visit&& visit) {
    for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u)
            if (u != x || v != y)
                visit(u, v);
}

FloatRaster blurred(const FloatRaster& plane) {
    FloatRaster out(plane.width(), plane.height());
    cv::Mat to(out.height(), out.width(), CV_32F, out.data());
    // const_cast: OpenCV has no view of constant data; the plane is only read.
    cv::GaussianBlur(
        cv::Mat(plane.height(), plane.width(), CV_32F, const_cast<float*>(plane.data())), to,
        {0, 0}, kBlur);
    return out;
}

// The surface with every peak cut off by the prominence: greatest surface under the given one that
// has no peak above surface - prominence (reconstruction by dilation).
FloatRaster cut_peaks(const FloatRaster& surface) {
    FloatRaster cut(surface.width(), surface.height());
    std::priority_queue<Waiting> queue;
    for (int y = 0; y < cut.height(); ++y)
        for (int x = 0; x < cut.width(); ++x) {
            cut(x, y) = surface(x, y) - kProminence;
            queue.push({-cut(x, y), 0, x, y});
        }
    while (!queue.empty()) {
        const Waiting at = queue.top();
        queue.pop();
        if (-at.level < cut(at.x, at.y))
            continue;  // raised since it was put here
        for_neighbours(at.x, at.y, cut.width(), cut.height(), [&](int u, int v) {
            const float reached = std::min(-at.level, surface(u, v));
            if (reached > cut(u, v)) {
                cut(u, v) = reached;
                queue.push({-reached, 0, u, v});
            }
        });
    }
    return cut;
}

// Peaks that stand out, connected ones together, numbered from 1.
cv::Mat markers_of(const FloatRaster& peaks, const FloatRaster& inside) {
    const FloatRaster cut = cut_peaks(peaks);
    cv::Mat mask(peaks.height(), peaks.width(), CV_8U), labels;
    for (int y = 0; y < peaks.height(); ++y)
        for (int x = 0; x < peaks.width(); ++x)
            mask.at<std::uint8_t>(y, x) = peaks(x, y) - cut(x, y) >= kProminence - 1e-6F &&
                                          peaks(x, y) > kLeastPeak &&
                                          inside(x, y) > kLeastPeakInside;
    cv::connectedComponents(mask, labels, 8, CV_32S);
    return labels;
}

}  // namespace

LabelMap plain_watershed(const vision::EdgeField& field) {
    const FloatRaster peaks = blurred(field.distance);
    const cv::Mat markers = markers_of(peaks, field.inside);
    const int width = peaks.width(), height = peaks.height();
    LabelMap labels(width, height, 0);
    std::priority_queue<Waiting> queue;
    std::int64_t order = 0;  // who came first goes first on even ground
    const auto reach = [&](int x, int y, std::uint16_t label, float least) {
        labels(x, y) = label;
        const float relief = field.boundary(x, y) - kDepth * peaks(x, y);
        queue.push({std::max(relief, least), order++, x, y});
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (const int marker = markers.at<int>(y, x);
                marker > 0 && marker <= std::numeric_limits<std::uint16_t>::max() &&
                field.inside(x, y) > kLeastInside)
                reach(x, y, static_cast<std::uint16_t>(marker),
                      -std::numeric_limits<float>::infinity());
    while (!queue.empty()) {
        const Waiting at = queue.top();
        queue.pop();
        for_neighbours(at.x, at.y, width, height, [&](int u, int v) {
            if (labels(u, v) == 0 && field.inside(u, v) > kLeastInside)
                reach(u, v, labels(at.x, at.y), at.level);
        });
    }
    return labels;
}

}  // namespace scree::test
