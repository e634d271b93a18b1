#pragma once

#include <cstdint>
#include <vector>

#include <glm/ext/vector_uint3_sized.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree::meshing {

/// An indexed triangle mesh: right-handed, +Y up, metres, counter-clockwise seen from outside.
///
/// `normals` and `texcoords` are empty or as long as `positions`. Texture coordinates follow
/// glTF: (0, 0) is the top left of the picture.
struct TriMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> texcoords;
    std::vector<glm::uvec3> triangles;
};

/// Throw InvalidInput unless every index is in range, every number finite and every attribute
/// empty or complete.
void check_mesh(const TriMesh& mesh);

/// Volume by the divergence theorem, cubic metres; positive if closed and facing outwards.
double signed_volume(const TriMesh& mesh);

/// Sum of the triangles' areas, square metres.
double surface_area(const TriMesh& mesh);

}  // namespace scree::meshing
