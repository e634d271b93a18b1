#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <array>
#include <cstddef>

#include <glm/vec2.hpp>

namespace scree::meshing {

inline constexpr std::size_t kSilhouetteCorners = 64;

/// What a rock covers on the ground about its own centre: a polygon with a corner at every 1/64 of
/// a turn, azimuth 0 along +x and growing towards +z. It holds the whole rock seen from above.
struct Silhouette {
    std::array<glm::vec2, kSilhouetteCorners> corners{};  ///< (x, z), metres.
    float radius = 0.0F;                                  ///< Farthest corner from the centre.
};

/// Silhouette of a mesh that is star-shaped about its origin, from above. A corner lies as far out
/// as the mesh reaches within 1/64 of a turn to either side.
/// @throw InvalidInput  check_mesh() refuses the mesh, or it covers no ground about its origin.
Silhouette silhouette_of(const TriMesh& mesh);

/// The same rock grown by `scale` and turned by `yaw` radians about +y (as a glTF rotation does:
/// +z turns to +x).
Silhouette placed(const Silhouette& silhouette, double scale, double yaw);

/// Area inside, square metres.
double area_of(const Silhouette& silhouette);

/// Whether two silhouettes share a point, the second one's centre lying at `offset` from the
/// first's. Exact on the polygons.
bool overlap(const Silhouette& first, const Silhouette& second, glm::vec2 offset);

}  // namespace scree::meshing
