// Export every candidate region of a photograph with its best overlap, for train_score.py.
//
// usage: export_candidates RAW WIDTH HEIGHT FIELD LABELS OUT INSIDE
//   RAW     8-bit RGB, row by row
//   FIELD   float32 planes of an edge field (.f32) or numbers of the classical networks
//   LABELS  uint16, row by row, 0 = background
//   OUT     float32, a row for each region: overlap, label, left, right, parent, then its features
//           and those of its outline; those of the context need a first score and are left out
//   INSIDE  least inside value of a pixel that may belong to a rock
#include "vision/classical/region_outline.h"
#include "vision/classical/region_score.h"
#include "vision/training/field_source.h"

#include <iostream>
#include <map>

namespace {

using namespace scree;
using namespace scree::vision;

using Shared = std::map<int, double>;  // label -> pixels in common

struct Truth {
    Shared areas;                 // of the labelled rocks
    std::vector<Shared> regions;  // what each region has in common with them
};

Truth compare(const RegionHierarchy& hierarchy, const std::vector<std::uint16_t>& labels) {
    const auto& nodes = hierarchy.tree.nodes;
    Truth truth{{}, std::vector<Shared>(nodes.size())};
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] == 0)
            continue;
        truth.areas[labels[i]] += 1;
        const int basin = hierarchy.basins.labels.data()[i];
        if (basin != kNoBasin)
            truth.regions[static_cast<std::size_t>(basin)][labels[i]] += 1;
    }
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].left >= 0)
            for (const int part : {nodes[i].left, nodes[i].right})
                for (const auto& [label, pixels] : truth.regions[static_cast<std::size_t>(part)])
                    truth.regions[i][label] += pixels;
    return truth;
}

using Features = std::array<float, kRegionFeatures + kOutlineFeatures>;

// Regions too small to be judged keep their places, with features of zero.
Features features_of(const RegionHierarchy& hierarchy, const RegionIndex& index, int i,
                     const EdgeField& field) {
    const RegionNode& node = hierarchy.tree.nodes[static_cast<std::size_t>(i)];
    Features features{};
    if (node.pixels.area < kLeastScoredArea)
        return features;
    const auto all = candidate_features(
        hierarchy.tree, i, region_outline(index, node, i, 1.5, Precision::Draft), field, {});
    std::copy_n(all.begin(), features.size(), features.begin());
    return features;
}

void run(char** arg) {
    const Photo photo = training::read_raw(arg[1], arg[2], arg[3]);
    const EdgeField field = training::read_field(photo, arg[4]);
    const RegionHierarchy hierarchy = region_hierarchy(photo, field, {.inside = std::stod(arg[7])});
    const RegionIndex index(hierarchy);
    const auto& nodes = hierarchy.tree.nodes;
    const Truth truth = compare(hierarchy, training::read_all<std::uint16_t>(arg[5]));
    std::vector<float> out;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        double best = 0;
        int best_label = 0;
        for (const auto& [label, pixels] : truth.regions[i]) {
            const double overlap = pixels / (nodes[i].pixels.area + truth.areas.at(label) - pixels);
            if (overlap > best) {
                best = overlap;
                best_label = label;
            }
        }
        for (const double v : {best, best_label + 0.0, nodes[i].left + 0.0, nodes[i].right + 0.0,
                               nodes[i].parent + 0.0})
            out.push_back(static_cast<float>(v));
        const auto features = features_of(hierarchy, index, static_cast<int>(i), field);
        out.insert(out.end(), features.begin(), features.end());
    }
    training::write_all(arg[6], out.data(), out.size());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 8) {
        std::cerr << "usage: export_candidates RAW WIDTH HEIGHT FIELD LABELS OUT INSIDE\n";
        return 2;
    }
    try {
        run(argv);
    } catch (const std::exception& error) {
        std::cerr << "export_candidates: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
