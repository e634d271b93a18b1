#include "terrain/contact/underside.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/vec4.hpp>

namespace scree::terrain {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr double kFarthest = 1e9;  // cells; beyond it a centre is no longer told from the next
constexpr double kSlack = -1e-9;   // of a barycentric weight: no cracks between neighbours

// In cells along x and y, the height in metres. `first` is the first centre at or beyond the place,
// `last` the last one at or before it.
struct CellPoint {
    double x = 0.0;
    double y = 0.0;
    double height = 0.0;
    int first_x = 0, last_x = 0;
    int first_y = 0, last_y = 0;
};

struct Bounds {
    double left = std::numeric_limits<double>::max();
    double right = std::numeric_limits<double>::lowest();
    double top = std::numeric_limits<double>::max();
    double bottom = std::numeric_limits<double>::lowest();
};

void check_grid(const CellGrid& grid) {
    if (!(grid.cell_size > 0.0) || !std::isfinite(grid.cell_size))
        fail<InvalidInput>("the cell size is ", grid.cell_size, " m, it must be positive");
}

// std::floor is a call on machines without SSE 4.1, and this is asked four times a vertex.
// @pre  A finite value.
int floor_of(double value) {
    const double near = std::clamp(value, -kFarthest, kFarthest);
    const int whole = static_cast<int>(near);
    return whole - (whole > near ? 1 : 0);
}

CellPoint cell_point(double x, double y, double height) {
    return {
        x, y, height, -floor_of(0.5 - x), floor_of(x - 0.5), -floor_of(0.5 - y), floor_of(y - 0.5)};
}

// Every cell that the bounds touch, so that something smaller than a cell has a window too.
CellWindow touched_by(const Bounds& bounds) {
    const int x = floor_of(bounds.left);
    const int y = floor_of(bounds.top);
    return {x, y, floor_of(bounds.right) - x + 1, floor_of(bounds.bottom) - y + 1};
}

Underside empty_over(const Bounds& bounds, const CellWindow& extent) {
    const CellWindow touched = touched_by(bounds);
    const CellWindow inside = intersection(touched, extent);
    Underside out;
    if (inside.empty())
        return out;
    out.window = inside;
    out.heights = FloatRaster(inside.width, inside.height, kNone);
    out.lost = inside == touched;  // until a centre is covered
    return out;
}

std::vector<CellPoint> placed(const meshing::TriMesh& mesh, const glm::dmat4& world_from_mesh,
                              double cell_size) {
    std::vector<CellPoint> points;
    points.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) {
        const glm::dvec4 world = world_from_mesh * glm::dvec4(p.x, p.y, p.z, 1.0);
        const double x = world.x / cell_size;
        const double y = world.z / cell_size;
        if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(world.y))
            fail<InvalidInput>("vertex ", points.size(),
                               " of an object is placed nowhere: its matrix is not finite");
        points.push_back(cell_point(x, y, world.y));
    }
    return points;
}

void draw(const CellPoint& a, const CellPoint& b, const CellPoint& c, Underside& out) {
    const CellWindow& window = out.window;
    // Most triangles of a fine mesh lie between the centres: the cheap question comes first.
    const int top = std::max(std::min({a.first_y, b.first_y, c.first_y}), window.y);
    const int bottom =
        std::min(std::max({a.last_y, b.last_y, c.last_y}), window.y + window.height - 1);
    if (top > bottom)
        return;
    const int left = std::max(std::min({a.first_x, b.first_x, c.first_x}), window.x);
    const int right =
        std::min(std::max({a.last_x, b.last_x, c.last_x}), window.x + window.width - 1);
    if (left > right)
        return;
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0.0)
        return;
    for (int y = top; y <= bottom; ++y) {
        float* const row = out.heights.row(y - window.y);
        const double py = y + 0.5;
        for (int x = left; x <= right; ++x) {
            const double px = x + 0.5;
            const double u = ((c.x - b.x) * (py - b.y) - (c.y - b.y) * (px - b.x)) / area;
            const double v = ((a.x - c.x) * (py - c.y) - (a.y - c.y) * (px - c.x)) / area;
            const double w = 1.0 - u - v;
            if (u < kSlack || v < kSlack || w < kSlack)
                continue;
            float& lowest = row[x - window.x];
            lowest =
                std::min(lowest, static_cast<float>(u * a.height + v * b.height + w * c.height));
        }
    }
}

void count_covered(Underside& out) {
    out.covered = static_cast<int>(std::count_if(out.heights.begin(), out.heights.end(),
                                                 [](float height) { return height < kNone; }));
    out.lost = out.lost && out.covered == 0;
}

}  // namespace

Underside underside_of(const meshing::TriMesh& mesh, const glm::dmat4& world_from_mesh,
                       const CellGrid& grid) {
    meshing::check_mesh(mesh);
    return underside_of_checked(mesh, world_from_mesh, grid);
}

Underside underside_of_checked(const meshing::TriMesh& mesh, const glm::dmat4& world_from_mesh,
                               const CellGrid& grid) {
    check_grid(grid);
    const std::vector<CellPoint> points = placed(mesh, world_from_mesh, grid.cell_size);
    Bounds bounds;
    for (const CellPoint& p : points)
        bounds = {std::min(bounds.left, p.x), std::max(bounds.right, p.x),
                  std::min(bounds.top, p.y), std::max(bounds.bottom, p.y)};
    if (points.empty())
        return {};
    Underside out = empty_over(bounds, grid.extent);
    for (const glm::uvec3& t : mesh.triangles)
        draw(points[t.x], points[t.y], points[t.z], out);
    count_covered(out);
    return out;
}

Underside underside_of_sphere(const glm::dvec3& centre, double radius, const CellGrid& grid) {
    check_grid(grid);
    if (!(radius > 0.0) || !std::isfinite(radius) || !std::isfinite(centre.x) ||
        !std::isfinite(centre.y) || !std::isfinite(centre.z))
        fail<InvalidInput>("a sphere of radius ", radius, " m at (", centre.x, ", ", centre.y, ", ",
                           centre.z, ") has no underside, its numbers must be finite and positive");
    const double size = grid.cell_size;
    Underside out = empty_over({(centre.x - radius) / size, (centre.x + radius) / size,
                                (centre.z - radius) / size, (centre.z + radius) / size},
                               grid.extent);
    for (int y = 0; y < out.window.height; ++y)
        for (int x = 0; x < out.window.width; ++x) {
            const double dx = (out.window.x + x + 0.5) * size - centre.x;
            const double dz = (out.window.y + y + 0.5) * size - centre.z;
            const double left = radius * radius - dx * dx - dz * dz;
            if (left >= 0.0)
                out.heights(x, y) = static_cast<float>(centre.y - std::sqrt(left));
        }
    count_covered(out);
    return out;
}

}  // namespace scree::terrain
