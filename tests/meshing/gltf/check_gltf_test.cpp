#include "meshing/gltf/check_gltf.h"

#include "base/whole_file.h"
#include "meshing/gltf/gltf_write.h"
#include "tests/support/glb_edit.h"
#include "tests/support/sample_scenes.h"
#include "tests/support/temp_dir.h"

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> texts(const test::Glb& glb) {
    std::vector<std::string> all;
    for (const GltfFinding& finding : check_glb(glb))
        all.push_back(finding.where + " " + finding.what);
    return all;
}

test::Glb sample() {
    return encode_glb(test::patch_scene(2, 6));
}

void expect_finding(const test::Glb& glb, const char* text) {
    EXPECT_THAT(texts(glb), Contains(HasSubstr(text)));
}

TEST(CheckGltf, SoundFilesHaveNoFindings) {
    EXPECT_THAT(texts(sample()), IsEmpty());
    EXPECT_THAT(texts(encode_glb(test::rocks_scene(6, 12))), IsEmpty());
}

TEST(CheckGltf, InstancesNeedAMeshAndADeclaration) {
    expect_finding(test::edited(sample(), "\"mesh\":1,", ""), "node 1 has instances but no mesh");
    const std::string used = "\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"]";
    ASSERT_THAT(test::json_of(sample()), HasSubstr(used));
    expect_finding(test::edited(sample(), used, "\"extensionsUsed\":[\"EXT_other\"]"),
                   "node 0 uses EXT_mesh_gpu_instancing, which extensionsUsed does not declare");
}

TEST(CheckGltf, InstanceAttributesHaveTheirTypesAndOneLength) {
    const test::Glb glb = sample();
    const std::string rotation = R"("count":3,"type":"VEC4")";
    ASSERT_THAT(test::json_of(glb), HasSubstr(rotation));
    expect_finding(test::edited(glb, rotation, R"("count":3,"type":"VEC3")"),
                   "node 0 has instances whose ROTATION is no VEC4");
    expect_finding(test::edited(glb, rotation, R"("count":2,"type":"VEC4")"),
                   "node 0 has 2 ROTATION but 3 SCALE of its instances");
    expect_finding(test::edited(glb, "\"ROTATION\":", "\"TURN\":"),
                   "node 0 has an instance attribute TURN");
    expect_finding(test::edited(glb, "\"ROTATION\":", "\"ROTATION\":99"), "accessor 99");
    expect_finding(test::edited(glb, "\"EXT_mesh_gpu_instancing\":{\"attributes\"",
                                "\"EXT_mesh_gpu_instancing\":{\"other\""),
                   "node 0 has instancing that has no attributes");
}

TEST(CheckGltf, QuaternionsHaveUnitLengthAndNumbersAreFinite) {
    test::Glb glb = sample();
    // Copies end the file: node 1's translations, rotations, scales, three each.
    const std::size_t rotation = glb.size() - 3 * 12 - 3 * 16;
    test::set_word(glb, rotation, 0x40000000U);  // 2.0
    expect_finding(glb, "node 1 has an instance's ROTATION 0 of length 2");
    test::set_word(glb, rotation, 0x7fc00000U);  // not a number
    expect_finding(glb, "node 1 has an instance's ROTATION 0 that is no number");
}

TEST(CheckGltf, StructureIsSound) {
    const test::Glb glb = sample();
    expect_finding({1, 2, 3}, "no binary glTF");
    expect_finding(test::edited(glb, "\"count\":2562", "\"count\":2563"),
                   "NORMAL for 2563 vertices");
    expect_finding(test::edited(glb, "\"byteLength\":61488", "\"byteLength\":614880000"),
                   "ends outside its buffer");
    expect_finding(test::edited(glb, "\"max\":[", "\"max\":[0.5,0.5,0.5],\"other\":["),
                   "POSITION bounds that are not those of its vertices");
    expect_finding(test::edited(glb, "\"images\":[{\"bufferView\":0,",
                                "\"images\":[{\"uri\":\"../secret.png\","),
                   "image 0 lies in another file: ../secret.png");
    expect_finding(test::edited(glb, "\"name\":\"rock-0\"}", "\"rotation\":[0,0,0,3]}"),
                   "rotation that is not of unit length");
    expect_finding(test::edited(glb, "\"nodes\":[0,1]", "\"nodes\":[1,1]"), "reached twice");
    expect_finding(test::edited(glb, "\"extensionsRequired\":[", "\"extensionsRequired\":[\"X\","),
                   "requires X");
}

TEST(CheckGltf, IndicesStayInsideTheirMesh) {
    GltfScene scene;
    scene.meshes.push_back({"ball", test::icosphere(0)});
    GltfNode node;
    node.mesh = 0;
    scene.nodes.push_back(node);
    test::Glb glb = encode_glb(scene);
    glb[glb.size() - 2] = 200;  // the last index
    expect_finding(glb, "names vertex 200, it has 12");
}

TEST(CheckGltf, ReadsFilesAndStopsAtAHundredFindings) {
    const test::TempDir dir;
    GltfScene scene = test::patch_scene(1, 1);
    for (int i = 0; i < 200; ++i)
        scene.nodes.push_back(scene.nodes[0]);
    const auto glb = test::edited(encode_glb(scene), "\"extensionsUsed\"", "\"extensionsGone\"");
    write_whole_file(dir / "many.glb", glb);
    EXPECT_EQ(check_glb_file(dir / "many.glb").size(), 100U);
}

}  // namespace
}  // namespace scree::meshing
