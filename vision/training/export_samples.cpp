// Export the measured values of chosen pixels, for train_field.py.
//
// usage: export_samples RAW WIDTH HEIGHT LEVEL MODEL POSITIONS OUT
//   RAW        8-bit RGB, row by row
//   MODEL      float32 numbers of the networks from level LEVEL + 1 to the coarsest
//   POSITIONS  int32 pairs x, y at the level
//   OUT        float32, one row of values a position
#include "vision/classical/classical_edge_detector.h"
#include "vision/training/tool_files.h"

#include <iostream>

namespace {

using namespace scree;
using namespace scree::vision;

// Networks of the levels above the target, as far as they are trained.
FieldModel coarser_networks(std::size_t target, std::span<const double> numbers) {
    FieldModel model;
    for (std::size_t i = target + 1; i < model.levels.size(); ++i)
        model.levels[i] = read_mlp(numbers);
    return model;
}

std::vector<float> values_at(const LightLevel& level, const Context& context,
                             const std::vector<int>& positions) {
    constexpr int kRows = 128;
    std::vector<std::vector<std::size_t>> by_strip(
        static_cast<std::size_t>(level.height / kRows + 1));
    for (std::size_t k = 0; k < positions.size() / 2; ++k)
        by_strip[static_cast<std::size_t>(positions[2 * k + 1] / kRows)].push_back(k);
    std::vector<float> values;
    for (std::size_t s = 0; s < by_strip.size(); ++s) {
        if (by_strip[s].empty())
            continue;
        const int first = static_cast<int>(s) * kRows;
        const FeatureStrip strip(level, context, first, std::min(level.height, first + kRows));
        const auto count = static_cast<std::size_t>(strip.count());
        values.resize(positions.size() / 2 * count);
        for (const std::size_t k : by_strip[s])
            for (std::size_t i = 0; i < count; ++i)
                values[k * count + i] =
                    strip.row(static_cast<int>(i), positions[2 * k + 1])[positions[2 * k]];
    }
    return values;
}

void run(char** arg) {
    const Photo photo = training::read_raw(arg[1], arg[2], arg[3]);
    const auto target = static_cast<std::size_t>(std::stoi(arg[4]));
    const LightPyramid pyramid = light_pyramid(photo);
    const auto numbers = training::read_numbers(arg[5]);
    const FieldModel model = coarser_networks(target, numbers);
    const auto positions = training::read_all<int>(arg[6]);
    std::vector<float> values;
    if (target == 0) {
        const Context above = level_field(
            pyramid.fine[1], coarse_context(pyramid.coarse, model, kFineLevels), model.levels[1]);
        values = values_at(pyramid.fine[0], context_from(above), positions);
    } else if (target == 1) {
        values = values_at(pyramid.fine[1], coarse_context(pyramid.coarse, model, kFineLevels),
                           positions);
    } else {
        const PhasedLevel* phase = &pyramid.coarse[0];
        for (std::size_t i = kFineLevels; i < target; ++i)
            phase = &phase->coarser.at(0);
        values =
            values_at(phase->level, coarse_context(phase->coarser, model, target + 1), positions);
    }
    training::write_all(arg[7], values.data(), values.size());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 8) {
        std::cerr << "usage: export_samples RAW WIDTH HEIGHT LEVEL MODEL POSITIONS OUT\n";
        return 2;
    }
    try {
        run(argv);
    } catch (const std::exception& error) {
        std::cerr << "export_samples: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
