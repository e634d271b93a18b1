#include "meshing/gltf/gltf_read.h"

#include "base/error.h"
#include "base/random.h"
#include "base/whole_file.h"
#include "meshing/gltf/check_gltf.h"
#include "meshing/gltf/gltf_write.h"
#include "tests/support/glb_edit.h"
#include "tests/support/sample_scenes.h"
#include "tests/support/temp_dir.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// Corner positions of all triangles in the world, ordered: equal for equal surfaces however their
// vertices and triangles are arranged.
std::vector<glm::dvec3> corners(const TriMesh& mesh, const glm::dmat4& world) {
    std::vector<glm::dvec3> points;
    for (const glm::uvec3& t : mesh.triangles)
        for (const std::uint32_t v : {t.x, t.y, t.z})
            points.emplace_back(world * glm::dvec4(glm::dvec3(mesh.positions[v]), 1.0));
    std::sort(points.begin(), points.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    });
    return points;
}

glm::dmat4 matrix_of(const GltfTransform& t) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(t.translation)) *
           glm::mat4_cast(glm::dquat(t.rotation)) *
           glm::scale(glm::dmat4(1.0), glm::dvec3(t.scale));
}

TEST(GltfRead, PlainMeshesComeBackExactly) {
    GltfScene scene = test::rocks_scene(6, 12);
    const LoadedGltf loaded = decode_glb(encode_glb(scene, {.reorder = false}));
    ASSERT_EQ(loaded.meshes.size(), scene.meshes.size());
    ASSERT_EQ(loaded.placements.size(), scene.nodes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const TriMesh& wanted = scene.meshes[i].geometry;
        const TriMesh& got = loaded.meshes[i].geometry;
        EXPECT_EQ(loaded.meshes[i].name, scene.meshes[i].name);
        EXPECT_EQ(got.positions, wanted.positions);
        EXPECT_EQ(got.texcoords, wanted.texcoords);
        EXPECT_EQ(got.triangles, wanted.triangles);
        ASSERT_EQ(got.normals.size(), wanted.normals.size());
        EXPECT_LT(glm::distance(got.normals[20], wanted.normals[20]), 1e-6);
        EXPECT_EQ(loaded.placements[i].node, scene.nodes[i].name);
        EXPECT_EQ(loaded.placements[i].world_from_mesh, matrix_of(scene.nodes[i].transform));
    }
}

TEST(GltfRead, ReorderedMeshesAreTheSameSurface) {
    GltfScene scene = test::rocks_scene(6, 12);
    const LoadedGltf loaded = decode_glb(encode_glb(scene));
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        EXPECT_EQ(corners(loaded.meshes[i].geometry, glm::dmat4(1.0)),
                  corners(scene.meshes[i].geometry, glm::dmat4(1.0)));
}

// Every copy stands where it was put, quantised or not, as an instance or as a node.
TEST(GltfRead, CopiesStandWhereTheyWerePut) {
    GltfScene scene = test::patch_scene(2, 7);
    scene.nodes[1].transform.translation = {0.3F, 0.1F, -0.2F};
    scene.nodes[1].transform.scale = {2.0F, 2.0F, 2.0F};
    for (const bool quantise : {false, true})
        for (const bool instancing : {false, true}) {
            const LoadedGltf loaded = decode_glb(encode_glb(
                scene, {.quantise = quantise, .instancing = instancing, .reorder = false}));
            ASSERT_EQ(loaded.placements.size(), 7U);
            std::size_t at = 0;
            for (const GltfNode& node : scene.nodes)
                for (const GltfTransform& copy : node.instances) {
                    const auto& placement = loaded.placements[at++];
                    ASSERT_EQ(placement.mesh, static_cast<std::size_t>(node.mesh));
                    const TriMesh& wanted = scene.meshes[placement.mesh].geometry;
                    const TriMesh& got = loaded.meshes[placement.mesh].geometry;
                    const glm::dmat4 world = matrix_of(node.transform) * matrix_of(copy);
                    for (std::size_t v = 0; v < wanted.positions.size(); v += 17) {
                        const glm::dvec4 a =
                            world * glm::dvec4(glm::dvec3(wanted.positions[v]), 1.0);
                        const glm::dvec4 b = placement.world_from_mesh *
                                             glm::dvec4(glm::dvec3(got.positions[v]), 1.0);
                        ASSERT_LT(glm::distance(a, b), quantise ? 1e-6 : 1e-8);
                    }
                    ASSERT_LT(glm::distance(got.normals[5], wanted.normals[5]), 0.01);
                    ASSERT_LT(glm::distance(got.texcoords[5], wanted.texcoords[5]), 1e-5);
                }
        }
}

