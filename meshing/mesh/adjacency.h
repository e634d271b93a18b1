#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace scree::meshing {

/// What happens to the vertices on the rim of an open mesh (`mesh-erosion.md` 1.1).
enum class RimPolicy {
    Pinned,      ///< They never move.
    NormalOnly,  ///< They move against their normal only.
    Free,        ///< They move as every other vertex, so the rim shrinks.
};

inline constexpr std::string_view kRimPolicyNames[] = {"pinned", "normal-only", "free"};

constexpr std::span<const std::string_view> names_of(RimPolicy) {
    return kRimPolicyNames;
}

inline constexpr std::uint32_t kNoFace = 0xFFFFFFFFU;

/// Who touches whom, in flat arrays: the lists of all vertices one after the other, and where each
/// begins. About 58 bytes a vertex.
///
/// A corner is 3 * triangle + (0, 1 or 2). Lists run counter-clockwise seen from outside: neighbour
/// j of a vertex lies before corner j and neighbour j + 1 after it. A vertex on the rim starts at
/// the rim and has one neighbour more than corners. Where the mesh is no manifold (a vertex
/// with several fans, an edge with three triangles) the fans follow each other and only the
/// sets are promised; `irregular` marks those vertices.
struct Adjacency {
    std::vector<std::uint32_t> first_corner;     ///< One more than vertices.
    std::vector<std::uint32_t> corners;          ///< One a corner of the mesh.
    std::vector<std::uint32_t> first_neighbour;  ///< One more than vertices.
    std::vector<std::uint32_t> neighbours;       ///< Every neighbour of a vertex once.
    std::vector<std::uint8_t> rim;        ///< 1 where some edge has not two opposed triangles.
    std::vector<std::uint8_t> irregular;  ///< 1 where the triangles are not one simple fan.

    std::size_t n_vertices() const { return rim.size(); }
    std::size_t n_edges() const { return neighbours.size() / 2; }  ///< Undirected.

    std::span<const std::uint32_t> corners_of(std::size_t vertex) const {
        return {corners.data() + first_corner[vertex], corners.data() + first_corner[vertex + 1]};
    }
    std::span<const std::uint32_t> neighbours_of(std::size_t vertex) const {
        return {neighbours.data() + first_neighbour[vertex],
                neighbours.data() + first_neighbour[vertex + 1]};
    }
};

/// The three vertices of a corner's triangle, its own first.
inline glm::uvec3 vertices_from(const TriMesh& mesh, std::uint32_t corner) {
    const glm::uvec3& t = mesh.triangles[corner / 3];
    switch (corner % 3) {
        case 0:
            return t;
        case 1:
            return {t.y, t.z, t.x};
        default:
            return {t.z, t.x, t.y};
    }
}

/// Find the neighbourhoods of a mesh; its positions do not matter.
///
/// Runs in parallel, the same lists for any number of threads.
/// @throw InvalidInput  an index out of range, a triangle that names a vertex twice, or more than
///                      2^30 triangles.
Adjacency build_adjacency(const TriMesh& mesh);

/// The triangle on the other side of the edge that faces a corner; kNoFace on a rim. Where more
/// than two triangles meet, the first of the others.
std::uint32_t triangle_across(const TriMesh& mesh, const Adjacency& adjacency,
                              std::uint32_t corner);

/// Mean length of the undirected edges, metres; 0 without edges.
double mean_edge_length(const TriMesh& mesh, const Adjacency& adjacency);

}  // namespace scree::meshing
