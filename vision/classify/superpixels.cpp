#include "vision/classify/superpixels.h"

#include "base/parallel.h"

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>

namespace scree::vision {

namespace {

struct Centre {
    glm::dvec2 position{0.0};
    glm::dvec3 colour{0.0};
};

// The squares that pieces start from; the last ones may be wider.
struct Grid {
    int columns;
    int rows;
    double width;
    double height;

    Grid(int picture_width, int picture_height, int size)
        : columns(std::max(1, picture_width / size)),
          rows(std::max(1, picture_height / size)),
          width(static_cast<double>(picture_width) / columns),
          height(static_cast<double>(picture_height) / rows) {}
    int column(int x) const { return std::min(columns - 1, static_cast<int>(x / width)); }
    int row(int y) const { return std::min(rows - 1, static_cast<int>(y / height)); }
    std::size_t count() const {
        return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    }
};

void assign(const Raster<glm::vec3>& lab, const Grid& grid, const std::vector<Centre>& centres,
            double place_weight, Raster<std::int32_t>& ids) {
    parallel_for_each_index(0, static_cast<std::size_t>(lab.height()), 8, [&](std::size_t line) {
        const int y = static_cast<int>(line);
        const int row = grid.row(y);
        for (int x = 0; x < lab.width(); ++x) {
            const int column = grid.column(x);
            const glm::dvec3 colour(lab(x, y));
            double least = 1e300;
            for (int r = std::max(0, row - 1); r <= std::min(grid.rows - 1, row + 1); ++r)
                for (int c = std::max(0, column - 1); c <= std::min(grid.columns - 1, column + 1);
                     ++c) {
                    const int id = r * grid.columns + c;
                    const Centre& centre = centres[static_cast<std::size_t>(id)];
                    const glm::dvec3 off = colour - centre.colour;
                    const glm::dvec2 way = glm::dvec2(x, y) - centre.position;
                    const double distance = glm::dot(off, off) + place_weight * glm::dot(way, way);
                    if (distance < least) {
                        least = distance;
                        ids(x, y) = id;
                    }
                }
        }
    });
}

// Means of what was assigned; a centre without pixels stays.
void move_centres(const Raster<glm::vec3>& lab, const Raster<std::int32_t>& ids,
                  std::vector<Centre>& centres) {
    std::vector<Centre> sums(centres.size());
    std::vector<double> counts(centres.size());
    for (int y = 0; y < lab.height(); ++y)
        for (int x = 0; x < lab.width(); ++x) {
            const auto id = static_cast<std::size_t>(ids(x, y));
            sums[id].position += glm::dvec2(x, y);
            sums[id].colour += glm::dvec3(lab(x, y));
            counts[id] += 1.0;
        }
    for (std::size_t i = 0; i < centres.size(); ++i)
        if (counts[i] > 0.0)
            centres[i] = {sums[i].position / counts[i], sums[i].colour / counts[i]};
}

struct Pixel {
    int x;
    int y;
};

// Number connected pieces anew; one smaller than `least` goes to the piece before it.
Superpixels connected(const Raster<std::int32_t>& ids, std::size_t least) {
    Superpixels result{Raster<std::int32_t>(ids.width(), ids.height(), -1), 0};
    std::vector<Pixel> piece;
    for (int y = 0; y < ids.height(); ++y)
        for (int x = 0; x < ids.width(); ++x) {
            if (result.ids(x, y) >= 0)
                continue;
            const std::int32_t id = ids(x, y);
            const std::int32_t before = x > 0   ? result.ids(x - 1, y)
                                        : y > 0 ? result.ids(x, y - 1)
                                                : -1;
            piece.assign(1, {x, y});
            result.ids(x, y) = result.count;
            for (std::size_t i = 0; i < piece.size(); ++i)
                for (const auto [dx, dy] : {Pixel{1, 0}, Pixel{-1, 0}, Pixel{0, 1}, Pixel{0, -1}}) {
                    const Pixel next{piece[i].x + dx, piece[i].y + dy};
                    if (ids.contains(next.x, next.y) && ids(next.x, next.y) == id &&
                        result.ids(next.x, next.y) < 0) {
                        result.ids(next.x, next.y) = result.count;
                        piece.push_back(next);
                    }
                }
            if (piece.size() >= least || before < 0) {
                ++result.count;
                continue;
            }
            for (const Pixel pixel : piece)
                result.ids(pixel.x, pixel.y) = before;
        }
    return result;
}

}  // namespace

Superpixels superpixels(const Raster<glm::vec3>& lab, const SuperpixelOptions& options) {
    check(options);
    if (lab.empty())
        return {};
    const Grid grid(lab.width(), lab.height(), options.size_px);
    std::vector<Centre> centres(grid.count());
    Raster<std::int32_t> ids(lab.width(), lab.height());
    for (int y = 0; y < lab.height(); ++y)
        for (int x = 0; x < lab.width(); ++x)
            ids(x, y) = grid.row(y) * grid.columns + grid.column(x);
    const double per_px = options.compactness / options.size_px;
    for (int round = 0; round < options.rounds; ++round) {
        move_centres(lab, ids, centres);
        assign(lab, grid, centres, per_px * per_px, ids);
    }
    const auto area =
        static_cast<std::size_t>(options.size_px) * static_cast<std::size_t>(options.size_px);
    return connected(ids, area / 4);
}

Raster<glm::vec3> lab_of(const Photo& photo) {
    Raster<glm::vec3> lab(photo.width(), photo.height());
    std::transform(photo.begin(), photo.end(), lab.begin(),
                   [](glm::u8vec3 colour) { return glm::vec3(colour) / 255.0F; });
    if (!photo.empty()) {
        cv::Mat view(lab.height(), lab.width(), CV_32FC3, lab.data());
        cv::cvtColor(view, view, cv::COLOR_RGB2Lab);
    }
    return lab;
}

}  // namespace scree::vision
