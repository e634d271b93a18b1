#pragma once

#include "meshing/mesh/tri_mesh.h"
#include "terrain/fluid/point_cells.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/vec3.hpp>

namespace scree::terrain {

/// Nearest place of a surface.
struct SurfaceHit {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t triangle = kNone;
    glm::vec3 point{0.0F};
    glm::vec3 normal{0.0F};  ///< From the point to the front, unit length.
    float distance = 0.0F;   ///< Signed, metres; negative behind the faces.

    bool found() const { return triangle != kNone; }
};

/// A surface element that a sphere may press against.
struct ContactPlane {
    std::uint32_t triangle = SurfaceHit::kNone;
    glm::vec3 point{0.0F};
    glm::vec3 normal{0.0F};
};

/// Up to three planes around a point, nearest first.
struct ContactPlanes {
    ContactPlane planes[3];
    int count = 0;
};

/// Triangles sorted into the cells that their boxes overlap, in flat arrays.
///
/// Front is the side from which a triangle's corners run counter-clockwise.
class TriangleGrid {
public:
    TriangleGrid() = default;
    /// @param cell  Least edge of a cell, metres; larger for large triangles.
    /// @throw InvalidInput  check_mesh() refuses the mesh, or it has no triangle.
    TriangleGrid(const meshing::TriMesh& mesh, float cell);

    std::size_t n_triangles() const { return corners_.size() / 3; }

    /// The nearest surface point within `reach`. Of triangles that share it, the one whose plane
    /// is farthest from the point decides the side, which makes the sign right at edges and
    /// corners.
    SurfaceHit nearest(const glm::vec3& point, float reach) const;

    /// Planes of the surface within `reach`, those that face nearly the same way merged.
    /// A point behind the surface has them too, pointing out.
    ContactPlanes contacts(const glm::vec3& point, float reach) const;

    /// Share 0 to 1 of the way from `from` to `to` that is free: where it first passes from the
    /// front of a triangle to its back, 1 if nowhere. Leaving the solid is always free.
    float free_share(const glm::vec3& from, const glm::vec3& to) const;

    /// The point lies in the solid: straight up, the surface is left more often than entered. True
    /// below an open sheet that faces up as well.
    bool buried(const glm::vec3& point) const;

private:
    struct Ball {
        glm::vec3 centre{0.0F};
        float radius = 0.0F;
    };

    template <class Visit>
    void triangles_in(const glm::vec3& low, const glm::vec3& high, Visit&& visit) const;
    bool out_of_reach(std::uint32_t triangle, const glm::vec3& point, float reach) const;
    SurfaceHit closest_on(std::uint32_t triangle, const glm::vec3& point) const;
    void fill_cells();

    PointGrid grid_;
    glm::vec3 low_{0.0F}, high_{0.0F};
    std::vector<glm::vec3> corners_;  ///< Three a triangle.
    std::vector<glm::vec3> normals_;  ///< Unit; zero for a triangle without area.
    std::vector<Ball> balls_;         ///< Around each triangle.
    std::vector<glm::ivec3> firsts_;  ///< First cell of each triangle's box.
    std::vector<glm::ivec3> lasts_;   ///< Last cell of each triangle's box.
    std::vector<std::uint32_t> starts_;
    std::vector<std::uint32_t> items_;
};

}  // namespace scree::terrain
