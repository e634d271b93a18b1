#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/rock_collection.h"
#include "base/parallel.h"
#include "base/whole_file.h"
#include "meshing/gltf/gltf_write.h"
#include "vision/image_io.h"

#include <iostream>

namespace scree::apps {

void run_procedural(Arguments& arguments) {
    std::filesystem::path output, picture;
    int count = 1;
    bool quantise = false;
    meshing::ProceduralRockOptions options;
    options.base = meshing::RockBase::Resting;
    options.form = meshing::WorleyForm::Axes;
    CommonOptions common;
    arguments.path({"output", 'o', "FILE.glb", "the rocks", true}, output);
    arguments.path({"picture", 0, "FILE.png", "a picture of them", false}, picture);
    arguments.flag("count", count, {.min = 1, .max = 10000, .help = "rocks, of successive seeds"});
    arguments.flag("quantise", quantise, {.help = "pack vertices with KHR_mesh_quantization"});
    arguments.options(options);
    arguments.options(common, {"threads", "quiet"});
    arguments.parse();

    const ThreadLimit limit(common.threads);
    const Collection all = make_collection(options, count);
    OutputBatch batch;
    write_staged_file(batch.stage(output),
                      meshing::encode_glb(scene_of(all, options.seed), {.quantise = quantise}));
    if (!picture.empty())
        vision::write_png(batch.stage(picture), picture_of(all));
    batch.commit();
    if (!common.quiet)
        std::cout << count << (count == 1 ? " rock: " : " rocks: ") << output.string() << '\n';
}

}  // namespace scree::apps
