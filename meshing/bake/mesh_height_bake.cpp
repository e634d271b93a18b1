#include "meshing/bake/mesh_height_bake.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/vec4.hpp>

namespace scree::meshing {
namespace {

constexpr double kMaxPixels = 200e6;
constexpr int kBandRows = 64;
constexpr double kMostFrames = 64.0;

// A point over the map: x and y in pixels of it, height in metres.
struct MapPoint {
    double x = 0.0;
    double y = 0.0;
    double height = 0.0;
};

// One appearance of a mesh on the map; a wrapping frame may show several.
struct Appearance {
    std::size_t mesh = 0;
    double shift_x = 0.0;  // pixels
    double shift_y = 0.0;
    double low = 0.0;  // rows it covers after the shift
    double high = 0.0;
};

struct Box {
    double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
};

void check_frame(const MapFrame& frame) {
    const double pixels = static_cast<double>(frame.width) * frame.height;
    if (frame.width < 1 || frame.height < 1 || pixels > kMaxPixels)
        fail<InvalidInput>("a displacement map of ", frame.width, " x ", frame.height,
                           " pixels cannot be baked, it must have 1 to ", kMaxPixels);
    if (!(frame.metres_per_pixel > 0.0) || !std::isfinite(frame.metres_per_pixel))
        fail<InvalidInput>("the frame's scale is ", frame.metres_per_pixel,
                           " metres per pixel, it must be positive");
}

std::vector<MapPoint> project(const PlacedMesh& placed, const MapFrame& frame) {
    std::vector<MapPoint> points;
    points.reserve(placed.mesh->positions.size());
    for (const glm::vec3& p : placed.mesh->positions) {
        const glm::dvec4 world = placed.world_from_mesh * glm::dvec4(p.x, p.y, p.z, 1.0);
        points.push_back({world.x / frame.metres_per_pixel + 0.5 * frame.width,
                          world.z / frame.metres_per_pixel + 0.5 * frame.height, world.y});
    }
    return points;
}

Box bounds(const std::vector<MapPoint>& points, std::size_t index) {
    Box box{points[0].x, points[0].x, points[0].y, points[0].y};
    for (const MapPoint& p : points) {
        if (!(std::abs(p.x) < 1e9 && std::abs(p.y) < 1e9 && std::abs(p.height) < 1e9))
            fail<InvalidInput>("mesh ", index, " is placed too far away or by no finite matrix");
        box = {std::min(box.left, p.x), std::max(box.right, p.x), std::min(box.top, p.y),
               std::max(box.bottom, p.y)};
    }
    return box;
}

void add_appearances(const Box& box, std::size_t index, const MapFrame& frame,
                     std::vector<Appearance>& out) {
    if (!frame.wraps) {
        out.push_back({index, 0.0, 0.0, box.top, box.bottom});
        return;
    }
    const double width = frame.width;
    const double height = frame.height;
    if (box.right - box.left > kMostFrames * width || box.bottom - box.top > kMostFrames * height)
        fail<InvalidInput>("mesh ", index, " is wider than ", kMostFrames,
                           " frames that wrap; enlarge the frame");
    for (double y = std::floor(box.top / height); y * height < box.bottom; ++y)
        for (double x = std::floor(box.left / width); x * width < box.right; ++x)
            out.push_back(
                {index, -x * width, -y * height, box.top - y * height, box.bottom - y * height});
}

// Pixel centres within [low, high] of one axis, clipped to [first, last).
struct Span {
    int first = 0;
    int last = 0;
};

Span centres_within(double low, double high, int first, int last) {
    return {
        static_cast<int>(std::clamp(std::ceil(low - 0.5), double(first), double(last))),
        static_cast<int>(std::clamp(std::floor(high - 0.5) + 1.0, double(first), double(last)))};
}

// Closed edge tests: pixel centres on a shared edge are drawn by both triangles, which does no
// harm to a maximum and leaves no cracks.
void draw(const MapPoint& a, const MapPoint& b, const MapPoint& c, Span band, FloatRaster& metres) {
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0.0)
        return;
    const Span rows =
        centres_within(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), band.first, band.last);
    const Span columns =
        centres_within(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), 0, metres.width());
    const double slack = -1e-9;
    for (int y = rows.first; y < rows.last; ++y) {
        float* const row = metres.row(y);
        for (int x = columns.first; x < columns.last; ++x) {
            const double px = x + 0.5;
            const double py = y + 0.5;
            const double u = ((c.x - b.x) * (py - b.y) - (c.y - b.y) * (px - b.x)) / area;
            const double v = ((a.x - c.x) * (py - c.y) - (a.y - c.y) * (px - c.x)) / area;
            const double w = 1.0 - u - v;
            if (u >= slack && v >= slack && w >= slack)
                row[x] = std::max(row[x],
                                  static_cast<float>(u * a.height + v * b.height + w * c.height));
        }
    }
}

void draw_band(std::span<const PlacedMesh> meshes, const MapFrame& frame,
               const std::vector<Appearance>& here, Span band, FloatRaster& metres) {
    for (const Appearance& appearance : here) {
        const PlacedMesh& placed = meshes[appearance.mesh];
        std::vector<MapPoint> points = project(placed, frame);
        for (MapPoint& p : points) {
            p.x += appearance.shift_x;
            p.y += appearance.shift_y;
        }
        for (const glm::uvec3& t : placed.mesh->triangles)
            draw(points[t.x], points[t.y], points[t.z], band, metres);
    }
}

std::vector<Appearance> appearances(std::span<const PlacedMesh> meshes, const MapFrame& frame) {
    std::vector<Appearance> all;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (meshes[i].mesh == nullptr)
            fail<InvalidInput>("placed mesh ", i, " has no mesh");
        check_mesh(*meshes[i].mesh);
        if (!meshes[i].mesh->positions.empty())
            add_appearances(bounds(project(meshes[i], frame), i), i, frame, all);
    }
    return all;
}

}  // namespace

vision::HeightImage bake_mesh_heights(std::span<const PlacedMesh> meshes, const MapFrame& frame) {
    check_frame(frame);
    vision::HeightImage heights{FloatRaster(frame.width, frame.height), frame.metres_per_pixel};
    const auto n_bands = static_cast<std::size_t>((frame.height + kBandRows - 1) / kBandRows);
    std::vector<std::vector<Appearance>> by_band(n_bands);
    for (const Appearance& appearance : appearances(meshes, frame)) {
        const Span rows = centres_within(appearance.low, appearance.high, 0, frame.height);
        for (int band = rows.first / kBandRows; band * kBandRows < rows.last; ++band)
            by_band[static_cast<std::size_t>(band)].push_back(appearance);
    }
    parallel_for_each_index(0, n_bands, 1, [&](std::size_t band) {
        const int first = static_cast<int>(band) * kBandRows;
        draw_band(meshes, frame, by_band[band], {first, std::min(first + kBandRows, frame.height)},
                  heights.metres);
    });
    return heights;
}

}  // namespace scree::meshing