TEST(GltfRead, FilesAreReadAndTheirNameStandsInTheMessage) {
    const test::TempDir dir;
    write_whole_file(dir / "good.glb", encode_glb(test::rocks_scene(6, 12)));
    EXPECT_EQ(read_glb(dir / "good.glb").placements.size(), 48U);
    write_whole_file(dir / "bad.glb", std::string_view("no glb at all, but long enough"));
    EXPECT_THAT([&] { read_glb(dir / "bad.glb"); },
                ThrowsMessage<InvalidInput>(HasSubstr("bad.glb cannot be read: it is no binary")));
    EXPECT_THROW(read_glb(dir / "none.glb"), IoError);
}

TEST(GltfReadErrors, SayWhatIsWrongWithTheFile) {
    const test::Glb good = encode_glb(test::patch_scene(2, 6));
    const auto message = [](const test::Glb& glb, const char* text) {
        EXPECT_THAT([&] { decode_glb(glb); }, ThrowsMessage<InvalidInput>(HasSubstr(text)));
    };
    message({}, "no binary glTF");
    test::Glb cut = good;
    cut.resize(cut.size() - 100);
    message(cut, "its header says");
    test::set_word(cut, 8, static_cast<std::uint32_t>(cut.size()));
    EXPECT_THROW(decode_glb(cut), InvalidInput);
    message(test::edited(good, "\"mode\":4", "\"mode\":1"), "only triangle lists are read");
    message(test::edited(good, "EXT_mesh_gpu_instancing\"]", "EXT_meshopt_compression\"]"),
            "EXT_meshopt_compression");
    message(test::edited(good, "\"count\":2562", "\"count\":999999999"), "ends outside");
    message(test::with_json(good, std::string(5000, '[')), "nested deeper");
    message(test::edited(good, "\"asset\":{", "\"asset\":[{"), "");
    message(test::edited(good, "\"buffers\":[{", "\"buffers\":[{\"uri\":\"/etc/passwd\","), "");
    message(test::edited(good, "\"nodes\":[0,1]", "\"nodes\":[0,0]"), "reached twice");
    message(test::edited(good, "\"nodes\":[0,1]", "\"nodes\":[0,7]"), "does not exist");
    std::string huge = "\"matrix\":[1.7e308";
    for (int i = 1; i < 16; ++i)
        huge += ",1.7e308";
    message(test::edited(good, "\"mesh\":0", huge + "],\"mesh\":0"), "a place that is no number");
}

TEST(GltfReadErrors, LimitsHold) {
    const test::Glb good = encode_glb(test::patch_scene(2, 6));
    const auto refused = [&](const GltfLimits& limits, const char* text) {
        EXPECT_THAT([&] { decode_glb(good, limits); },
                    ThrowsMessage<InvalidInput>(HasSubstr(text)));
    };
    GltfLimits limits;
    limits.max_vertices = 5000;
    refused(limits, "more vertices");
    limits = {};
    limits.max_triangles = 5000;
    refused(limits, "more triangles");
    limits = {};
    limits.max_placements = 5;
    refused(limits, "more placed meshes");
    limits = {};
    limits.max_bytes = 1000;
    refused(limits, "the limit is 1000");
    limits = {};
    limits.max_json_bytes = 100;
    refused(limits, "the limit is 100");
}

// Whatever the bytes, the reader returns or throws InvalidInput and the checker returns.
TEST(GltfReadErrors, DamagedBytesNeverDoHarm) {
    GltfScene scene = test::patch_scene(2, 6);
    scene.meshes[0].geometry = test::icosphere(0);
    scene.meshes[1].geometry = test::icosphere(0);
    scene.texture.clear();
    const test::Glb good = encode_glb(scene, {.quantise = true});
    Rng rng({.seed = 4});
    for (int round = 0; round < 3000; ++round) {
        test::Glb bad = good;
        const bool digits = round % 2 == 0;  // half of them stay well-formed JSON more often
        for (std::uint64_t k = 1 + rng.below(4); k > 0; --k) {
            const auto at = static_cast<std::size_t>(rng.below(bad.size()));
            if (!digits)
                bad[at] = static_cast<std::uint8_t>(rng.below(256));
            else if (bad[at] >= '0' && bad[at] <= '9')
                bad[at] = static_cast<std::uint8_t>('0' + rng.below(10));
        }
        check_glb(bad);
        try {
            for (const GltfMesh& mesh : decode_glb(bad).meshes)
                check_mesh(mesh.geometry);
        } catch (const InvalidInput&) {
        }
    }
}

}  // namespace
}  // namespace scree::meshing
