#include "apps/commands.h"
#include "base/error.h"
#include "vision/data/metrics.h"
#include "vision/image_io.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace scree::apps {
namespace {

using nlohmann::ordered_json;
using vision::LabelScore;

constexpr std::size_t kNameWidth = 44;

ordered_json figures(const LabelScore& score) {
    return {{"AP50", score.ap50},        {"AP75", score.ap75},
            {"mAP", score.map},          {"F1", score.f1},
            {"IoU", score.iou},          {"cover", score.cover},
            {"D50err", score.d50_error}, {"D84err", score.d84_error}};
}

ordered_json picture(const LabelScore& score) {
    ordered_json all = {{"truth", std::lround(score.n_truth)},
                        {"pred", std::lround(score.n_found)},
                        {"tp", std::lround(score.true_positives)}};
    all.update(figures(score));
    return all;
}

std::string row(const std::string& name, const std::string& counts, const LabelScore& score) {
    const std::string tail =
        name.size() > kNameWidth ? name.substr(name.size() - kNameWidth) : name;
    std::string line = tail + std::string(kNameWidth - tail.size(), ' ') + " " + counts;
    const ordered_json values = figures(score);
    for (const auto& [key, value] : values.items()) {
        char text[24];
        std::snprintf(text, sizeof text, " %6.3f", value.get<double>());
        line += text;
    }
    return line + "\n";
}

std::string table(const std::vector<std::string>& names, const std::vector<LabelScore>& scores) {
    std::string text = "picture" + std::string(kNameWidth - 7, ' ') + " truth  pred";
    const ordered_json keys = figures({});
    for (const auto& [key, value] : keys.items())
        text += std::string(7 - key.size(), ' ') + key;
    text += "\n";
    for (std::size_t i = 0; i < names.size(); ++i) {
        char counts[40];
        std::snprintf(counts, sizeof counts, "%5.0f %5.0f", scores[i].n_truth, scores[i].n_found);
        text += row(names[i], counts, scores[i]);
    }
    return text + row("mean", std::string(11, ' '), vision::mean_score(scores));
}

}  // namespace

void run_score(Arguments& arguments) {
    std::vector<std::filesystem::path> maps;
    bool json = false;
    arguments.positional("PRED TRUTH", maps, "label maps in pairs: what was found, then the truth");
    arguments.flag("json", json, {.help = "print the figures as JSON"});
    arguments.parse();
    if (maps.size() % 2 != 0)
        fail<UsageError>("label maps come in pairs, got ", maps.size());

    std::vector<std::string> names;
    std::vector<LabelScore> scores;
    ordered_json pictures = ordered_json::object();
    for (std::size_t i = 0; i < maps.size(); i += 2) {
        const LabelMap found = vision::read_labels(maps[i]);
        scores.push_back(vision::score_labels(found, vision::read_labels(maps[i + 1])));
        names.push_back(maps[i + 1].string());
        pictures[names.back()] = picture(scores.back());
    }
    if (!json)
        std::cout << table(names, scores);
    else
        std::cout << ordered_json{{"pictures", pictures},
                                  {"mean", figures(vision::mean_score(scores))}}
                         .dump(1)
                  << '\n';
}

}  // namespace scree::apps
