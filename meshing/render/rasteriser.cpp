#include "meshing/render/rasteriser.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace scree::meshing {
namespace {

constexpr int kTile = 64;           // pixels; a tile of both rasters stays in the first-level cache
constexpr int kSubpixel = 16;       // vertices snap to sixteenths, so edge tests are exact integers
constexpr int kFarthest = 1 << 20;  // pixels
constexpr int kLargestSide = 16384;

using Corner = std::array<std::int32_t, 2>;  // sixteenths of a pixel

struct Shape {
    std::array<Corner, 3> corners{};
    std::array<std::int32_t, 4> box{};  // first and last pixel column, first and last row
    std::uint32_t index = 0;
};

bool snapped(const glm::vec3& point, Corner& corner) {
    const bool near = std::abs(point.x) < kFarthest && std::abs(point.y) < kFarthest;
    if (!near || !std::isfinite(point.z))
        return false;
    corner = {static_cast<std::int32_t>(std::floor(point.x * kSubpixel + 0.5F)),
              static_cast<std::int32_t>(std::floor(point.y * kSubpixel + 0.5F))};
    return true;
}

std::int64_t cross(const Corner& a, const Corner& b, const Corner& c) {
    return std::int64_t{b[0] - a[0]} * (c[1] - a[1]) - std::int64_t{b[1] - a[1]} * (c[0] - a[0]);
}

// First pixel whose centre is not left of `low`, last one whose centre is not right of `high`.
std::int32_t first_pixel(std::int32_t low) {
    return (low + kSubpixel / 2 - 1) >> 4;
}
std::int32_t last_pixel(std::int32_t high) {
    return (high - kSubpixel / 2) >> 4;
}

bool shape_of(std::span<const glm::vec3> screen, const glm::uvec3& triangle, int width, int height,
              Shape& shape) {
    auto& [a, b, c] = shape.corners;
    if (!snapped(screen[triangle.x], a) || !snapped(screen[triangle.y], b) ||
        !snapped(screen[triangle.z], c) || cross(a, b, c) >= 0)
        return false;
    const auto [left, right] = std::minmax({a[0], b[0], c[0]});
    const auto [top, bottom] = std::minmax({a[1], b[1], c[1]});
    shape.box = {std::max(first_pixel(left), 0), std::min(last_pixel(right), width - 1),
                 std::max(first_pixel(top), 0), std::min(last_pixel(bottom), height - 1)};
    return shape.box[0] <= shape.box[1] && shape.box[2] <= shape.box[3];
}

std::vector<Shape> visible_shapes(std::span<const glm::vec3> screen,
                                  std::span<const glm::uvec3> triangles, int width, int height) {
    constexpr std::size_t kPiece = 4096;
    std::vector<std::vector<Shape>> pieces((triangles.size() + kPiece - 1) / kPiece);
    parallel_for(0, triangles.size(), kPiece, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            Shape shape;
            shape.index = static_cast<std::uint32_t>(i);
            if (shape_of(screen, triangles[i], width, height, shape))
                pieces[i / kPiece].push_back(shape);
        }
    });
    std::vector<Shape> shapes;
    for (const auto& piece : pieces)
        shapes.insert(shapes.end(), piece.begin(), piece.end());
    return shapes;
}

// For every tile, row by row, the shapes whose box meets it, in the order they were listed.
struct Tiles {
    int columns = 0;
    std::vector<std::uint32_t> begin;  // one more than there are tiles
    std::vector<std::uint32_t> shapes;
};

template <class Visit>
void for_each_tile(const Shape& shape, int columns, Visit&& visit) {
    for (int row = shape.box[2] / kTile; row <= shape.box[3] / kTile; ++row)
        for (int column = shape.box[0] / kTile; column <= shape.box[1] / kTile; ++column)
            visit(static_cast<std::size_t>(row * columns + column));
}

