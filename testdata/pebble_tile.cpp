#include "base/error.h"
#include "base/random.h"
#include "base/whole_file.h"
#include "vision/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

// A tile of pebbles without a seam from a photograph and what `scree rocks` found on it, for the
// scenes of ground that gives way: pebble_tile PHOTO ROCKS_DIR TEXTURES_DIR REPEATED_DIR. The last
// gets photo.png and labels.png of 4 x 4 tiles, for `scree describe`.
//
// Two opposite margins of the photograph overlap; through the overlap runs the path along which
// both show the most alike, mostly between the stones, and each side of it takes one of them.
namespace {

using namespace scree;

constexpr int kMargin = 64;  // px of overlap
constexpr int kRepeats = 4;  // of the photograph and the label map, along each side
constexpr int kCoarser = 2;  // px of the tile for one of its heights

struct Layers {
    Photo photo;
    FloatRaster heights;
    LabelMap labels;
};

template <class Value>
Raster<Value> transposed(const Raster<Value>& in) {
    Raster<Value> out(in.height(), in.width());
    for (int y = 0; y < in.height(); ++y)
        for (int x = 0; x < in.width(); ++x)
            out(y, x) = in(x, y);
    return out;
}

Layers transposed(const Layers& in) {
    return {transposed(in.photo), transposed(in.heights), transposed(in.labels)};
}

// How unlike two pixels are, heights against their range.
double apart(const Layers& layers, int x, int other_x, int y, double per_range) {
    const double light =
        glm::distance(glm::vec3(layers.photo(x, y)), glm::vec3(layers.photo(other_x, y))) / 255.0;
    const double height = (layers.heights(x, y) - layers.heights(other_x, y)) * per_range;
    const bool stone = layers.labels(x, y) != 0 || layers.labels(other_x, y) != 0;
    return light * light + height * height + (stone ? 0.05 : 0.0);
}

struct Path {
    std::vector<int> columns;  // one a row
    double cost = std::numeric_limits<double>::infinity();
};

// The cheapest path from the first row to the last, by at most one column a row, that begins at a
// column and ends beside it, so that it closes round the tile.
Path cheapest_path(const Raster<double>& costs, int begin) {
    const int n = costs.height();
    Raster<double> sums(costs.width(), n, std::numeric_limits<double>::infinity());
    sums(begin, 0) = costs(begin, 0);
    const auto best_above = [&](int x, int y) {
        int best = x;
        for (const int other : {x - 1, x + 1})
            if (other >= 0 && other < costs.width() && sums(other, y - 1) < sums(best, y - 1))
                best = other;
        return best;
    };
    for (int y = 1; y < n; ++y)
        for (int x = 0; x < costs.width(); ++x)
            sums(x, y) = costs(x, y) + sums(best_above(x, y), y - 1);
    Path path{std::vector<int>(static_cast<std::size_t>(n)), sums(begin, n - 1)};
    int x = begin;
    for (int y = n - 1; y >= 0; --y) {
        path.columns[static_cast<std::size_t>(y)] = x;
        x = y > 0 ? best_above(x, y) : x;
    }
    return path;
}

// Left and right become one: `kMargin` columns fewer, and the first follows the last.
Layers closed_sideways(const Layers& in) {
    const int width = in.photo.width() - kMargin;
    const int height = in.photo.height();
    const auto [low, high] = std::minmax_element(in.heights.begin(), in.heights.end());
    const double per_range = 1.0 / std::max(1e-9, double{*high} - *low);
    Raster<double> costs(kMargin, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < kMargin; ++x)
            costs(x, y) = apart(in, x, x + width, y, per_range);
    Path path;
    for (int begin = 2; begin < kMargin - 2; begin += 3) {
        Path one = cheapest_path(costs, begin);
        path = one.cost < path.cost ? std::move(one) : path;
    }
    Layers out{Photo(width, height), FloatRaster(width, height), LabelMap(width, height)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool right = x < kMargin && x < path.columns[static_cast<std::size_t>(y)];
            const int from = right ? x + width : x;
            out.photo(x, y) = in.photo(from, y);
            out.heights(x, y) = in.heights(from, y);
            out.labels(x, y) = in.labels(from, y);
        }
    return out;
}

// Grey stones get what colour such stones have, each its own.
void tint(Layers& tile) {
    for (int y = 0; y < tile.photo.height(); ++y)
        for (int x = 0; x < tile.photo.width(); ++x) {
            const auto rock = static_cast<std::uint64_t>(tile.labels(x, y));
            Rng rng({.seed = 12, .stream = 5, .cell = rock});
            const double warm = rock == 0 ? 0.06 : rng.uniform(-0.02, 0.1);
            const double light = rock == 0 ? 0.9 : rng.uniform(1.0, 1.3);
            const glm::dvec3 colour =
                glm::dvec3(tile.photo(x, y)) * light * glm::dvec3(1.0 + warm, 1.0, 1.0 - warm);
            tile.photo(x, y) = glm::u8vec3(glm::round(glm::min(colour, 255.0)));
        }
}

FloatRaster coarser(const FloatRaster& in) {
    FloatRaster out(in.width() / kCoarser, in.height() / kCoarser);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x) {
            float sum = 0.0F;
            for (int v = 0; v < kCoarser; ++v)
                for (int u = 0; u < kCoarser; ++u)
                    sum += in(kCoarser * x + u, kCoarser * y + v);
            out(x, y) = sum / static_cast<float>(kCoarser * kCoarser);
        }
    return out;
}

template <class Value>
Raster<Value> repeated(const Raster<Value>& in) {
    Raster<Value> out(kRepeats * in.width(), kRepeats * in.height());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            out(x, y) = in(x % in.width(), y % in.height());
    return out;
}

void make_tile(const std::filesystem::path& photo, const std::filesystem::path& rocks,
               const std::filesystem::path& textures, const std::filesystem::path& wide) {
    const vision::HeightImage relief = vision::read_heights(rocks / "displacement.exr");
    const Layers found{vision::read_photo(photo).pixels, relief.metres,
                       vision::read_labels(rocks / "labels.png")};
    if (found.photo.width() != found.heights.width() ||
        found.photo.width() != found.labels.width() || found.photo.width() < 4 * kMargin)
        fail<InvalidInput>("the photograph, displacement.exr and labels.png differ in size");
    Layers tile = transposed(closed_sideways(transposed(closed_sideways(found))));
    tint(tile);
    write_whole_file(textures / "gravel_albedo.jpg",
                     std::span<const std::uint8_t>(vision::encode_jpeg(tile.photo, 80)));
    OutputBatch batch;
    vision::write_heights_png(batch.stage(textures / "gravel_height.png"),
                              {coarser(tile.heights), kCoarser * relief.metres_per_pixel});
    vision::write_png(batch.stage(wide / "photo.png"), repeated(tile.photo));
    vision::write_labels(batch.stage(wide / "labels.png"), repeated(tile.labels));
    batch.commit();
}

}  // namespace

int main(int n_words, char** words) {
    if (n_words != 5) {
        std::cerr << "usage: pebble_tile PHOTO ROCKS_DIR TEXTURES_DIR REPEATED_DIR\n";
        return 2;
    }
    try {
        make_tile(words[1], words[2], words[3], words[4]);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "pebble_tile: " << error.what() << '\n';
        return 1;
    }
}
