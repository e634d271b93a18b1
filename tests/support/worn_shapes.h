#pragma once

#include "tests/support/mesh_shapes.h"
#include "tests/support/sphere_meshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

namespace scree::test {

/// Least over greatest distance of a vertex from the mean of all.
inline double roundness(const meshing::TriMesh& mesh) {
    glm::dvec3 centre(0.0);
    for (const glm::vec3& p : mesh.positions)
        centre += glm::dvec3(p);
    centre /= static_cast<double>(mesh.positions.size());
    double low = 1e30;
    double high = 0.0;
    for (const glm::vec3& p : mesh.positions) {
        const double r = glm::distance(glm::dvec3(p), centre);
        low = std::min(low, r);
        high = std::max(high, r);
    }
    return low / high;
}

/// 1 for a sphere, less for everything else.
inline double sphericity(const meshing::TriMesh& mesh) {
    const double volume = meshing::signed_volume(mesh);
    return std::cbrt(std::numbers::pi) * std::pow(6.0 * volume, 2.0 / 3.0) /
           meshing::surface_area(mesh);
}

/// A round body with five prongs, like a hand.
inline meshing::TriMesh pronged(std::size_t n) {
    const auto points = even_sphere_points(n);
    meshing::TriMesh mesh = ellipsoid(points, glm::dvec3(1.0));
    for (std::size_t i = 0; i < n; ++i) {
        double length = 1.0;
        for (int k = 0; k < 5; ++k) {
            const double a = 0.7 * (k - 2);
            const glm::dvec3 finger(std::sin(a), std::cos(a), 0.0);
            length += 1.3 * std::exp(40.0 * (glm::dot(points[i], finger) - 1.0));
        }
        mesh.positions[i] = glm::vec3(points[i] * length);
    }
    return mesh;
}

/// A cube whose corner at (1, 1, 1) / 2 has triangles halved again and again.
inline meshing::TriMesh irregular_cube(int n, int levels) {
    meshing::TriMesh mesh = cube(n);
    const glm::vec3 corner(0.5F);
    for (int level = 0; level < levels; ++level) {
        // Every triangle at the corner is cut by a line between the middles of its two sides there;
        // what the corner loses is closed towards the old vertices.
        std::map<std::uint32_t, std::uint32_t> middles;
        std::vector<glm::uvec3> next;
        const auto at_corner = [&](std::uint32_t v) { return mesh.positions[v] == corner; };
        const auto middle = [&](std::uint32_t c, std::uint32_t v) {
            const auto [it, is_new] =
                middles.try_emplace(v, static_cast<std::uint32_t>(mesh.positions.size()));
            if (is_new)
                mesh.positions.push_back(0.5F * (mesh.positions[c] + mesh.positions[v]));
            return it->second;
        };
        for (glm::uvec3 t : mesh.triangles) {
            for (int k = 0; k < 2 && !at_corner(t.x); ++k)
                t = {t.y, t.z, t.x};
            if (!at_corner(t.x)) {
                next.push_back(t);
                continue;
            }
            const std::uint32_t b = middle(t.x, t.y);
            const std::uint32_t c = middle(t.x, t.z);
            next.emplace_back(t.x, b, c);
            next.emplace_back(b, t.y, t.z);
            next.emplace_back(b, t.z, c);
        }
        mesh.triangles = next;
    }
    return mesh;
}

}  // namespace scree::test
