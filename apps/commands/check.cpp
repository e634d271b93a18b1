#include "apps/commands.h"
#include "base/error.h"
#include "meshing/gltf/check_gltf.h"

#include <iostream>
#include <vector>

#include <nlohmann/json.hpp>

namespace scree::apps {
namespace {

using meshing::GltfFinding;
using nlohmann::ordered_json;

const char* word_for(GltfFinding::Severity severity) {
    return severity == GltfFinding::Severity::Error ? "error" : "warning";
}

std::string sentence(const std::filesystem::path& file, const GltfFinding& finding) {
    return file.string() + ": " + word_for(finding.severity) + ": " +
           (finding.where.empty() ? "" : finding.where + ": ") + finding.what;
}

}  // namespace

void run_check(Arguments& arguments) {
    std::vector<std::filesystem::path> files;
    bool json = false;
    arguments.positional("FILE.glb", files, "binary glTF files");
    arguments.flag("json", json, {.help = "print the findings as JSON"});
    arguments.parse();

    ordered_json all = ordered_json::object();
    std::size_t n_errors = 0;
    for (const auto& file : files) {
        ordered_json& list = all[file.string()] = ordered_json::array();
        const auto findings = meshing::check_glb_file(file);
        for (const GltfFinding& finding : findings) {
            n_errors += finding.severity == GltfFinding::Severity::Error ? 1 : 0;
            list.push_back({{"severity", word_for(finding.severity)},
                            {"where", finding.where},
                            {"what", finding.what}});
            if (!json)
                std::cout << sentence(file, finding) << '\n';
        }
        if (!json && findings.empty())
            std::cout << file.string() << ": sound\n";
    }
    if (json)
        std::cout << all.dump(1) << '\n';
    if (n_errors > 0)
        fail<InvalidInput>(n_errors, n_errors == 1 ? " error" : " errors", " in ", files.size(),
                           files.size() == 1 ? " file" : " files");
}

}  // namespace scree::apps
