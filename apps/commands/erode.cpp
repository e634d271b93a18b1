#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/console.h"
#include "apps/erosion_job.h"
#include "base/parallel.h"

#include <iostream>

namespace scree::apps {

void run_erode(Arguments& arguments) {
    ErosionJob job;
    CommonOptions common;
    arguments.positional("SCENE.json", job.scene, "mesh, water and options, as the docs say");
    arguments.path({"output", 'o', "DIR", "folder for the results", true}, job.folder);
    arguments.flag("resume", job.resume,
                   {.help = "go on from the checkpoint in DIR if there is one"});
    arguments.options(common);
    arguments.parse();

    const ThreadLimit limit(common.threads);
    ConsoleProgress progress(talk_for_terminal(common.quiet));
    const ErosionOutcome outcome = run_erosion_job(job, &progress);
    progress.clear();
    if (common.json)
        std::cout << erosion_json(outcome);
    else if (!common.quiet)
        std::cout << erosion_text(outcome, job.folder);
}

}  // namespace scree::apps
