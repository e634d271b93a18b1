#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/render_job.h"
#include "base/parallel.h"

#include <iostream>

namespace scree::apps {

void run_render(Arguments& arguments) {
    RenderJob job;
    CommonOptions common;
    arguments.positional("HEIGHTS", job.heights, "height map of the ground: EXR in metres, or PNG");
    arguments.path({"output", 'o', "FILE.png", "the picture", true}, job.output);
    arguments.path({"ddh", 0, "DDH.exr", "displacements over the ground, metres", false},
                   job.displacement);
    arguments.path({"map", 0, "DIR", "materials.json of a description map, or its folder", false},
                   job.map);
    arguments.path(
        {"rocks", 0, "ROCKS.glb", "rocks that lie on its gravel, shown within --near", false},
        job.rocks);
    arguments.options(job.options);
    arguments.options(job.view, {"width", "height", "supersampling", "lattice", "tessellation",
                                 "refine-radius", "near", "far", "contour", "ground-block"});
    arguments.flag("software", job.software, {.help = "draw on the processor"});
    arguments.options(common, {"threads", "quiet"});
    arguments.parse();
    if (job.rocks.empty() != !(job.view.near_m > 0.0))
        fail<UsageError>(job.rocks.empty() ? "--near needs --rocks, whose meshes it shows"
                                           : "--rocks needs --near, within which it is shown");

    const ThreadLimit limit(common.threads);
    const std::string device = run_render_job(job);
    if (!common.quiet)
        std::cout << job.output.string() << ": " << job.view.width << " x " << job.view.height
                  << " px, drawn by " << device << '\n';
}

}  // namespace scree::apps
