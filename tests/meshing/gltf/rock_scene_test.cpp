#include "meshing/gltf/rock_scene.h"

#include "base/error.h"
#include "meshing/gltf/check_gltf.h"
#include "meshing/gltf/gltf_write.h"
#include "tests/support/glb_edit.h"
#include "tests/support/rock_samples.h"
#include "tests/support/sample_scenes.h"

#include <algorithm>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

using testing::HasSubstr;

struct Sample {
    vision::RockSet set = test::rock_set(12, 3, 480, 360);
    std::vector<RockMesh> rocks = build_rock_meshes(set);
};

void expect_sound(const GltfScene& scene) {
    for (const bool quantise : {false, true})
        for (const GltfFinding& finding : check_glb(encode_glb(scene, {.quantise = quantise})))
            ADD_FAILURE() << finding.where << " " << finding.what;
}

TEST(RockScene, EveryRockIsANamedNodeAtItsPlace) {
    const Sample sample;
    const GltfScene scene = rock_scene(sample.set, sample.rocks, test::sample_texture());
    ASSERT_EQ(scene.nodes.size(), 12U);
    EXPECT_EQ(scene.nodes[0].name, "rock-0001");
    EXPECT_EQ(scene.nodes[11].name, "rock-0012");
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        EXPECT_EQ(scene.nodes[i].transform.translation, sample.rocks[i].position);
    expect_sound(scene);
    const std::string json = test::json_of(encode_glb(scene));
    EXPECT_THAT(json, HasSubstr("\"label\":12"));
    EXPECT_THAT(json, HasSubstr("\"scale_known\":false"));
    EXPECT_THAT(json, HasSubstr("\"metres_per_pixel\":0.001"));
    EXPECT_THAT(json, HasSubstr("\"size_m\":[0.48,0.36]"));
    EXPECT_THAT(json, HasSubstr("\"inscribed_radius_m\""));
}

TEST(RockScene, LevelsOfDetailAreScenesOfTheirOwnOrOne) {
    const Sample sample;
    const auto chains = build_lod_chains(sample.rocks);
    const std::size_t n_levels = deepest_level(chains);
    ASSERT_GT(n_levels, 1U);
    std::size_t before = std::numeric_limits<std::size_t>::max();
    for (std::size_t level = 0; level < n_levels; ++level) {
        const GltfScene scene = rock_lod_scene(sample.set, sample.rocks, chains, level);
        std::size_t n_triangles = 0;
        for (const GltfMesh& mesh : scene.meshes)
            n_triangles += mesh.geometry.triangles.size();
        EXPECT_LT(n_triangles, before);
        before = n_triangles;
        expect_sound(scene);
    }
    const GltfScene all = rock_lods_scene(sample.set, sample.rocks, chains);
    EXPECT_EQ(all.nodes[3].coarser.size(), chains[3].size() - 1);
    EXPECT_EQ(all.nodes[static_cast<std::size_t>(all.nodes[3].coarser[0])].name, "rock-0004-lod1");
    expect_sound(all);
}

TEST(RockScene, LodsJsonStatesErrorsInMetres) {
    const Sample sample;
    const auto chains = build_lod_chains(sample.rocks, {.levels = 2});
    ASSERT_EQ(deepest_level(chains), 2U);
    const std::string json = lods_json(sample.rocks, chains, {"lod0.glb", "lod1.glb"});
    EXPECT_THAT(json, HasSubstr("\"format\":\"scree-lods\""));
    EXPECT_THAT(json, HasSubstr("\"file\":\"lod1.glb\""));
    EXPECT_THAT(json, HasSubstr("\"name\":\"rock-0012\",\"error_m\":[0,"));
    EXPECT_THAT(json, HasSubstr("\"error_m\":0.0,"));
    EXPECT_THROW(lods_json(sample.rocks, chains, {"lod0.glb"}), InvalidInput);
}

TEST(RockScene, PatchesKeepEveryCopy) {
    const Sample sample;
    const RockPatch patch = scatter_rocks(sample.rocks, 150, {.prototypes = 5});
    const GltfScene scene = patch_scene(sample.set, sample.rocks, patch, test::sample_texture());
    std::size_t n_copies = 0;
    for (const GltfNode& node : scene.nodes)
        n_copies += node.instances.size();
    EXPECT_EQ(n_copies, patch.instances.size());
    expect_sound(scene);
    EXPECT_THAT(test::json_of(encode_glb(scene)), HasSubstr("\"coverage\":"));
}

TEST(RockScene, NoRocksMakeAnEmptyFile) {
    const vision::RockSet set = test::empty_picture(20, 10, 0.001);
    expect_sound(rock_scene(set, {}));
    expect_sound(rock_lods_scene(set, {}, {}));
    expect_sound(patch_scene(set, {}, {}));
    EXPECT_EQ(deepest_level({}), 0U);
}

TEST(RockSceneErrors, NameWhatDoesNotExist) {
    Sample sample;
    EXPECT_THROW(rock_lod_scene(sample.set, sample.rocks, {}, 0), InvalidInput);
    RockPatch patch;
    patch.prototypes = {77};
    EXPECT_THAT([&] { patch_scene(sample.set, sample.rocks, patch); },
                testing::ThrowsMessage<InvalidInput>("the patch uses mesh 77, there are 12"));
    patch.prototypes = {1};
    patch.instances.push_back({.prototype = 3, .translation = {}, .rotation = {1, 0, 0, 0}});
    EXPECT_THROW(patch_scene(sample.set, sample.rocks, patch), InvalidInput);
    sample.rocks[4].source = 99;
    EXPECT_THAT([&] { rock_scene(sample.set, sample.rocks); },
                testing::ThrowsMessage<InvalidInput>("a mesh names rock 99, the set has 12"));
}

}  // namespace
}  // namespace scree::meshing
