// Segment a photograph with given models, so that a fold can be judged on pictures it never saw.
//
// usage: segment RAW WIDTH HEIGHT FIELD SCORE OUT
//   FIELD, SCORE  float32 numbers of the networks
//   OUT           uint16 label map, row by row
#include "vision/classical/candidate_outline_finder.h"
#include "vision/classical/classical_edge_detector.h"
#include "vision/training/tool_files.h"

#include <iostream>

namespace {

using namespace scree;
using namespace scree::vision;

void run(char** arg) {
    const Photo photo = training::read_raw(arg[1], arg[2], arg[3]);
    const auto field_numbers = training::read_numbers(arg[4]);
    const FieldModel model = read_field_model(field_numbers);
    const auto score_numbers = training::read_numbers(arg[5]);
    const ScoreModel score = read_score_model(score_numbers);
    const EdgeField field = ClassicalEdgeDetector(model).detect(photo);
    const auto outlines = CandidateOutlineFinder({}, score).find(photo, field);
    const LabelMap labels = paint_labels(outlines, photo.width(), photo.height());
    training::write_all(arg[6], labels.data(), labels.size());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 7) {
        std::cerr << "usage: segment RAW WIDTH HEIGHT FIELD SCORE OUT\n";
        return 2;
    }
    try {
        run(argv);
    } catch (const std::exception& error) {
        std::cerr << "segment: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
