#include "meshing/gltf/gltf_scene.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace scree::meshing {
namespace {

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool usable(const GltfTransform& t) {
    const glm::quat& q = t.rotation;
    const double length =
        std::sqrt(double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z + double(q.w) * q.w);
    return finite(t.translation) && finite(t.scale) && std::abs(length - 1.0) < 1e-3;
}

void check_node(const GltfScene& scene, std::size_t index) {
    const GltfNode& node = scene.nodes[index];
    const auto n_meshes = static_cast<int>(scene.meshes.size());
    if (node.mesh < -1 || node.mesh >= n_meshes)
        fail<InvalidInput>("node ", index, " names mesh ", node.mesh, ", the scene has ", n_meshes);
    if (!node.instances.empty() && node.mesh < 0)
        fail<InvalidInput>("node ", index, " has copies but no mesh");
    if (!usable(node.transform) ||
        !std::all_of(node.instances.begin(), node.instances.end(), usable))
        fail<InvalidInput>("node ", index,
                           " is placed by numbers that are not finite or a rotation that is not "
                           "of unit length");
    for (const int coarser : node.coarser)
        if (coarser < 0 || coarser >= static_cast<int>(scene.nodes.size()) ||
            coarser == static_cast<int>(index))
            fail<InvalidInput>("node ", index, " names coarser node ", coarser, ", the scene has ",
                               scene.nodes.size());
}

}  // namespace

void check_scene(const GltfScene& scene) {
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const TriMesh& mesh = scene.meshes[i].geometry;
        check_mesh(mesh);
        if (mesh.triangles.empty())
            fail<InvalidInput>("mesh ", i, " (", scene.meshes[i].name, ") has no triangles");
        const std::size_t n_colours = scene.meshes[i].colours.size();
        if (n_colours != 0 && n_colours != mesh.positions.size())
            fail<InvalidInput>("mesh ", i, " has ", mesh.positions.size(), " vertices but ",
                               n_colours, " colours");
        for (const glm::vec2& t : mesh.texcoords)
            if (!std::isfinite(t.x) || !std::isfinite(t.y))
                fail<InvalidInput>("mesh ", i, " has a texture coordinate that is no number");
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        check_node(scene, i);
}

}  // namespace scree::meshing
