#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace scree::test {

/// A rectangle of n x m squares from `corner` along u and v; it faces u x v.
inline void append_sheet(meshing::TriMesh& mesh, const glm::vec3& corner, const glm::vec3& u,
                         const glm::vec3& v, unsigned n, unsigned m) {
    const auto base = static_cast<unsigned>(mesh.positions.size());
    for (unsigned j = 0; j <= m; ++j)
        for (unsigned i = 0; i <= n; ++i)
            mesh.positions.push_back(corner + u * (static_cast<float>(i) / static_cast<float>(n)) +
                                     v * (static_cast<float>(j) / static_cast<float>(m)));
    for (unsigned j = 0; j < m; ++j)
        for (unsigned i = 0; i < n; ++i) {
            const unsigned a = base + j * (n + 1) + i;
            const unsigned b = a + n + 1;
            mesh.triangles.emplace_back(a, a + 1, b);
            mesh.triangles.emplace_back(a + 1, b + 1, b);
        }
}

/// Level ground of the given half width about the origin, facing up.
inline meshing::TriMesh level_ground(float half, unsigned n) {
    meshing::TriMesh mesh;
    append_sheet(mesh, {-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}, n, n);
    return mesh;
}

/// An open box that faces inwards, its floor at y = 0, its corner at the origin.
inline meshing::TriMesh tub(const glm::vec3& size, unsigned n) {
    const glm::vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    meshing::TriMesh mesh;
    append_sheet(mesh, {0, 0, 0}, z, x, n, n);  // floor
    append_sheet(mesh, {0, 0, 0}, y, z, n, n);  // x = 0, faces +x
    append_sheet(mesh, x, z, y, n, n);          // faces -x
    append_sheet(mesh, {0, 0, 0}, x, y, n, n);  // z = 0, faces +z
    append_sheet(mesh, z, y, x, n, n);          // faces -z
    return mesh;
}

/// A closed cube about a centre, facing outwards.
inline meshing::TriMesh block(const glm::vec3& centre, float edge, unsigned n) {
    const glm::vec3 low = centre - 0.5F * edge;
    const glm::vec3 x(edge, 0, 0), y(0, edge, 0), z(0, 0, edge);
    meshing::TriMesh mesh;
    append_sheet(mesh, low, x, z, n, n);
    append_sheet(mesh, low + y, z, x, n, n);
    append_sheet(mesh, low, z, y, n, n);
    append_sheet(mesh, low + x, y, z, n, n);
    append_sheet(mesh, low, y, x, n, n);
    append_sheet(mesh, low + z, x, y, n, n);
    return mesh;
}

}  // namespace scree::test
