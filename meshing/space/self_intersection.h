#pragma once

#include "meshing/mesh/adjacency.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scree::meshing {

/// Two triangles of a mesh that cross, touch or lie folded onto each other; a < b.
struct TrianglePair {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    friend auto operator<=>(const TrianglePair&, const TrianglePair&) = default;
};

/// Where a mesh meets itself other than along its shared edges and vertices.
struct SelfIntersections {
    std::vector<TrianglePair> pairs;  ///< In order.
    bool complete = true;  ///< False if the search stopped at its limit, or over a vertex with
                           ///< thousands of triangles that could not be looked through.
};

/// Finds self-intersections of a mesh again and again while its vertices move.
///
/// Triangles lie eight by eight in the leaves of a tree of boxes; its shape is kept from call to
/// call and only the boxes are measured again. Triangles that share a vertex need no test where
/// all around it can be looked at from one direction without overlap; that is proved vertex by
/// vertex first. What remains is decided by exact predicates. About 70 bytes a vertex.
class SelfIntersectionFinder {
public:
    /// Runs in parallel, the same pairs for any number of threads.
    ///
    /// Vertices count as shared by their index: weld meshes with seams first. Triangles without
    /// area are left out.
    /// @param limit  Stop looking once a piece of the work has found so many pairs.
    /// @pre   The adjacency is the mesh's own.
    /// @throw InvalidInput  the adjacency is another mesh's.
    SelfIntersections find(const TriMesh& mesh, const Adjacency& adjacency,
                           std::size_t limit = 100'000);

    /// Triangles have been dropped and those that remain kept their order: keep the tree's order
    /// too. `kept` names the survivors by their old indices.
    void compact(const std::vector<std::uint32_t>& kept);

private:
    static constexpr std::size_t kLeafSize = 8;
    struct Box {
        glm::vec3 low;
        glm::vec3 high;
    };
    // Boxes on a grid of 16 bits over the whole mesh, rounded outwards: eight comparisons at once.
    struct Leaf {
        std::int16_t low_x[kLeafSize], low_y[kLeafSize], low_z[kLeafSize];
        std::int16_t high_x[kLeafSize], high_y[kLeafSize], high_z[kLeafSize];
        std::uint32_t a[kLeafSize], b[kLeafSize], c[kLeafSize];  ///< Vertices.
    };
    using Found = std::vector<TrianglePair>;

    void order_triangles(const TriMesh& mesh);
    void measure_leaves(const TriMesh& mesh);
    void place_leaves(std::size_t node, std::size_t first_leaf, std::size_t last_leaf);
    void join_boxes(std::size_t node, std::size_t first_leaf, std::size_t last_leaf);
    void search_from(const TriMesh& mesh, std::size_t leaf, Found& found) const;
    void search_pair(const TriMesh& mesh, std::size_t leaf, std::size_t other, Found& found) const;
    static unsigned candidates(const Leaf& leaf, std::size_t place, const Leaf& other);

    std::vector<std::uint32_t> order_;
    std::vector<Leaf> leaves_;
    std::vector<std::uint32_t> node_of_leaf_;
    std::vector<Box> nodes_;  ///< In the order of a walk: a node, its first half, its second half.
};

/// One search.
SelfIntersections find_self_intersections(const TriMesh& mesh, const Adjacency& adjacency,
                                          std::size_t limit = 100'000);

}  // namespace scree::meshing
