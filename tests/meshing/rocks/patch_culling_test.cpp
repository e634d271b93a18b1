#include "meshing/rocks/patch_culling.h"

#include "base/error.h"
#include "tests/support/rock_samples.h"

#include <algorithm>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

const glm::mat4 kView = glm::perspective(0.8F, 1.5F, 0.1F, 20.0F) *
                        glm::lookAt(glm::vec3(0, 1.5F, 3), glm::vec3(0, 0, -1), glm::vec3(0, 1, 0));

bool in_view(const glm::vec3& p) {
    const glm::vec4 c = kView * glm::vec4(p, 1.0F);
    return std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}) <= c.w;
}

TEST(PatchCulling, KeepsEveryInstanceWithAVertexInView) {
    const auto rocks = build_rock_meshes(test::rock_set(60, 5), {.max_segments = 8});
    const RockPatch patch = repeat_rocks(rocks, {0.9, 0.6}, 10, 10);
    const auto visible = visible_instances(instance_spheres(patch, rocks), kView);
    EXPECT_TRUE(std::is_sorted(visible.begin(), visible.end()));
    EXPECT_GT(visible.size(), patch.instances.size() / 20);
    EXPECT_LT(visible.size(), patch.instances.size() / 2);
    for (std::uint32_t i = 0; i < patch.instances.size(); ++i) {
        const PatchInstance& instance = patch.instances[i];
        const TriMesh& mesh = rocks[instance.prototype].mesh;
        const bool shown =
            std::any_of(mesh.positions.begin(), mesh.positions.end(),
                        [&](const glm::vec3& p) { return in_view(p + instance.translation); });
        EXPECT_TRUE(!shown || std::binary_search(visible.begin(), visible.end(), i)) << i;
    }
}

TEST(PatchCulling, DropsWhatLiesBehindTheEye) {
    InstanceSpheres spheres;
    spheres.x = {0, 0, 0};
    spheres.y = {0, 1.5F, 0};
    spheres.z = {0, 9, 4};
    spheres.radius = {0.1F, 0.1F, 3.0F};
    EXPECT_EQ(visible_instances(spheres, kView), (std::vector<std::uint32_t>{0, 2}));
    EXPECT_TRUE(visible_instances({}, kView).empty());
}

TEST(PatchCulling, RefusesAMissingPrototype) {
    const auto rocks = build_rock_meshes(test::rock_set(2, 5));
    RockPatch patch = repeat_rocks(rocks, {1, 1}, 1, 1);
    patch.instances[0].prototype = 9;
    EXPECT_THAT([&] { instance_spheres(patch, rocks); },
                testing::ThrowsMessage<InvalidInput>(
                    "an instance names prototype 9 of 2, made from 2 meshes"));
}

}  // namespace
}  // namespace scree::meshing
