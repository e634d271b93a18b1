#include "base/whole_file.h"
#include "terrain/gpu/deformer_shaders.h"
#include "terrain/view/near_rocks.h"
#include "terrain/view/view_shaders.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_dir.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

constexpr const char* kCompiler = "/usr/bin/glslangValidator";

struct Source {
    const char* name;
    std::string text;
};

std::vector<Source> all_sources() {
    std::vector<Material> materials(3);
    for (int id = 0; id < 3; ++id) {
        materials[static_cast<std::size_t>(id)].id = 2 * id;
        materials[static_cast<std::size_t>(id)].name = "m" + std::to_string(id);
    }
    materials[1].textures.albedo = materials[2].textures.displacement = "p.png";
    const GroundShaders made = ground_shaders(materials, 0.1, {.binding = TextureBinding::Layers});
    return {{"ground.vert", ground_vertex_glsl()},
            {"ground.tesc", ground_control_glsl()},
            {"ground.tese", ground_evaluation_glsl(made)},
            {"ground.frag", ground_fragment_glsl(made)},
            {"surface.comp", surface_compute_glsl()},
            {"sun.comp", sun_compute_glsl()},
            {"rock.vert", near_rock_vertex_glsl()},
            {"rock.frag", near_rock_fragment_glsl(made)},
            {"wall.vert", wall_vertex_glsl()},
            {"wall.frag", wall_fragment_glsl(made)},
            {"object.vert", object_vertex_glsl()},
            {"object.frag", object_fragment_glsl()},
            {"shadow.vert", shadow_vertex_glsl()},
            {"shadow.frag", shadow_fragment_glsl()},
            {"screen.vert", screen_vertex_glsl()},
            {"resolve.frag", resolve_fragment_glsl()},
            {"line.frag", line_fragment_glsl()},
            {"tiles.comp", sound_tiles_glsl({.weighted = false, .palette = true})},
            {"tiles_weighted.comp", sound_tiles_glsl({.weighted = true, .palette = false})},
            {"literal.comp", literal_glsl({.weighted = true, .palette = true})},
            {"literal_cells.comp", literal_glsl({.weighted = true, .palette = false})},
            {"loads.comp", sound_loads_glsl({.weighted = false, .palette = false})},
            {"loads_weighted.comp", sound_loads_glsl({.weighted = true, .palette = true})}};
}

// Drivers forgive what the language forbids, each something else; the reference compiler does not.
TEST(ShaderSources, AreWhatTheLanguageAllows) {
    if (!std::filesystem::exists(kCompiler))
        GTEST_SKIP() << "SKIPPED: Debian's glslang-tools is not installed, so no compiler of "
                        "shaders is at hand";
    const scree::test::TempDir dir;
    std::vector<std::string> words;
    for (const Source& source : all_sources()) {
        write_whole_file(dir / source.name, source.text);
        words.push_back((dir / source.name).string());
    }
    const auto run = scree::test::run_program(kCompiler, words);
    EXPECT_EQ(run.status, 0) << run.output << run.errors;
}

}  // namespace
}  // namespace scree::terrain
