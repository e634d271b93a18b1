#include "meshing/gltf/gltf_morph.h"

#include "base/error.h"
#include "meshing/gltf/check_gltf.h"
#include "meshing/gltf/gltf_read.h"
#include "tests/support/mesh_shapes.h"

#include <cmath>
#include <cstring>
#include <string_view>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace scree {
namespace {

using meshing::MorphScene;
using testing::HasSubstr;
using testing::ThrowsMessage;

MorphScene shrinking_ball() {
    MorphScene scene;
    scene.name = "ball";
    scene.mesh = test::icosphere(1, 0.5F);
    for (const float size : {1.0F, 0.75F})
        scene.shapes.push_back({"size", test::icosphere(1, size).positions});
    return scene;
}

nlohmann::json json_of(const std::vector<std::uint8_t>& glb) {
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, sizeof length);
    return nlohmann::json::parse(glb.begin() + 20, glb.begin() + 20 + length);
}

TEST(GltfMorph, IsSoundAndShowsTheEndToPlainReaders) {
    const MorphScene scene = shrinking_ball();
    const auto glb = meshing::encode_morph_glb(scene);
    EXPECT_THAT(meshing::check_glb(glb), testing::IsEmpty());
    const auto loaded = meshing::decode_glb(glb);
    ASSERT_EQ(loaded.meshes.size(), 1U);
    EXPECT_EQ(loaded.meshes[0].geometry.positions, scene.mesh.positions);
    EXPECT_EQ(loaded.meshes[0].geometry.triangles, scene.mesh.triangles);
}

TEST(GltfMorph, TargetsLeadBackToTheEarlierShapes) {
    const MorphScene scene = shrinking_ball();
    const auto glb = meshing::encode_morph_glb(scene);
    const auto json = json_of(glb);
    const auto& primitive = json["meshes"][0]["primitives"][0];
    ASSERT_EQ(primitive["targets"].size(), 2U);
    const std::size_t binary =
        20 + static_cast<std::size_t>(glb[12] | glb[13] << 8 | glb[14] << 16) + 8;
    for (std::size_t shape = 0; shape < 2; ++shape) {
        const auto& accessor =
            json["accessors"][primitive["targets"][shape]["POSITION"].get<std::size_t>()];
        const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        const std::size_t at = binary + view.value("byteOffset", std::size_t{0}) +
                               accessor.value("byteOffset", std::size_t{0});
        for (std::size_t i = 0; i < scene.mesh.positions.size(); ++i) {
            glm::vec3 moved;
            std::memcpy(&moved, glb.data() + at + 12 * i, 12);
            const glm::vec3 place = scene.mesh.positions[i] + moved;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(place[c], scene.shapes[shape].positions[i][c], 1e-6F);
        }
    }
    const auto& animation = json["animations"][0];
    EXPECT_EQ(animation["channels"][0]["target"]["path"], "weights");
    const auto& times = json["accessors"][animation["samplers"][0]["input"].get<std::size_t>()];
    EXPECT_EQ(times["count"], 3);
    EXPECT_EQ(times["max"][0], 4.0);
    const auto& weights = json["accessors"][animation["samplers"][0]["output"].get<std::size_t>()];
    EXPECT_EQ(weights["count"], 6);
}

TEST(GltfMorph, RefusesShapesOfOtherMeshes) {
    MorphScene scene = shrinking_ball();
    scene.shapes[1].positions.pop_back();
    EXPECT_THAT([&] { meshing::encode_morph_glb(scene); },
                ThrowsMessage<InvalidInput>(HasSubstr("shape size has 41 vertices, the mesh 42")));
    scene = shrinking_ball();
    scene.shapes[0].positions[3].y = std::nanf("");
    EXPECT_THROW(meshing::encode_morph_glb(scene), InvalidInput);
    scene = shrinking_ball();
    scene.seconds = 0.0;
    EXPECT_THROW(meshing::encode_morph_glb(scene), InvalidInput);
    scene = shrinking_ball();
    scene.shapes.clear();
    EXPECT_THROW(meshing::encode_morph_glb(scene), InvalidInput);
}

}  // namespace
}  // namespace scree
