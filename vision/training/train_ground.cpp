// Trains and scores the classifier of ground on made-up pictures.
//
//   train_ground train FILE     writes the weights (vision/classify/ground_weights.inc)
//   train_ground score          confusion matrix on pictures that training never saw
//   train_ground describe       the weights as a table
//   train_ground pictures DIR   three of the pictures of `score` beside what was found

#include "base/error.h"
#include "testdata/ground_mosaic.h"
#include "vision/classify/classify_ground.h"
#include "vision/classify/confusion.h"
#include "vision/image_io.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace scree;
using namespace scree::vision;

constexpr int kSide = 320;
constexpr std::uint64_t kTrainingSeeds = 180;
constexpr std::size_t kEvery = 5;  // of the pieces is a sample; neighbours hardly differ
constexpr std::uint64_t kFirstTestSeed = 900'001;
constexpr std::uint64_t kTestSeeds = 24;

struct Samples {
    std::vector<GroundFeatures> features;
    std::vector<GroundClass> classes;
};

// Pieces of which nine tenths are of one class.
void add_samples(const test::GroundMosaic& mosaic, Samples& samples) {
    const Raster<glm::vec3> lab = lab_of(mosaic.photo);
    const Superpixels pieces = superpixels(lab);
    const std::vector<GroundFeatures> features = ground_features(lab, pieces);
    std::vector<std::array<double, kGroundClasses>> counts(features.size());
    for (std::size_t i = 0; i < pieces.ids.size(); ++i)
        counts[static_cast<std::size_t>(pieces.ids.data()[i])][mosaic.classes.data()[i]] += 1.0;
    for (std::size_t i = 0; i < features.size(); i += kEvery) {
        double sum = 0.0;
        for (const double count : counts[i])
            sum += count;
        for (std::size_t c = 0; c < kGroundClasses; ++c)
            if (counts[i][c] >= 0.9 * sum) {
                samples.features.push_back(features[i]);
                samples.classes.push_back(static_cast<GroundClass>(c));
            }
    }
}

void write_weights(const GroundModel& model, const std::string& path) {
    std::ofstream file(path);
    file << "// Written by vision/training/train_ground.cpp; do not edit.\n// " << kTrainingSeeds
         << " made-up pictures of " << kSide << " px.\n";
    file.precision(6);
    int column = 0;
    const auto write = [&](float value) { file << value << (++column % 10 == 0 ? ",\n" : ","); };
    for (const GroundFeatures* values : {&model.mean, &model.deviation})
        for (const float value : *values)
            write(value);
    for (const auto& weights : model.weights)
        for (const float value : weights)
            write(value);
    file << "\n";
}

void train(const std::string& path) {
    Samples samples;
    for (std::uint64_t seed = 1; seed <= kTrainingSeeds; ++seed) {
        add_samples(test::make_ground_mosaic(kSide, kSide, seed), samples);
        std::cerr << '.';
    }
    std::cerr << "\n" << samples.features.size() << " samples\n";
    const GroundModel model = train_ground_model(samples.features, samples.classes);
    ConfusionMatrix matrix;
    for (std::size_t i = 0; i < samples.features.size(); ++i) {
        const ClassScores scores = log_probabilities(model, samples.features[i]);
        const auto found = std::max_element(scores.begin(), scores.end()) - scores.begin();
        matrix.counts[static_cast<std::size_t>(samples.classes[i])]
                     [static_cast<std::size_t>(found)] += 1.0;
    }
    std::cout << "on the training samples themselves:\n" << confusion_table(matrix);
    write_weights(model, path);
}

void score() {
    ConfusionMatrix smoothed;
    ConfusionMatrix single;
    GroundOptions alone;
    alone.smoothing = 0;
    for (std::uint64_t seed = kFirstTestSeed; seed < kFirstTestSeed + kTestSeeds; ++seed) {
        const auto mosaic = test::make_ground_mosaic(kSide, kSide, seed);
        add_to_confusion(smoothed, mosaic.classes, classify_ground(mosaic.photo).classes);
        add_to_confusion(single, mosaic.classes, classify_ground(mosaic.photo, alone).classes);
    }
    std::cout << "every piece by itself:\n"
              << confusion_table(single) << "\nsmoothed:\n"
              << confusion_table(smoothed);
}

void pictures(const std::string& folder) {
    for (std::uint64_t i = 0; i < 3; ++i) {
        const auto mosaic = test::make_ground_mosaic(kSide, kSide, kFirstTestSeed + i);
        const std::string name = folder + "/mosaic_" + std::to_string(i);
        write_png(name + "_photo.png", mosaic.photo);
        write_png(name + "_truth.png", draw_regions(mosaic.photo, mosaic.classes));
        write_png(name + "_found.png",
                  draw_regions(mosaic.photo, classify_ground(mosaic.photo).classes));
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "";
    try {
        if (what == "train" && argc == 3)
            train(argv[2]);
        else if (what == "score")
            score();
        else if (what == "describe")
            std::cout << describe_model(shipped_ground_model());
        else if (what == "pictures" && argc == 3)
            pictures(argv[2]);
        else
            std::cerr << "usage: train_ground train FILE | score | describe | pictures DIR\n";
    } catch (const Error& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
