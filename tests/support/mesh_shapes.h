#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

namespace scree::test {

/// A sphere about the origin: an icosahedron whose triangles are split in four `levels` times.
inline meshing::TriMesh icosphere(int levels, float radius = 1.0F) {
    const float g = (1.0F + std::sqrt(5.0F)) / 2.0F;
    meshing::TriMesh mesh;
    mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [it, is_new] = middles.try_emplace(
                std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
            if (is_new)
                mesh.positions.push_back(glm::normalize(mesh.positions[a]) +
                                         glm::normalize(mesh.positions[b]));
            return it->second;
        };
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& t : mesh.triangles) {
            const std::uint32_t a = middle(t.x, t.y);
            const std::uint32_t b = middle(t.y, t.z);
            const std::uint32_t c = middle(t.z, t.x);
            for (const glm::uvec3& child : {glm::uvec3(t.x, a, c), glm::uvec3(t.y, b, a),
                                            glm::uvec3(t.z, c, b), glm::uvec3(a, b, c)})
                finer.push_back(child);
        }
        mesh.triangles = finer;
    }
    for (glm::vec3& p : mesh.positions)
        p = glm::vec3(glm::normalize(glm::dvec3(p)) * static_cast<double>(radius));
    return mesh;
}

/// A torus about the y axis, `n_around` by `n_tube` quads of two triangles.
inline meshing::TriMesh torus(double ring_radius, double tube_radius, std::uint32_t n_around,
                              std::uint32_t n_tube) {
    meshing::TriMesh mesh;
    for (std::uint32_t i = 0; i < n_around; ++i)
        for (std::uint32_t j = 0; j < n_tube; ++j) {
            const double a = 2 * std::numbers::pi * i / n_around;
            const double b = 2 * std::numbers::pi * j / n_tube;
            const double r = ring_radius + tube_radius * std::cos(b);
            mesh.positions.emplace_back(r * std::cos(a), tube_radius * std::sin(b),
                                        -r * std::sin(a));
            const auto at = [&](std::uint32_t x, std::uint32_t y) {
                return (x % n_around) * n_tube + y % n_tube;
            };
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    return mesh;
}

/// A square sheet in the plane y = 0 facing up, `n` by `n` quads of edge `step`.
inline meshing::TriMesh sheet(std::uint32_t n, float step = 1.0F) {
    meshing::TriMesh mesh;
    for (std::uint32_t z = 0; z <= n; ++z)
        for (std::uint32_t x = 0; x <= n; ++x)
            mesh.positions.emplace_back(static_cast<float>(x) * step, 0.0F,
                                        static_cast<float>(z) * step);
    for (std::uint32_t z = 0; z < n; ++z)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = z * (n + 1) + x;
            mesh.triangles.emplace_back(a, a + n + 1, a + n + 2);
            mesh.triangles.emplace_back(a, a + n + 2, a + 1);
        }
    return mesh;
}

/// An upright cylinder without lids about the y axis.
inline meshing::TriMesh tube(double radius, double height, std::uint32_t n_around,
                             std::uint32_t n_up) {
    meshing::TriMesh mesh;
    for (std::uint32_t j = 0; j <= n_up; ++j)
        for (std::uint32_t i = 0; i < n_around; ++i) {
            const double a = 2 * std::numbers::pi * i / n_around;
            mesh.positions.emplace_back(radius * std::cos(a), height * j / n_up,
                                        -radius * std::sin(a));
        }
    for (std::uint32_t j = 0; j < n_up; ++j)
        for (std::uint32_t i = 0; i < n_around; ++i) {
            const std::uint32_t a = j * n_around + i;
            const std::uint32_t b = j * n_around + (i + 1) % n_around;
            mesh.triangles.emplace_back(a, b, b + n_around);
            mesh.triangles.emplace_back(a, b + n_around, a + n_around);
        }
    return mesh;
}

/// A closed cube about the origin, `n` by `n` quads a side, diagonals alternating.
inline meshing::TriMesh cube(int n, float side = 1.0F) {
    meshing::TriMesh mesh;
    std::map<std::tuple<int, int, int>, std::uint32_t> known;
    const auto vertex = [&](const glm::ivec3& p) {
        const auto [it, is_new] =
            known.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(mesh.positions.size()));
        if (is_new)
            mesh.positions.push_back((glm::vec3(p) / static_cast<float>(n) - 0.5F) * side);
        return it->second;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (int end = 0; end < 2; ++end)
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const auto at = [&](int u, int v) {
                        glm::ivec3 p(0);
                        p[axis] = end * n;
                        p[(axis + 1) % 3] = end == 1 ? u : v;
                        p[(axis + 2) % 3] = end == 1 ? v : u;
                        return vertex(p);
                    };
                    const std::uint32_t a = at(i, j);
                    const std::uint32_t b = at(i + 1, j);
                    const std::uint32_t c = at(i + 1, j + 1);
                    const std::uint32_t d = at(i, j + 1);
                    if ((i + j) % 2 == 0) {
                        mesh.triangles.emplace_back(a, b, c);
                        mesh.triangles.emplace_back(a, c, d);
                    } else {
                        mesh.triangles.emplace_back(a, b, d);
                        mesh.triangles.emplace_back(b, c, d);
                    }
                }
    return mesh;
}

/// The same triangles seen from the other side.
inline meshing::TriMesh flipped(meshing::TriMesh mesh) {
    for (glm::uvec3& t : mesh.triangles)
        std::swap(t.y, t.z);
    return mesh;
}

}  // namespace scree::test
