#include "testdata/ground_mosaic.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "testdata/lattice_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <opencv2/imgproc.hpp>

namespace scree::test {

namespace {

struct Region {
    double x;
    double y;
    std::size_t kind;
};

std::vector<Region> place_regions(int width, int height, Rng& rng) {
    const std::size_t n_regions = 3 + rng.below(4);
    const std::size_t first = rng.below(vision::kGroundClasses);
    std::vector<Region> regions;
    for (std::size_t i = 0; i < n_regions; ++i) {
        const double x = rng.uniform(0.0, width);
        const double y = rng.uniform(0.0, height);
        regions.push_back({x, y, (first + i) % vision::kGroundClasses});  // all equally often
    }
    return regions;
}

// Which region a pixel lies in: the nearest, by distances that waver.
Raster<std::uint8_t> region_map(const std::vector<Region>& regions, int width, int height,
                                std::uint64_t seed) {
    const double side = std::max(width, height);
    Raster<std::uint8_t> map(width, height);
    parallel_for_each_index(0, static_cast<std::size_t>(height), 8, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < width; ++x) {
            const double bent_x = x + 0.12 * side * fractal_noise(seed + 1, x, y, 0.3 * side, 4);
            const double bent_y = y + 0.12 * side * fractal_noise(seed + 2, x, y, 0.3 * side, 4);
            double least = 1e18;
            for (std::size_t i = 0; i < regions.size(); ++i) {
                const double distance = std::hypot(bent_x - regions[i].x, bent_y - regions[i].y);
                if (distance < least) {
                    least = distance;
                    map(x, y) = static_cast<std::uint8_t>(i);
                }
            }
        }
    });
    return map;
}

// Draw one region's ground where it lies: in the rectangle round it.
void paint_region(const Raster<std::uint8_t>& map, std::size_t region, vision::GroundClass kind,
                  std::uint64_t seed, ColourRaster& colours) {
    constexpr int kLeast = 64;
    int left = map.width(), top = map.height(), right = 0, bottom = 0;
    for (int y = 0; y < map.height(); ++y)
        for (int x = 0; x < map.width(); ++x)
            if (map(x, y) == region) {
                left = std::min(left, x);
                right = std::max(right, x + 1);
                top = std::min(top, y);
                bottom = std::max(bottom, y + 1);
            }
    if (left >= right)
        return;
    const ColourRaster ground =
        draw_ground(kind, std::max(kLeast, right - left), std::max(kLeast, bottom - top), seed);
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
            if (map(x, y) == region)
                colours(x, y) = ground(x - left, y - top);
}

Photo photographed(ColourRaster& colours, std::uint64_t seed, Rng& rng) {
    const int width = colours.width();
    const int height = colours.height();
    cv::Mat view(height, width, CV_32FC3, colours.data());
    const double blur = rng.uniform(0.3, 1.1);
    cv::GaussianBlur(view, view, cv::Size(), blur);
    const double exposure = rng.uniform(0.75, 1.25);
    const double warmth = rng.uniform(-0.08, 0.08);
    const double noise = rng.uniform(0.002, 0.02);
    const double slope_x = rng.uniform(-0.15, 0.15);
    const double slope_y = rng.uniform(-0.15, 0.15);
    const glm::dvec3 balance(exposure * (1.0 + warmth), exposure, exposure * (1.0 - warmth));
    Photo photo(width, height);
    parallel_for_each_index(
        0, photo.size() / static_cast<std::size_t>(width), 16, [&](std::size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < width; ++x) {
                const double light = 1.0 + slope_x * (x / (0.5 * width) - 1.0) +
                                     slope_y * (y / (0.5 * height) - 1.0);
                for (int c = 0; c < 3; ++c) {
                    const auto key = seed * 13 + static_cast<std::uint64_t>(c);
                    const double grain = lattice(key, x, y) + lattice(key + 5, x, y) - 1.0;
                    const double value =
                        static_cast<double>(colours(x, y)[c]) * balance[c] * light +
                        2.4 * noise * grain;
                    photo(x, y)[c] =
                        static_cast<std::uint8_t>(std::clamp(value, 0.0, 1.0) * 255.0 + 0.5);
                }
            }
        });
    return photo;
}

}  // namespace

GroundMosaic make_ground_mosaic(int width, int height, std::uint64_t seed) {
    if (std::min(width, height) < 64 || std::max(width, height) > 2048)
        fail<InvalidOption>("the mosaic would be ", width, " x ", height,
                            " pixels, each side must be in [64, 2048]");
    Rng rng({.seed = seed, .stream = 10});
    const std::vector<Region> regions = place_regions(width, height, rng);
    const Raster<std::uint8_t> map = region_map(regions, width, height, seed);
    GroundMosaic mosaic;
    mosaic.classes = map;
    for (std::uint8_t& value : mosaic.classes)
        value = static_cast<std::uint8_t>(regions[value].kind);
    ColourRaster colours(width, height);
    for (std::size_t i = 0; i < regions.size(); ++i)
        paint_region(map, i, static_cast<vision::GroundClass>(regions[i].kind), seed * 101 + i,
                     colours);
    mosaic.photo = photographed(colours, seed, rng);
    return mosaic;
}

}  // namespace scree::test
