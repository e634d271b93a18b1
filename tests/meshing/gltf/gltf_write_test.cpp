#include "meshing/gltf/gltf_write.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/gltf/check_gltf.h"
#include "tests/support/glb_edit.h"
#include "tests/support/sample_scenes.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

GltfScene one_stone() {
    GltfScene scene;
    scene.meshes.push_back({"stone", test::stone(2, 0.02F, 1)});
    GltfNode node;
    node.name = "stone";
    node.mesh = 0;
    scene.nodes.push_back(node);
    return scene;
}

void expect_sound(const std::vector<std::uint8_t>& glb) {
    for (const GltfFinding& finding : check_glb(glb))
        ADD_FAILURE() << finding.where << " " << finding.what;
}

TEST(GltfWrite, EveryKindOfFilePassesTheCheck) {
    const GltfScene patch = test::patch_scene(3, 30);
    for (const bool quantise : {false, true})
        for (const bool instancing : {false, true}) {
            expect_sound(encode_glb(patch, {.quantise = quantise, .instancing = instancing}));
            expect_sound(encode_glb(test::lod_scene(), {.quantise = quantise}));
        }
    expect_sound(encode_glb(one_stone()));
    expect_sound(encode_glb(test::rocks_scene(8, 16), {.reorder = false}));
}

TEST(GltfWrite, PlainFilesUseCoreGltfAlone) {
    const std::string json = test::json_of(encode_glb(test::rocks_scene(8, 16)));
    EXPECT_THAT(json, Not(HasSubstr("extensions")));
    EXPECT_THAT(json, HasSubstr("\"generator\":\"scree\""));
    EXPECT_THAT(json, HasSubstr("\"mimeType\":\"image/jpeg\""));
    EXPECT_THAT(json, HasSubstr("\"metres_per_pixel\":0.001"));
    EXPECT_THAT(json, HasSubstr("\"name\":\"rock-47\""));
}

TEST(GltfWrite, ExtensionsAreDeclaredAsTheyAreUsed) {
    const GltfScene patch = test::patch_scene(2, 6);
    const std::string instanced = test::json_of(encode_glb(patch, {.quantise = true}));
    EXPECT_THAT(instanced, HasSubstr("\"extensionsRequired\":[\"KHR_mesh_quantization\","
                                     "\"EXT_mesh_gpu_instancing\"]"));
    const std::string plain = test::json_of(encode_glb(patch, {.instancing = false}));
    EXPECT_THAT(plain, Not(HasSubstr("extensions")));
    EXPECT_THAT(plain, HasSubstr("\"name\":\"rock-1.2\""));
    const std::string lods = test::json_of(encode_glb(test::lod_scene()));
    EXPECT_THAT(lods, HasSubstr("\"MSFT_lod\":{\"ids\":[48,96]}"));
    EXPECT_THAT(lods, Not(HasSubstr("extensionsRequired")));
}

// The size that the patch has to keep: 20 rocks of 2,562 vertices, 2,000 stones.
TEST(GltfWrite, PatchOfTwoThousandStonesStaysSmall) {
    GltfScene patch = test::patch_scene(20, 2000);
    ASSERT_EQ(patch.meshes[0].geometry.positions.size(), 2562U);
    ASSERT_EQ(patch.meshes[0].geometry.triangles.size(), 5120U);
    EXPECT_LE(encode_glb(patch, {.quantise = true}).size(), 1'950'000U);
    patch.texture.clear();
    EXPECT_LE(encode_glb(patch, {.quantise = true}).size(), 1'330'000U);
    EXPECT_LE(encode_glb(patch).size(), 1'950'000U);  // nothing to put texture coordinates on
}

TEST(GltfWrite, ContainerIsAlignedAndStatesItsLength) {
    for (const char* name : {"a", "ab", "abc", "abcd"}) {
        GltfScene scene = one_stone();
        scene.name = name;
        const auto glb = encode_glb(scene);
        EXPECT_EQ(test::word_at(glb, 0), 0x46546C67U);
        EXPECT_EQ(test::word_at(glb, 8), glb.size());
        EXPECT_EQ(glb.size() % 4, 0U);
        EXPECT_EQ(test::word_at(glb, 12) % 4, 0U);
        EXPECT_EQ(test::word_at(glb, 20 + test::word_at(glb, 12) + 4), 0x004E4942U);  // "BIN"
    }
}

TEST(GltfWrite, IndicesWidenOnlyWhereTheyMust) {
    GltfScene scene = one_stone();
    EXPECT_THAT(test::json_of(encode_glb(scene)), HasSubstr("\"componentType\":5123"));
    EXPECT_THAT(test::json_of(encode_glb(scene)), Not(HasSubstr("\"componentType\":5125")));
    scene.meshes[0].geometry = test::stone(7, 0.02F, 1);  // 163,842 vertices
    EXPECT_THAT(test::json_of(encode_glb(scene)), HasSubstr("\"componentType\":5125"));
}

TEST(GltfWrite, SameBytesForEveryThreadCount) {
    const GltfScene scene = test::rocks_scene(12, 24);
    const ThreadLimit one(1);
    const auto alone = encode_glb(scene, {.quantise = true});
    const ThreadLimit more(0);
    EXPECT_EQ(encode_glb(scene, {.quantise = true}), alone);
}

TEST(GltfWrite, EmptySceneIsAFileWithoutMeshes) {
    expect_sound(encode_glb({}));
}

TEST(GltfWriteErrors, NameTheMeshOrTheNode) {
    const auto message = [](const GltfScene& scene, const char* text) {
        EXPECT_THAT([&] { encode_glb(scene); }, ThrowsMessage<InvalidInput>(HasSubstr(text)));
    };
    GltfScene scene = one_stone();
    scene.nodes[0].mesh = 4;
    message(scene, "node 0 names mesh 4, the scene has 1");
    scene = one_stone();
    scene.nodes[0].transform.translation.y = std::numeric_limits<float>::quiet_NaN();
    message(scene, "node 0 is placed by numbers that are not finite");
    scene = one_stone();
    scene.nodes[0].instances.push_back({{}, {2.0F, 0, 0, 0}, glm::vec3(1.0F)});
    message(scene, "rotation that is not of unit length");
    scene = one_stone();
    scene.nodes[0].coarser = {0};
    message(scene, "node 0 names coarser node 0");
    scene = one_stone();
    scene.meshes[0].geometry.triangles.clear();
    message(scene, "mesh 0 (stone) has no triangles");
    scene = one_stone();
    scene.meshes[0].geometry.triangles[0].x = 5000;
    message(scene, "a triangle names vertex 5000");
    scene = one_stone();
    scene.texture = {1, 2, 3, 4, 5};
    message(scene, "the texture of 5 bytes is neither a JPEG nor a PNG file");
}

}  // namespace
}  // namespace scree::meshing
