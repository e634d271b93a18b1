#include "vision/learned/scale_choice.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

constexpr double kSizeWindow =
    12.0;                           // standard deviation of the neighbourhood of a size, coarse px
constexpr float kLeastRock = 0.3F;  // share of rock around a pixel for its size to be trusted
constexpr int kDoubtCell = 8;       // px
constexpr double kDoubtWindow = 6;  // standard deviation of the neighbourhood of a doubt, cells
constexpr float kDoubtRange = 0.1F;

cv::Mat view(const FloatRaster& raster) {
    // const_cast: OpenCV has no view of constant data; the plane is only read.
    return {raster.height(), raster.width(), CV_32FC1, const_cast<float*>(raster.data())};
}

float squashed(float logit) {
    return 1.0F / (1.0F + std::exp(-logit));
}

// How much of the surroundings is rock, and how steeply the distance climbs on it.
void measure_slopes(const LogitPlanes& coarse, cv::Mat& rock, cv::Mat& slope) {
    const FloatRaster& distance = coarse[2];
    const int width = distance.width(), height = distance.height();
    parallel_for_each_index(0, static_cast<std::size_t>(height), 32, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        const float* here = distance.row(y);
        const float* above = distance.row(std::max(0, y - 1));
        const float* below = distance.row(std::min(height - 1, y + 1));
        for (int x = 0; x < width; ++x) {
            const float dx =
                squashed(here[std::min(width - 1, x + 1)]) - squashed(here[std::max(0, x - 1)]);
            const float dy = squashed(below[x]) - squashed(above[x]);
            const float inside = squashed(coarse[1](x, y));
            rock.at<float>(y, x) = inside;
            slope.at<float>(y, x) = inside * 0.5F * std::sqrt(dx * dx + dy * dy);
        }
    });
}

}  // namespace

bool FineShare::nothing_in(const Span& columns, const Span& rows) const {
    if (by_place.empty())
        return false;
    const int right = std::min(columns.end(), by_place.width());
    for (int y = rows.begin; y < std::min(rows.end(), by_place.height()); ++y)
        for (int x = columns.begin; x < right; ++x)
            if (by_place(x, y) > 0.0F)
                return false;
    return true;
}

FloatRaster enlarged(const FloatRaster& coarse, int width, int height) {
    cv::Mat twice;
    cv::resize(view(coarse), twice, {2 * coarse.width(), 2 * coarse.height()}, 0, 0,
               cv::INTER_LINEAR);
    FloatRaster fine(width, height);
    cv::Mat to = view(fine);
    twice(cv::Rect(0, 0, width, height)).copyTo(to);
    return fine;
}

FineShare choose_share(const LogitPlanes& coarse, int width, int height,
                       const ScaleChoice& choice) {
    const cv::Size size(coarse[0].width(), coarse[0].height());
    cv::Mat rock(size, CV_32F), slope(size, CV_32F);
    measure_slopes(coarse, rock, slope);
    cv::GaussianBlur(rock, rock, {0, 0}, kSizeWindow, kSizeWindow, cv::BORDER_REPLICATE);
    cv::GaussianBlur(slope, slope, {0, 0}, kSizeWindow, kSizeWindow, cv::BORDER_REPLICATE);
    FloatRaster shares(size.width, size.height);
    const auto full = static_cast<float>(choice.full), none = static_cast<float>(choice.none);
    parallel_for_each_index(0, static_cast<std::size_t>(size.height), 32, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        const auto* rock_row = rock.ptr<float>(y);
        const auto* slope_row = slope.ptr<float>(y);
        float* out = shares.row(y);
        for (int x = 0; x < size.width; ++x) {
            // Twice the half width, in pixels that are twice as fine.
            const float diameter = 4.0F * rock_row[x] / std::max(slope_row[x], 1e-6F);
            const float wanted = std::clamp((none - diameter) / (none - full), 0.0F, 1.0F);
            const float unsure = std::clamp(2.0F - rock_row[x] / kLeastRock, 0.0F, 1.0F);
            out[x] = std::max(wanted, unsure);
        }
    });
    return {width == size.width ? std::move(shares) : enlarged(shares, width, height)};
}

