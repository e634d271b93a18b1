#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/scatter_options.h"
#include "base/parallel.h"
#include "base/whole_file.h"
#include "meshing/gltf/gltf_write.h"
#include "meshing/gltf/rock_scene.h"
#include "meshing/gltf/texture_atlas.h"
#include "meshing/rocks/world_frame.h"
#include "vision/data/rocks_json.h"
#include "vision/image_io.h"

#include <cmath>
#include <cstdio>
#include <iostream>

#include <nlohmann/json.hpp>

namespace scree::apps {
namespace {

namespace fs = std::filesystem;

meshing::RockPatch make_patch(const vision::RockSet& set,
                              const std::vector<meshing::RockMesh>& meshes,
                              const ScatterOptions& scatter, meshing::PatchOptions patch) {
    if (scatter.grid > 0) {
        const meshing::GroundRegion region = meshing::region_of(set);
        return meshing::repeat_rocks(meshes, {region.width, region.depth}, scatter.grid,
                                     scatter.grid);
    }
    patch.width = scatter.size_m;
    return meshing::scatter_rocks(meshes, scatter.count, patch);
}

void print_report(const meshing::RockPatch& patch, const fs::path& output, bool json) {
    if (json) {
        std::cout << nlohmann::ordered_json{{"file", output.string()},
                                            {"stones", patch.instances.size()},
                                            {"meshes", patch.prototypes.size()},
                                            {"size_m", {patch.size.x, patch.size.y}},
                                            {"coverage", patch.report.coverage},
                                            {"left_out", patch.report.left_out}}
                         .dump(1)
                  << '\n';
        return;
    }
    char text[160];
    std::snprintf(text, sizeof text, "%zu stones of %zu meshes on %.3g x %.3g m",
                  patch.instances.size(), patch.prototypes.size(), patch.size.x, patch.size.y);
    std::cout << text;
    if (patch.report.coverage > 0.0)
        std::cout << ", " << std::lround(100.0 * patch.report.coverage) << " % covered, "
                  << patch.report.left_out << " found no room";
    std::cout << ": " << output.string() << '\n';
}

}  // namespace

void run_scatter(Arguments& arguments) {
    fs::path rocks, output, photo;
    ScatterOptions scatter;
    meshing::PatchOptions patch_options;
    CommonOptions common;
    arguments.positional("ROCKS.json", rocks, "rocks as 'scree rocks' wrote them");
    arguments.path({"output", 'o', "FILE.glb", "the patch", true}, output);
    arguments.path({"photo", 0, "PHOTO", "photograph for the texture", false}, photo);
    arguments.options(scatter);
    arguments.options(patch_options, {"prototypes", "tries", "sweeps", "turn", "seed"});
    arguments.options(common);
    arguments.parse();

    const ThreadLimit limit(common.threads);
    const vision::RockSet set = vision::read_rocks_json(rocks);
    const auto meshes = meshing::build_rock_meshes(set, {.max_segments = scatter.max_segments});
    const auto patch = make_patch(set, meshes, scatter, patch_options);
    meshing::GltfScene scene = meshing::patch_scene(set, meshes, patch);
    if (!photo.empty())
        meshing::use_texture_atlas(scene, vision::read_photo(photo).pixels,
                                   {.max_side = scatter.grid > 0 ? 4096 : 1024});
    write_whole_file(
        output, meshing::encode_glb(scene, {.quantise = scatter.quantise || !scatter.plain_nodes,
                                            .instancing = !scatter.plain_nodes}));
    if (!common.quiet)
        print_report(patch, output, common.json);
}

}  // namespace scree::apps
