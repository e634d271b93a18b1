#pragma once

#include "base/random.h"
#include "meshing/mesh/tri_mesh.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace scree::test {

/// The Delaunay triangulation of points on the unit sphere, built point by point with edge flips.
/// Points are doubles that lie on the sphere; the first six must be the ends of the axes.
class SphereDelaunay {
public:
    explicit SphereDelaunay(const std::vector<glm::dvec3>& points) : points_(points) {
        // +x -x +y -y +z -z
        triangles_ = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                      {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
        across_ = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                   {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
        triangle_of_.assign(points.size(), 0);
        triangle_of_[0] = triangle_of_[2] = triangle_of_[4] = 0;
        triangle_of_[1] = triangle_of_[3] = triangle_of_[5] = 6;
        for (std::uint32_t i = 6; i < points.size(); ++i)
            insert(i);
    }

    std::vector<glm::uvec3> triangles() const {
        std::vector<glm::uvec3> result;
        for (const auto& t : triangles_)
            result.emplace_back(t[0], t[1], t[2]);
        return result;
    }

private:
    using Three = std::array<std::uint32_t, 3>;

    // Positive if the plane through the sphere's centre and a, b leaves p on the left.
    double side(std::uint32_t a, std::uint32_t b, std::uint32_t p) const {
        return glm::dot(glm::cross(points_[a], points_[b]), points_[p]);
    }

    // On a spiral of even points a close one was inserted a Fibonacci number of steps ago.
    std::uint32_t start_for(std::uint32_t p) const {
        std::uint32_t best = p - 1;
        double nearest = glm::dot(points_[best], points_[p]);
        for (std::uint32_t f = 2, g = 3; f + 6 <= p; g += f, f = g - f)
            if (glm::dot(points_[p - f], points_[p]) > nearest) {
                nearest = glm::dot(points_[p - f], points_[p]);
                best = p - f;
            }
        return triangle_of_[best];
    }

    std::uint32_t locate(std::uint32_t p) const {
        std::uint32_t t = start_for(p);
        for (;;) {
            const Three& v = triangles_[t];
            int out = -1;
            for (int k = 0; k < 3 && out < 0; ++k)
                if (side(v[static_cast<std::size_t>((k + 1) % 3)],
                         v[static_cast<std::size_t>((k + 2) % 3)], p) < 0)
                    out = k;
            if (out < 0)
                return t;
            t = across_[t][static_cast<std::size_t>(out)];
        }
    }

    void replace_across(std::uint32_t t, std::uint32_t from, std::uint32_t to) {
        for (std::uint32_t& other : across_[t])
            if (other == from) {
                other = to;
                return;
            }
    }

    void insert(std::uint32_t p) {
        const std::uint32_t t0 = locate(p);
        const Three v = triangles_[t0];
        const Three n = across_[t0];
        const auto t1 = static_cast<std::uint32_t>(triangles_.size());
        const std::uint32_t t2 = t1 + 1;
        triangles_[t0] = {p, v[1], v[2]};
        triangles_.push_back({p, v[2], v[0]});
        triangles_.push_back({p, v[0], v[1]});
        across_[t0] = {n[0], t1, t2};
        across_.push_back({n[1], t2, t0});
        across_.push_back({n[2], t0, t1});
        replace_across(n[1], t0, t1);
        replace_across(n[2], t0, t2);
        triangle_of_[p] = t0;
        triangle_of_[v[0]] = t1;
        triangle_of_[v[1]] = triangle_of_[v[2]] = t0;
        std::vector<std::uint32_t> open = {t0, t1, t2};  // the new point is their first corner
        while (!open.empty()) {
            const std::uint32_t t = open.back();
            open.pop_back();
            flip_if_needed(t, open);
        }
    }

    void flip_if_needed(std::uint32_t t, std::vector<std::uint32_t>& open) {
        const std::uint32_t u = across_[t][0];
        const Three v = triangles_[t];
        std::size_t k = 0;
        while (across_[u][k] != t)
            ++k;
        const std::uint32_t d = triangles_[u][k];
        const glm::dvec3& a = points_[v[0]];
        if (glm::dot(glm::cross(points_[v[1]] - a, points_[v[2]] - a), points_[d] - a) <= 1e-15)
            return;
        // t is (p, v1, v2) and u is (d, v2, v1): they become (p, v1, d) and (p, d, v2).
        const std::uint32_t over_d_v1 = across_[u][(k + 1) % 3];
        const std::uint32_t over_d_v2 = across_[u][(k + 2) % 3];
        const std::uint32_t over_p_v2 = across_[t][1];
        triangles_[t] = {v[0], v[1], d};
        triangles_[u] = {v[0], d, v[2]};
        const std::uint32_t over_p_v1 = across_[t][2];
        across_[t] = {over_d_v1, u, over_p_v1};
        across_[u] = {over_d_v2, over_p_v2, t};
        replace_across(over_d_v1, u, t);
        replace_across(over_p_v2, t, u);
        triangle_of_[v[0]] = triangle_of_[v[1]] = triangle_of_[d] = t;
        triangle_of_[v[2]] = u;
        open.push_back(t);
        open.push_back(u);
    }

    const std::vector<glm::dvec3>& points_;
    std::vector<Three> triangles_;
    std::vector<Three> across_;
    std::vector<std::uint32_t> triangle_of_;
};

inline std::vector<glm::dvec3> axis_ends() {
    return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
}

/// `n` even points along a spiral from pole to pole (the ends of the axes are six of them).
inline std::vector<glm::dvec3> even_sphere_points(std::size_t n) {
    std::vector<glm::dvec3> points = axis_ends();
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (std::size_t i = 0; points.size() < n; ++i) {
        const double y = 1.0 - 2.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(n - 6);
        const double r = std::sqrt(1.0 - y * y);
        const double a = golden * static_cast<double>(i);
        points.emplace_back(r * std::cos(a), y, r * std::sin(a));
    }
    return points;
}

/// `n` points at random on the sphere, as uneven as that is.
inline std::vector<glm::dvec3> random_sphere_points(std::size_t n, std::uint64_t seed) {
    std::vector<glm::dvec3> points = axis_ends();
    Rng rng({.seed = seed});
    while (points.size() < n) {
        const glm::dvec3 p(rng.normal(), rng.normal(), rng.normal());
        points.push_back(glm::normalize(p));
    }
    return points;
}

/// Points of a sphere, triangulated there and then stretched.
inline meshing::TriMesh ellipsoid(const std::vector<glm::dvec3>& points, const glm::dvec3& axes) {
    meshing::TriMesh mesh;
    mesh.triangles = SphereDelaunay(points).triangles();
    for (const glm::dvec3& p : points)
        mesh.positions.emplace_back(p * axes);
    return mesh;
}

/// Mean curvature of the ellipsoid at a point of it.
inline double ellipsoid_mean_curvature(const glm::dvec3& p, const glm::dvec3& axes) {
    const glm::dvec3 squares = axes * axes;
    const glm::dvec3 gradient = p / squares;
    const double product = axes.x * axes.y * axes.z;
    return (squares.x + squares.y + squares.z - glm::dot(p, p)) /
           (2.0 * product * product * std::pow(glm::dot(gradient, gradient), 1.5));
}

/// A lumpy body without symmetry: a sphere of `n` even points, moved in and out by waves.
inline meshing::TriMesh lumpy_sphere(std::size_t n, double height = 0.12, unsigned seed = 1) {
    const std::vector<glm::dvec3> points = even_sphere_points(n);
    meshing::TriMesh mesh = ellipsoid(points, glm::dvec3(1.0));
    Rng rng({.seed = seed});
    std::array<glm::dvec4, 24> waves{};
    for (std::size_t i = 0; i < waves.size(); ++i) {
        const double frequency = 2.0 * std::pow(1.16, static_cast<double>(i));
        waves[i] = glm::dvec4(
            glm::normalize(glm::dvec3(rng.normal(), rng.normal(), rng.normal())) * frequency,
            rng.uniform(0.0, 6.3));
    }
    for (std::size_t i = 0; i < n; ++i) {
        double sum = 0.0;
        for (const glm::dvec4& w : waves)
            sum += std::sin(glm::dot(glm::dvec3(w), points[i]) + w.w) / glm::length(glm::dvec3(w));
        mesh.positions[i] = glm::vec3(points[i] * (1.0 + height * sum));
    }
    return mesh;
}

}  // namespace scree::test
