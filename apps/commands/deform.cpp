#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/console.h"
#include "apps/deform_job.h"
#include "base/parallel.h"

#include <iostream>

namespace scree::apps {

void run_deform(Arguments& arguments) {
    DeformJob job;
    CommonOptions common;
    bool no_frames = false;
    arguments.positional("SCENE.json", job.scene, "what lies and what moves (docs/scene-files.md)");
    arguments.path({"output", 'o', "DIR", "folder for the results", true}, job.folder);
    arguments.flag("frames", job.frames,
                   {.min = 0, .max = 100'000, .help = "frames to run; 0 takes the scene's"});
    arguments.flag("device", job.device, {.help = "where the ground is computed"});
    arguments.flag("no-frames", no_frames, {.help = "draw no pictures and no preview"});
    arguments.options(common);
    arguments.parse();
    job.pictures = !no_frames;

    const ThreadLimit limit(common.threads);
    ConsoleProgress progress(talk_for_terminal(common.quiet));
    const DeformResult result = run_deform_job(job, &progress);
    progress.clear();
    if (!common.quiet)
        print_error_line("scree deform: " + result.device_reason);
    if (common.json)
        std::cout << deform_json(result);
    else if (!common.quiet)
        std::cout << deform_text(result, job.folder);
}

}  // namespace scree::apps
