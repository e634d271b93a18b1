#include "vision/learned/level_picture.h"

#include "base/parallel.h"
#include "vision/learned/outline_network.h"

#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

constexpr int kCell = 8;
constexpr double kWindow = 8.0;  // standard deviation, cells
constexpr float kLeastSpread = 0.04F;

cv::Mat view(const Photo& photo) {
    // const_cast: OpenCV has no view of constant data; the picture is only read.
    return {photo.height(), photo.width(), CV_8UC3, const_cast<glm::u8vec3*>(photo.data())};
}

int rounded_up(int value) {
    return (value + kNetworkStep - 1) / kNetworkStep * kNetworkStep;
}

Photo padded_to_step(const Photo& photo) {
    Photo out(rounded_up(photo.width()), rounded_up(photo.height()));
    cv::Mat to = view(out);
    const int right = out.width() - photo.width(), below = out.height() - photo.height();
    const bool mirrors = right < photo.width() && below < photo.height();
    cv::copyMakeBorder(view(photo), to, 0, below, 0, right,
                       mirrors ? cv::BORDER_REFLECT_101 : cv::BORDER_REPLICATE);
    return out;
}

// Mean of the luma and of its square over each cell.
void measure_cells(const Photo& padded, cv::Mat& mean, cv::Mat& square) {
    parallel_for_each_index(0, static_cast<std::size_t>(mean.rows), 4, [&](std::size_t row) {
        const int cy = static_cast<int>(row);
        auto* mean_row = mean.ptr<float>(cy);
        auto* square_row = square.ptr<float>(cy);
        for (int cx = 0; cx < mean.cols; ++cx) {
            float sum = 0.0F, sum_of_squares = 0.0F;
            for (int y = cy * kCell; y < (cy + 1) * kCell; ++y) {
                const glm::u8vec3* pixels = padded.row(y) + cx * kCell;
                for (int x = 0; x < kCell; ++x) {
                    const glm::u8vec3 p = pixels[x];
                    const float luma =
                        (0.299F * static_cast<float>(p.r) + 0.587F * static_cast<float>(p.g) +
                         0.114F * static_cast<float>(p.b)) /
                        255.0F;
                    sum += luma;
                    sum_of_squares += luma * luma;
                }
            }
            mean_row[cx] = sum / (kCell * kCell);
            square_row[cx] = sum_of_squares / (kCell * kCell);
        }
    });
}

FloatRaster with_one_more(const cv::Mat& cells) {
    FloatRaster out(cells.cols + 2, cells.rows + 2);
    cv::Mat to(out.height(), out.width(), CV_32F, out.data());
    cv::copyMakeBorder(cells, to, 1, 1, 1, 1, cv::BORDER_REPLICATE);
    return out;
}

// The map at every pixel of a tile, linearly between the middles of the cells.
cv::Mat at_pixels(const FloatRaster& map, const Span& columns, const Span& rows) {
    const cv::Mat whole(map.height(), map.width(), CV_32F, const_cast<float*>(map.data()));
    const cv::Mat part = whole(cv::Rect(columns.begin / kCell, rows.begin / kCell,
                                        columns.size / kCell + 2, rows.size / kCell + 2));
    cv::Mat fine;
    cv::resize(part, fine, {part.cols * kCell, part.rows * kCell}, 0, 0, cv::INTER_LINEAR);
    return fine(cv::Rect(kCell, kCell, columns.size, rows.size));
}

}  // namespace

Photo halved(const Photo& photo) {
    Photo out((photo.width() + 1) / 2, (photo.height() + 1) / 2);
    parallel_for_each_index(0, static_cast<std::size_t>(out.height()), 32, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        const glm::u8vec3* above = photo.row(2 * y);
        const glm::u8vec3* below = photo.row(std::min(2 * y + 1, photo.height() - 1));
        for (int x = 0; x < out.width(); ++x) {
            const int left = 2 * x, right = std::min(2 * x + 1, photo.width() - 1);
            const glm::uvec3 sum = glm::uvec3(above[left]) + glm::uvec3(above[right]) +
                                   glm::uvec3(below[left]) + glm::uvec3(below[right]);
            out(x, y) = glm::u8vec3((sum + 2U) / 4U);
        }
    });
    return out;
}

Photo doubled(const Photo& photo) {
    Photo out(2 * photo.width(), 2 * photo.height());
    cv::Mat to = view(out);
    cv::resize(view(photo), to, to.size(), 0, 0, cv::INTER_CUBIC);
    return out;
}

LevelPicture level_picture(const Photo& photo) {
    LevelPicture level{photo.width(), photo.height(), padded_to_step(photo), {}, {}};
    const cv::Size cells(level.padded.width() / kCell, level.padded.height() / kCell);
    cv::Mat mean(cells, CV_32F), square(cells, CV_32F);
    measure_cells(level.padded, mean, square);
    cv::GaussianBlur(mean, mean, {0, 0}, kWindow, kWindow, cv::BORDER_REPLICATE);
    cv::GaussianBlur(square, square, {0, 0}, kWindow, kWindow, cv::BORDER_REPLICATE);
    cv::Mat spread = square - mean.mul(mean);
    spread = cv::max(spread, 0.0);
    cv::sqrt(spread, spread);
    level.mean = with_one_more(mean);
    level.spread = with_one_more(spread);
    return level;
}

void fill_input(const LevelPicture& level, const Span& columns, const Span& rows,
                std::vector<float>& planes) {
    const auto width = static_cast<std::size_t>(columns.size);
    const auto height = static_cast<std::size_t>(rows.size);
    planes.resize(3 * width * height);
    const cv::Mat mean = at_pixels(level.mean, columns, rows);
    const cv::Mat spread = at_pixels(level.spread, columns, rows);
    parallel_for_each_index(0, height, 32, [&](std::size_t y) {
        const glm::u8vec3* pixels =
            level.padded.row(rows.begin + static_cast<int>(y)) + columns.begin;
        const auto* mean_row = mean.ptr<float>(static_cast<int>(y));
        const auto* spread_row = spread.ptr<float>(static_cast<int>(y));
        for (std::size_t channel = 0; channel < 3; ++channel) {
            float* out = planes.data() + (channel * height + y) * width;
            for (std::size_t x = 0; x < width; ++x) {
                const auto value =
                    static_cast<float>(pixels[x][static_cast<int>(channel)]) / 255.0F;
                out[x] = (value - mean_row[x]) / (spread_row[x] + kLeastSpread);
            }
        }
    });
}

}  // namespace scree::vision
