#include "terrain/contact/shapes.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/common.hpp>

namespace scree::terrain {
namespace {

using meshing::TriMesh;

constexpr double kTurn = 2.0 * std::numbers::pi;

double smooth_step(double low, double high, double value) {
    const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// 1 on the first `duty` of every period, 0 on the rest, with walls `wall` periods wide.
double pulse(double phase, double duty, double wall) {
    const double t = phase - std::floor(phase);
    return smooth_step(0.0, wall, t) * (1.0 - smooth_step(duty, duty + wall, t));
}

void add_quad(TriMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
}

// Closed surface of a grid with a pole at either end: `point(row, segment)` for the rows between
// the poles. Counter-clockwise from outside when segments turn right-handed about the axis from
// the last pole to the first.
template <class Point>
TriMesh poled_grid(int rows, int segments, const glm::vec3& first, const glm::vec3& last,
                   Point&& point) {
    TriMesh mesh;
    mesh.positions.push_back(first);
    for (int row = 0; row < rows; ++row)
        for (int s = 0; s < segments; ++s)
            mesh.positions.push_back(point(row, s));
    mesh.positions.push_back(last);
    const auto at = [&](int row, int s) {
        return static_cast<std::uint32_t>(1 + row * segments + s % segments);
    };
    const auto end = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (int s = 0; s < segments; ++s) {
        mesh.triangles.emplace_back(0U, at(0, s), at(0, s + 1));
        for (int row = 0; row + 1 < rows; ++row)
            add_quad(mesh, at(row, s), at(row + 1, s), at(row + 1, s + 1), at(row, s + 1));
        mesh.triangles.emplace_back(end, at(rows - 1, s + 1), at(rows - 1, s));
    }
    return mesh;
}

// Half of a tyre's profile from the hub out: a place across (0 is the middle, 1 the edge of the
// tread) and a radius, both as shares; `tread` marks where lugs grow.
struct ProfilePoint {
    double across = 0.0;
    double radius = 0.0;
    bool tread = false;
};

std::vector<ProfilePoint> tyre_profile(int tread_rows) {
    std::vector<ProfilePoint> points = {{0.62, 0.30, false}, {0.70, 0.55, false},
                                        {0.96, 0.62, false}, {1.06, 0.74, false},
                                        {1.08, 0.86, false}, {1.04, 0.93, false}};
    for (int i = 0; i <= tread_rows; ++i) {
        const double across = 1.0 - 2.0 * i / tread_rows;
        points.push_back({across, 1.0 - 0.035 * across * across * across * across, true});
    }
    for (int i = 5; i >= 0; --i)
        points.push_back({-points[static_cast<std::size_t>(i)].across,
                          points[static_cast<std::size_t>(i)].radius, false});
    return points;
}

// 1 on a lug, 0 in a groove. Two rows of bars lean towards each other and meet, half a lug apart,
// at the middle.
double tyre_lug(double turn, double across, int lugs) {
    const double side = across < 0.0 ? 0.5 : 0.0;
    const double phase = turn * lugs + side - 0.55 * std::abs(across);
    return pulse(phase, 0.52, 0.10) * smooth_step(0.05, 0.12, std::abs(across));
}

// Closed body over a grid of footprints: a floor and a roof that share their rim.
struct Slab {
    int columns = 0;  // along the length
    int rows = 0;     // across
};

template <class Foot, class Floor, class Roof>
TriMesh closed_slab(const Slab& slab, Foot&& foot, Floor&& floor_at, Roof&& roof_at) {
    TriMesh mesh;
    const int across = slab.rows + 1;
    for (const bool roof : {false, true})
        for (int i = 0; i <= slab.columns; ++i)
            for (int j = 0; j <= slab.rows; ++j) {
                const double u = static_cast<double>(i) / slab.columns;
                const double v = 2.0 * j / slab.rows - 1.0;
                const glm::dvec2 place = foot(u, v);
                mesh.positions.emplace_back(place.x, roof ? roof_at(u, v) : floor_at(u, v),
                                            place.y);
            }
    const auto at = [&](bool roof, int i, int j) {
        const int layer = roof ? (slab.columns + 1) * across : 0;
        return static_cast<std::uint32_t>(layer + i * across + j);
    };
    for (int i = 0; i < slab.columns; ++i)
        for (int j = 0; j < slab.rows; ++j) {
            add_quad(mesh, at(false, i, j), at(false, i + 1, j), at(false, i + 1, j + 1),
                     at(false, i, j + 1));
            add_quad(mesh, at(true, i, j), at(true, i, j + 1), at(true, i + 1, j + 1),
                     at(true, i + 1, j));
        }
    for (int i = 0; i < slab.columns; ++i) {
        add_quad(mesh, at(false, i, 0), at(true, i, 0), at(true, i + 1, 0), at(false, i + 1, 0));
        const int j = slab.rows;
        add_quad(mesh, at(false, i, j), at(false, i + 1, j), at(true, i + 1, j), at(true, i, j));
    }
    for (int j = 0; j < slab.rows; ++j) {
        add_quad(mesh, at(false, 0, j), at(false, 0, j + 1), at(true, 0, j + 1), at(true, 0, j));
        const int i = slab.columns;
        add_quad(mesh, at(false, i, j), at(true, i, j), at(true, i, j + 1), at(false, i, j + 1));
    }
    return mesh;
}

// Half width of a sole at a share of its length from heel to toe: heel, waist, ball, toe.
double sole_half_width(double u) {
    const double heel = 0.36 * std::sqrt(std::max(0.0, 1.0 - std::pow((u - 0.16) / 0.17, 2.0)));
    const double waist = 0.34;
    const double ball = 0.5 * std::sqrt(std::max(0.0, 1.0 - std::pow((u - 0.68) / 0.33, 2.0)));
    const double body = u < 0.16   ? heel
                        : u < 0.42 ? glm::mix(0.36, waist, smooth_step(0.16, 0.42, u))
                        : u < 0.66 ? glm::mix(waist, 0.5, smooth_step(0.42, 0.66, u))
                                   : ball;
    return std::max(body, 0.10);
}

}  // namespace

TriMesh sphere_mesh(const SphereShape& shape) {
    check(shape);
    const int segments = 2 * shape.rings;
    const auto r = static_cast<float>(shape.radius_m);
    return poled_grid(shape.rings - 1, segments, {0, r, 0}, {0, -r, 0}, [&](int row, int s) {
        const double polar = std::numbers::pi * (row + 1) / shape.rings;
        const double turn = kTurn * s / segments;
        return glm::vec3(glm::dvec3(std::sin(polar) * std::sin(turn), std::cos(polar),
                                    std::sin(polar) * std::cos(turn)) *
                         shape.radius_m);
    });
}

TriMesh box_mesh(const BoxShape& shape) {
    const glm::dvec3 half = 0.5 * shape.size_m;
    for (const double edge : {half.x, half.y, half.z})
        if (!(edge >= 0.5e-4 && edge <= 0.5e3))
            fail<InvalidOption>("size_m holds ", 2.0 * edge, ", must be in [0.0001, 1000] m");
    return closed_slab(
        {1, 1},
        [&](double u, double v) { return glm::dvec2((2.0 * u - 1.0) * half.x, v * half.z); },
        [&](double, double) { return -half.y; }, [&](double, double) { return half.y; });
}

TriMesh tyre_mesh(const TyreShape& shape) {
    check(shape);
    if (shape.tread_depth_m > 0.3 * shape.radius_m)
        fail<InvalidOption>("tread_depth_m is ", shape.tread_depth_m,
                            ", must be at most 0.3 of the radius of ", shape.radius_m, " m");
    const std::vector<ProfilePoint> profile = tyre_profile(64);
    const double half = 0.5 * shape.width_m;
    const auto hub = static_cast<float>(0.55 * half);
    return poled_grid(static_cast<int>(profile.size()), shape.segments, {0, 0, hub}, {0, 0, -hub},
                      [&](int row, int s) {
                          const ProfilePoint& p = profile[static_cast<std::size_t>(row)];
                          const double turn = static_cast<double>(s) / shape.segments;
                          double radius = p.radius * shape.radius_m;
                          if (p.tread)
                              radius -= shape.tread_depth_m *
                                        (1.0 - tyre_lug(turn, p.across, shape.lugs));
                          return glm::vec3(std::cos(kTurn * turn) * radius,
                                           std::sin(kTurn * turn) * radius, p.across * half);
                      });
}

TriMesh boot_mesh(const BootShape& shape) {
    check(shape);
    if (shape.lug_depth_m > 0.5 * shape.height_m)
        fail<InvalidOption>("lug_depth_m is ", shape.lug_depth_m,
                            ", must be at most half the height of ", shape.height_m, " m");
    const double side = shape.left ? -1.0 : 1.0;
    const auto foot = [&](double u, double v) {
        // Toes bend inwards; half widths shrink to a tenth at both ends, never to nothing.
        const double middle = 0.06 * smooth_step(0.35, 1.0, u);
        return glm::dvec2((u - 0.5) * shape.length_m,
                          (side * -middle + v * sole_half_width(u)) * shape.width_m);
    };
    const auto floor_at = [&](double u, double v) {
        const double bend = 0.5 * side * v;
        const double bar = pulse(u * shape.lugs - 0.35 * std::abs(bend), 0.55, 0.12);
        const double slot = smooth_step(0.06, 0.12, std::abs(v));
        const double rim = smooth_step(0.80, 0.88, std::abs(v));
        const double lug = std::max(bar * slot, rim * pulse(u * shape.lugs + 0.25, 0.6, 0.12));
        const double arch = smooth_step(0.30, 0.34, u) * (1.0 - smooth_step(0.44, 0.48, u));
        const double toe = std::max(0.0, u - 0.80) / 0.20;
        return shape.lug_depth_m * (1.0 - lug * (1.0 - arch)) + 0.5 * shape.lug_depth_m * arch +
               0.05 * shape.length_m * toe * toe;
    };
    const auto roof_at = [&](double u, double v) {
        const double ankle = 1.0 - smooth_step(0.30, 0.62, u);
        const double crown = 1.0 - 0.45 * v * v;
        const double base = 2.0 * shape.lug_depth_m + 0.05 * shape.length_m;
        return base + shape.height_m * crown * (0.35 + 0.65 * ankle) *
                          (1.0 - 0.6 * smooth_step(0.75, 1.0, u));
    };
    return closed_slab({shape.segments, std::max(8, shape.segments / 3)}, foot, floor_at, roof_at);
}

}  // namespace scree::terrain