Tiles sort_into_tiles(const std::vector<Shape>& shapes, int width, int height) {
    Tiles tiles;
    tiles.columns = (width + kTile - 1) / kTile;
    const int rows = (height + kTile - 1) / kTile;
    tiles.begin.assign(static_cast<std::size_t>(tiles.columns * rows) + 1, 0);
    for (const Shape& shape : shapes)
        for_each_tile(shape, tiles.columns, [&](std::size_t tile) { ++tiles.begin[tile + 1]; });
    for (std::size_t tile = 1; tile < tiles.begin.size(); ++tile)
        tiles.begin[tile] += tiles.begin[tile - 1];
    tiles.shapes.resize(tiles.begin.back());
    std::vector<std::uint32_t> next(tiles.begin.begin(), tiles.begin.end() - 1);
    for (std::size_t i = 0; i < shapes.size(); ++i)
        for_each_tile(shapes[i], tiles.columns, [&](std::size_t tile) {
            tiles.shapes[next[tile]++] = static_cast<std::uint32_t>(i);
        });
    return tiles;
}

struct Rect {
    int left, right, top, bottom;  // closed
};

// Edge functions and the nearness plane of one triangle, at the centre of pixel (left, y).
struct Walker {
    std::array<std::int64_t, 3> value{};
    std::array<std::int64_t, 3> step_x{};
    std::array<std::int64_t, 3> step_y{};

    Walker(const Shape& shape, int left, int top) {
        const Corner centre{left * kSubpixel + kSubpixel / 2, top * kSubpixel + kSubpixel / 2};
        for (std::size_t k = 0; k < 3; ++k) {  // edge k lies opposite corner k; inside is positive
            const Corner& from = shape.corners[(k + 2) % 3];
            const Corner& to = shape.corners[(k + 1) % 3];
            value[k] = cross(from, to, centre);
            step_x[k] = std::int64_t{from[1] - to[1]} * kSubpixel;
            step_y[k] = std::int64_t{to[0] - from[0]} * kSubpixel;
        }
    }
};

void draw(const Shape& shape, const std::array<float, 3>& nearness, const Rect& tile,
          Visibility& out) {
    const Rect box{std::max(shape.box[0], tile.left), std::min(shape.box[1], tile.right),
                   std::max(shape.box[2], tile.top), std::min(shape.box[3], tile.bottom)};
    Walker walk(shape, box.left, box.top);
    const double whole = static_cast<double>(walk.value[0] + walk.value[1] + walk.value[2]);
    const double share_b = (nearness[1] - nearness[0]) / whole;
    const double share_c = (nearness[2] - nearness[0]) / whole;
    for (int y = box.top; y <= box.bottom; ++y) {
        auto edge = walk.value;
        float* depth = out.nearness.row(y);
        std::uint32_t* seen = out.triangle.row(y);
        for (int x = box.left; x <= box.right; ++x) {
            if ((edge[0] | edge[1] | edge[2]) >= 0) {
                const auto here =
                    static_cast<float>(nearness[0] + share_b * static_cast<double>(edge[1]) +
                                       share_c * static_cast<double>(edge[2]));
                if (here > depth[x]) {
                    depth[x] = here;
                    seen[x] = shape.index;
                }
            }
            for (std::size_t k = 0; k < 3; ++k)
                edge[k] += walk.step_x[k];
        }
        for (std::size_t k = 0; k < 3; ++k)
            walk.value[k] += walk.step_y[k];
    }
}

}  // namespace

Visibility rasterise(std::span<const glm::vec3> screen, std::span<const glm::uvec3> triangles,
                     int width, int height) {
    if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
        fail<InvalidInput>("a picture of ", width, " x ", height,
                           " pixels cannot be drawn; each side must be in [1, ", kLargestSide, "]");
    const std::vector<Shape> shapes = visible_shapes(screen, triangles, width, height);
    const Tiles tiles = sort_into_tiles(shapes, width, height);
    Visibility out{FloatRaster(width, height, std::numeric_limits<float>::lowest()),
                   Raster<std::uint32_t>(width, height, kNoTriangle)};
    parallel_for_each_index(0, tiles.begin.size() - 1, 1, [&](std::size_t tile) {
        const int left = static_cast<int>(tile) % tiles.columns * kTile;
        const int top = static_cast<int>(tile) / tiles.columns * kTile;
        const Rect rect{left, left + kTile - 1, top, top + kTile - 1};
        for (std::uint32_t i = tiles.begin[tile]; i < tiles.begin[tile + 1]; ++i) {
            const Shape& shape = shapes[tiles.shapes[i]];
            const glm::uvec3& corner = triangles[shape.index];
            draw(shape, {screen[corner.x].z, screen[corner.y].z, screen[corner.z].z}, rect, out);
        }
    });
    return out;
}

}  // namespace scree::meshing
