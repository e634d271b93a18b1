#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/console.h"
#include "apps/terrain_job.h"
#include "base/parallel.h"

#include <iostream>

namespace scree::apps {

void run_terrain(Arguments& arguments) {
    TerrainJob job;
    CommonOptions common;
    arguments.positional("INPUT", job.input,
                         "height map (EXR in metres, PNG) or points (.ply, .las)");
    arguments.path({"output", 'o', "MESH", "the mesh: .obj, .ply, .off, .stl or .glb", true},
                   job.output);
    arguments.path({"bed", 0, "FILE.json", "river beds to cut in", false}, job.beds);
    arguments.path({"picture", 0, "FILE.png", "the mesh as clay", false}, job.picture);
    arguments.options(job.mesh);
    arguments.flag(
        "width-m", job.scale.width_m,
        {.min = 0, .max = 1e6, .unit = "m", .help = "width of a height map; 0: as the file says"});
    arguments.flag(
        "height-m", job.scale.height_m,
        {.min = 0, .max = 1e5, .unit = "m", .help = "height of white; 0: as the file says"});
    arguments.flag("up", job.up,
                   {.help = "axis of points that looks up; auto: z of LAS, y of PLY"});
    arguments.options(job.survey);
    arguments.options(common);
    arguments.parse();

    const ThreadLimit limit(common.threads);
    ConsoleProgress progress(talk_for_terminal(common.quiet));
    const TerrainOutcome outcome = run_terrain_job(job, &progress);
    progress.clear();
    if (common.json)
        std::cout << terrain_json(job, outcome);
    else if (!common.quiet)
        std::cout << terrain_text(job, outcome);
}

}  // namespace scree::apps
