#include "meshing/rocks/patch_culling.h"

#include "base/error.h"
#include "base/simd.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace scree::meshing {
namespace {

// Inward planes of the view: a point is inside if the product with (x, y, z, 1) is positive.
std::array<glm::vec4, 6> planes_of(const glm::mat4& clip_from_world) {
    const glm::mat4 rows = glm::transpose(clip_from_world);
    std::array<glm::vec4, 6> planes = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                       rows[3] - rows[1], rows[3] + rows[2], rows[3] - rows[2]};
    for (glm::vec4& plane : planes) {
        const float length = glm::length(glm::vec3(plane));
        plane /= length > 0.0F ? length : 1.0F;
    }
    return planes;
}

SCREE_MULTIVERSION
void drop_behind(const InstanceSpheres& spheres, const glm::vec4& plane,
                 std::vector<std::uint8_t>& inside) {
    const float* x = spheres.x.data();
    const float* y = spheres.y.data();
    const float* z = spheres.z.data();
    const float* radius = spheres.radius.data();
    std::uint8_t* out = inside.data();
    const glm::vec4 p = plane;
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const float distance = p.x * x[i] + p.y * y[i] + p.z * z[i] + p.w;
        out[i] = static_cast<std::uint8_t>(out[i] & (distance >= -radius[i] ? 1 : 0));
    }
}

}  // namespace

InstanceSpheres instance_spheres(const RockPatch& patch, const std::vector<RockMesh>& rocks) {
    InstanceSpheres spheres;
    spheres.x.reserve(patch.instances.size());
    spheres.y.reserve(patch.instances.size());
    spheres.z.reserve(patch.instances.size());
    spheres.radius.reserve(patch.instances.size());
    for (const PatchInstance& instance : patch.instances) {
        if (instance.prototype >= patch.prototypes.size() ||
            patch.prototypes[instance.prototype] >= rocks.size())
            fail<InvalidInput>("an instance names prototype ", instance.prototype, " of ",
                               patch.prototypes.size(), ", made from ", rocks.size(), " meshes");
        const RockMesh& rock = rocks[patch.prototypes[instance.prototype]];
        const glm::vec3 scale = instance.scale;
        spheres.x.push_back(instance.translation.x);
        spheres.y.push_back(instance.translation.y);
        spheres.z.push_back(instance.translation.z);
        spheres.radius.push_back(rock.bounding_radius * std::max({scale.x, scale.y, scale.z}));
    }
    return spheres;
}

std::vector<std::uint32_t> visible_instances(const InstanceSpheres& spheres,
                                             const glm::mat4& clip_from_world) {
    const std::size_t n = spheres.radius.size();
    std::vector<std::uint8_t> inside(n, 1);
    for (const glm::vec4& plane : planes_of(clip_from_world))
        drop_behind(spheres, plane, inside);
    std::vector<std::uint32_t> visible;
    visible.reserve(static_cast<std::size_t>(std::count(inside.begin(), inside.end(), 1)));
    for (std::uint32_t i = 0; i < n; ++i)
        if (inside[i] != 0)
            visible.push_back(i);
    return visible;
}

}  // namespace scree::meshing
