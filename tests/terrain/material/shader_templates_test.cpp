#include "terrain/material/shader_templates.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_dir.h"
#include "tests/terrain/material/map_samples.h"

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

constexpr const char* kCompiler = "/usr/bin/glslangValidator";

std::vector<Material> textured() {
    auto materials = test::three_materials();
    materials[0].textures.albedo = "sand.png";
    materials[2].textures = {"p.png", "p.exr", "n.png", 0.5, 0.02};
    return materials;
}

std::vector<Material> many(int count) {
    std::vector<Material> materials;
    for (int id = 0; id < count; ++id) {
        Material material;
        material.id = id;
        material.name = "m" + std::to_string(id);
        material.textures.albedo = "a.png";
        materials.push_back(material);
    }
    return materials;
}

// Row DM-03.
TEST(Shaders, HaveAnArrayForTheTexturesOfTheMap) {
    const GroundShaders shaders = ground_shaders(textured(), 0.25);
    EXPECT_THAT(shaders.albedo, ElementsAre(0, 2));
    EXPECT_THAT(shaders.normal, ElementsAre(2));
    EXPECT_THAT(shaders.displacement, ElementsAre(2));
    EXPECT_THAT(shaders.fragment, HasSubstr("uniform sampler2D scree_albedo[2];"));
    EXPECT_THAT(shaders.fragment, HasSubstr("uniform sampler2D scree_normal[1];"));
    EXPECT_THAT(shaders.evaluation, HasSubstr("uniform sampler2D scree_displacement[1];"));
    EXPECT_THAT(shaders.fragment, HasSubstr("const int SCREE_MATERIALS = 3;"));
    EXPECT_THAT(shaders.fragment, HasSubstr("uniform usampler2D scree_ids;"));
    EXPECT_THAT(shaders.fragment_functions, Not(HasSubstr("void main")));
    EXPECT_THAT(shaders.fragment_functions, Not(HasSubstr("#version")));
    EXPECT_THAT(ground_shaders(test::three_materials(), 1.0).fragment,
                Not(HasSubstr("uniform sampler2D")));
    EXPECT_THAT(ground_shaders(textured(), 1.0, {.binding = TextureBinding::Layers}).fragment,
                HasSubstr("uniform sampler2DArray scree_albedo;"));
}

TEST(Shaders, SayWhatIsWrong) {
    EXPECT_THAT([] { ground_shaders(many(40), 1.0); },
                ThrowsMessage<InvalidInput>(HasSubstr("40 albedo textures, at most 32")));
    EXPECT_NO_THROW(ground_shaders(many(40), 1.0, {.binding = TextureBinding::Layers}));
    EXPECT_THROW(ground_shaders(textured(), 0.0), InvalidInput);
    EXPECT_THROW(ground_shaders({}, 1.0), InvalidInput);
    EXPECT_THROW(ground_shaders(textured(), 1.0, {.max_textures = 0}), InvalidOption);
}

TEST(Shaders, Compile) {
    if (!std::filesystem::exists(kCompiler))
        GTEST_SKIP() << "SKIPPED: Debian's glslang-tools is not installed, so no compiler of "
                        "shaders is at hand";
    const test::TempDir dir;
    const auto expect_compiles = [&](const std::string& text, const char* name) {
        write_whole_file(dir / name, std::string_view(text));
        const auto run = test::run_program(kCompiler, {(dir / name).string()});
        EXPECT_EQ(run.status, 0) << run.output << run.errors << text;
    };
    struct Case {
        std::vector<Material> materials;
        ShaderOptions options;
    };
    for (const Case& one :
         {Case{textured(), {}}, Case{textured(), {.literal_hat = true}},
          Case{textured(), {.binding = TextureBinding::Layers}}, Case{test::three_materials(), {}},
          Case{many(1), {}}, Case{many(1), {.literal_hat = true}},
          Case{many(64), {.binding = TextureBinding::Layers}}}) {
        const GroundShaders shaders = ground_shaders(one.materials, 0.25, one.options);
        expect_compiles(shaders.fragment, "ground.frag");
        expect_compiles(shaders.evaluation, "ground.tese");
    }
}

}  // namespace
}  // namespace scree::terrain