FineShare choose_doubtful(const FloatRaster& inside_logits, double doubt) {
    const int width = inside_logits.width(), height = inside_logits.height();
    cv::Mat open(height, width, CV_32F);
    parallel_for_each_index(0, static_cast<std::size_t>(height), 32, [&](std::size_t row) {
        const float* in = inside_logits.row(static_cast<int>(row));
        auto* out = open.ptr<float>(static_cast<int>(row));
        for (int x = 0; x < width; ++x) {
            const float inside = squashed(in[x]);
            out[x] = 4.0F * inside * (1.0F - inside);
        }
    });
    cv::Mat cells;
    const cv::Size size(std::max(1, width / kDoubtCell), std::max(1, height / kDoubtCell));
    cv::resize(open, cells, size, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(cells, cells, {0, 0}, kDoubtWindow, kDoubtWindow, cv::BORDER_REPLICATE);
    cv::resize(cells, open, open.size(), 0, 0, cv::INTER_LINEAR);
    FineShare share{FloatRaster(width, height)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            share.by_place(x, y) = std::clamp(
                (open.at<float>(y, x) - static_cast<float>(doubt)) / kDoubtRange, 0.0F, 1.0F);
    return share;
}

void make_room(LogitPlanes& planes, const FineShare& share) {
    for (FloatRaster& plane : planes) {
        if (share.by_place.empty()) {
            std::fill(plane.begin(), plane.end(), 0.0F);
            continue;
        }
        parallel_for(0, plane.size(), 1 << 16, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                plane.data()[i] *= 1.0F - share.by_place.data()[i];
        });
    }
}

FineTile halved(const FineTile& tile) {
    const auto half = [](const std::vector<float>& weights) {
        std::vector<float> out;
        for (std::size_t i = 0; i + 1 < weights.size(); i += 2)
            out.push_back(0.5F * (weights[i] + weights[i + 1]));
        return out;
    };
    return {{tile.columns.begin / 2, tile.columns.size / 2},
            {tile.rows.begin / 2, tile.rows.size / 2},
            half(tile.column_weights),
            half(tile.row_weights)};
}

void halve_planes(std::vector<float>& planes, int width, int height) {
    const auto w = static_cast<std::size_t>(width);
    const auto rows = static_cast<std::size_t>(kFieldChannels * height / 2);
    for (std::size_t y = 0; y < rows; ++y) {  // a row is written after all that it is read from
        const float* above = planes.data() + 2 * y * w;
        float* out = planes.data() + y * (w / 2);
        for (std::size_t x = 0; x < w / 2; ++x)
            out[x] =
                0.25F * (above[2 * x] + above[2 * x + 1] + above[w + 2 * x] + above[w + 2 * x + 1]);
    }
    planes.resize(planes.size() / 4);
}

void add_tile(const FineTile& tile, std::span<const float> logits, const FineShare& share,
              LogitPlanes& planes) {
    const int right = std::min(tile.columns.end(), planes[0].width());
    const int below = std::min(tile.rows.end(), planes[0].height());
    const auto plane =
        static_cast<std::size_t>(tile.columns.size) * static_cast<std::size_t>(tile.rows.size);
    const bool by_place = !share.by_place.empty();
    const auto n_rows = static_cast<std::size_t>(std::max(0, below - tile.rows.begin));
    parallel_for_each_index(0, n_rows, 32, [&](std::size_t row) {
        const int y = tile.rows.begin + static_cast<int>(row);
        for (std::size_t channel = 0; channel < planes.size(); ++channel) {
            const float* in =
                logits.data() + channel * plane + row * static_cast<std::size_t>(tile.columns.size);
            float* out = planes[channel].row(y);
            for (int x = tile.columns.begin; x < right; ++x) {
                const auto column = static_cast<std::size_t>(x - tile.columns.begin);
                const float weight = tile.row_weights[row] * tile.column_weights[column];
                out[x] += weight * (by_place ? share.by_place(x, y) : 1.0F) * in[column];
            }
        }
    });
}

}  // namespace scree::vision
