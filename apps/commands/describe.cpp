#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/console.h"
#include "apps/describe_job.h"
#include "base/parallel.h"

#include <iostream>

namespace scree::apps {
namespace {

// A source is a flag, or two that belong together; strokes alone are one too.
void check_sources(const DescribeJob& job) {
    struct Pair {
        const char* name;
        const std::filesystem::path& path;
        const char* other_name;
        const std::filesystem::path* other;
    };
    const Pair sources[] = {{"--map", job.map, "", nullptr},
                            {"--ids", job.painted, "--materials", &job.materials},
                            {"--labels", job.labels, "--photo", &job.photo},
                            {"--rules", job.rules, "--heights", &job.heights},
                            {"--import", job.picture, "--id-file", &job.id_file}};
    int n_sources = 0;
    for (const Pair& source : sources) {
        const bool given = !source.path.empty();
        n_sources += given ? 1 : 0;
        if (given && source.other != nullptr && source.other->empty())
            fail<UsageError>(source.name, " needs ", source.other_name, " beside it");
        const bool alone = source.other != nullptr && source.other != &job.materials &&
                           !source.other->empty() && !given;
        if (alone)
            fail<UsageError>(source.other_name, " needs ", source.name, " beside it");
    }
    if (n_sources > 1 || (n_sources == 0 && job.strokes.empty()))
        fail<UsageError>(
            "one of --map, --ids, --labels, --rules, --import and --strokes is needed; "
            "only --strokes goes with another");
    if (job.options.cell_size_m > 0.0 && (!job.labels.empty() || n_sources == 0))
        fail<UsageError>("--cell-size-m does not go with ",
                         n_sources == 0 ? "a script's own ground, which says it"
                                        : "--labels; --pixels-per-cell says it there");
    if (!job.relief.empty() && job.labels.empty())
        fail<UsageError>("--relief needs --labels beside it");
    if (job.layers.empty() && job.mix.downwards > 0.0)
        fail<UsageError>("--mix-downwards needs --layers, which says what lies below");
    const bool table = !job.rules.empty() || n_sources == 0;
    if (table && job.materials.empty())
        fail<UsageError>("--rules and --strokes need --materials beside them");
}

void describe_paths(Arguments& arguments, DescribeJob& job) {
    arguments.path({"output", 'o', "DIR", "folder for the results", true}, job.folder);
    arguments.path({"map", 0, "DIR", "from a map that was written before", false}, job.map);
    arguments.path({"ids", 0, "PICTURE", "from a picture painted in ids or colours", false},
                   job.painted);
    arguments.path({"labels", 0, "LABELS", "from the label map of 'scree rocks'", false},
                   job.labels);
    arguments.path({"photo", 0, "PHOTO", "the photograph of the label map", false}, job.photo);
    arguments.path({"relief", 0, "DISPLACEMENT.exr", "the displacement map of those rocks", false},
                   job.relief);
    arguments.path({"rules", 0, "RULES.json", "from rules over a height map", false}, job.rules);
    arguments.path({"heights", 0, "HEIGHTS", "the height map of the rules, metres", false},
                   job.heights);
    arguments.path({"import", 0, "MAP.png", "from the published picture of four channels", false},
                   job.picture);
    arguments.path({"id-file", 0, "IDS.txt", "the id file of that picture", false}, job.id_file);
    arguments.path({"strokes", 0, "STROKES.json", "from strokes, or strokes over another", false},
                   job.strokes);
    arguments.path({"materials", 0, "TABLE.json", "materials of pictures, rules, strokes", false},
                   job.materials);
    arguments.path({"layers", 0, "LAYERS.json", "what lies below the map and mixes with it", false},
                   job.layers);
}

}  // namespace

void run_describe(Arguments& arguments) {
    DescribeJob job;
    job.mix.steps = 0;
    CommonOptions common;
    describe_paths(arguments, job);
    arguments.options(job.options);
    arguments.options(job.paint);
    arguments.options(job.rock);
    arguments.options(job.mix);
    arguments.options(job.shader, {"binding", "literal-hat"});
    arguments.options(common);
    arguments.parse();
    check_sources(job);

    const ThreadLimit limit(common.threads);
    ConsoleProgress progress(talk_for_terminal(common.quiet || common.json));
    const DescribeReport report = run_describe_job(job, &progress);
    progress.clear();
    if (common.json)
        std::cout << describe_json(report, job);
    else if (!common.quiet)
        std::cout << describe_text(report, job);
}

}  // namespace scree::apps
