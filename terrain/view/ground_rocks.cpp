#include "terrain/view/ground_rocks.h"

#include "meshing/gltf/gltf_read.h"

#include <utility>

#include <glm/ext/matrix_transform.hpp>

namespace scree::terrain {

GroundRocks read_ground_rocks(const std::filesystem::path& file, const Heightfield& ground) {
    meshing::LoadedGltf loaded =
        meshing::read_glb(file, {.max_vertices = 5'000'000, .max_triangles = 10'000'000});
    GroundRocks rocks;
    for (meshing::GltfMesh& mesh : loaded.meshes)
        rocks.meshes.push_back(std::move(mesh.geometry));
    const glm::dvec3 middle(0.5 * ground.cell_size * ground.heights.width(), 0.0,
                            0.5 * ground.cell_size * ground.heights.height());
    const glm::dmat4 to_middle = glm::translate(glm::dmat4(1.0), middle);
    for (const meshing::GltfPlacement& placement : loaded.placements)
        rocks.places.push_back({placement.mesh, glm::mat4(to_middle * placement.world_from_mesh)});
    return rocks;
}

}  // namespace scree::terrain
