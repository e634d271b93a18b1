#pragma once

// Behind remove_small_faces() alone; not installed.

#include "meshing/mesh/adjacency.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>

namespace scree::meshing {

/// Some triangles of a mesh as half-edges. A vertex is free if all its triangles are here; the
/// others stand on the border and stay as they are.
class HalfEdgePatch {
public:
    using Mesh = OpenMesh::TriConnectivity;

    /// All triangles around the `core` vertices, which are in order and regular.
    HalfEdgePatch(const TriMesh& mesh, const Adjacency& adjacency,
                  const std::vector<std::uint32_t>& core);

    Mesh edges;
    std::vector<std::uint32_t> vertex;    ///< Index in the mesh, of every half-edge vertex.
    std::vector<glm::vec3> position;      ///< Of every half-edge vertex.
    std::vector<std::uint32_t> triangle;  ///< Index in the mesh, of every face.
    std::vector<std::uint8_t> is_free;    ///< Of every half-edge vertex.
    bool whole = true;                    ///< False if some triangle could not be added.

    /// The half-edge vertex of a free vertex of the mesh; invalid if it is not free.
    OpenMesh::SmartVertexHandle find(std::uint32_t vertex_of_mesh) const;

    const glm::vec3& at(OpenMesh::VertexHandle v) const {
        return position[static_cast<std::size_t>(v.idx())];
    }
    std::uint32_t name(OpenMesh::VertexHandle v) const {
        return vertex[static_cast<std::size_t>(v.idx())];
    }
    bool free(OpenMesh::VertexHandle v) const {
        return is_free[static_cast<std::size_t>(v.idx())] != 0;
    }

private:
    std::unordered_map<std::uint32_t, int> handle_of_;
};

}  // namespace scree::meshing
