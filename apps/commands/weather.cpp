#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/console.h"
#include "apps/weather_job.h"
#include "base/parallel.h"

#include <iostream>

namespace scree::apps {

void run_weather(Arguments& arguments) {
    WeatherJob job;
    CommonOptions common;
    arguments.positional("MESH", job.mesh, "triangle mesh: .obj, .ply, .off, .stl or .glb");
    arguments.path({"output", 'o', "FILE", "the worn mesh, in any of these formats", true},
                   job.output);
    arguments.path({"before-after", 0, "FILE.png", "a picture of both", false}, job.before_after);
    arguments.path({"turntable", 0, "FILE.png", "the worn mesh from eight sides", false},
                   job.turntable);
    arguments.path({"checkpoint", 0, "FILE", "save the run here, and go on from it", false},
                   job.checkpoint);
    arguments.path(
        {"csv", 0, "FILE.csv", "a row a step: volume, area, farthest way and more", false},
        job.csv);
    arguments.flag("csv-times", job.csv_times, {.help = "add milliseconds to the rows"});
    arguments.flag("save-seconds", job.save_seconds,
                   {.min = 0, .max = 86400, .unit = "s", .help = "time between checkpoints"});
    arguments.flag("curvature-colours", job.curvature_colours,
                   {.help = "colour vertices and pictures by curvature"});
    arguments.options(job.options);
    arguments.options(job.clean);
    arguments.options(common);
    arguments.parse();

    const ThreadLimit limit(common.threads);
    ConsoleProgress progress(talk_for_terminal(common.quiet));
    const WeatherOutcome outcome = run_weather_job(job, &progress);
    progress.clear();
    if (common.json)
        std::cout << weather_json(job, outcome);
    else if (!common.quiet)
        std::cout << weather_text(job, outcome);
}

}  // namespace scree::apps
