#include "meshing/mesh/half_edge_patch.h"

#include <algorithm>

namespace scree::meshing {
namespace {

// The triangles around the core, in order, with vertices numbered in their order of the mesh.
TriMesh cut_out(const TriMesh& mesh, const Adjacency& adjacency,
                const std::vector<std::uint32_t>& core, std::vector<std::uint32_t>& triangles,
                std::vector<std::uint32_t>& vertices) {
    for (const std::uint32_t v : core)
        for (const std::uint32_t c : adjacency.corners_of(v))
            triangles.push_back(c / 3);
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    for (const std::uint32_t t : triangles)
        for (int k = 0; k < 3; ++k)
            vertices.push_back(mesh.triangles[t][k]);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const auto local = [&](std::uint32_t v) {
        return static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), v) -
                                          vertices.begin());
    };
    TriMesh part;
    for (const std::uint32_t v : vertices)
        part.positions.push_back(mesh.positions[v]);
    for (const std::uint32_t t : triangles) {
        const glm::uvec3& old = mesh.triangles[t];
        part.triangles.emplace_back(local(old.x), local(old.y), local(old.z));
    }
    return part;
}

}  // namespace

HalfEdgePatch::HalfEdgePatch(const TriMesh& mesh, const Adjacency& adjacency,
                             const std::vector<std::uint32_t>& core) {
    std::vector<std::uint32_t> vertices;
    const TriMesh part = cut_out(mesh, adjacency, core, triangle, vertices);
    const Adjacency around = build_adjacency(part);
    // A vertex on the border may join several fans of the patch: half-edges need one vertex each.
    std::vector<Mesh::VertexHandle> handle_of_corner(3 * part.triangles.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        const bool inside = std::binary_search(core.begin(), core.end(), vertices[v]);
        std::uint32_t last = kNoFace;
        Mesh::VertexHandle handle;
        for (const std::uint32_t c : around.corners_of(v)) {
            const glm::uvec3 t = vertices_from(part, c);
            if (t.y != last) {
                handle = edges.add_vertex();
                vertex.push_back(vertices[v]);
                position.push_back(part.positions[v]);
                is_free.push_back(inside ? 1 : 0);
                if (inside)
                    handle_of_[vertices[v]] = handle.idx();
            }
            handle_of_corner[c] = handle;
            last = t.z;
        }
    }
    for (std::size_t t = 0; t < part.triangles.size(); ++t) {
        const auto face = edges.add_face(handle_of_corner[3 * t], handle_of_corner[3 * t + 1],
                                         handle_of_corner[3 * t + 2]);
        whole = whole && face.is_valid();
    }
    edges.request_vertex_status();
    edges.request_edge_status();
    edges.request_halfedge_status();
    edges.request_face_status();
}

OpenMesh::SmartVertexHandle HalfEdgePatch::find(std::uint32_t vertex_of_mesh) const {
    const auto found = handle_of_.find(vertex_of_mesh);
    return OpenMesh::make_smart(
        OpenMesh::VertexHandle(found == handle_of_.end() ? -1 : found->second), edges);
}

}  // namespace scree::meshing
