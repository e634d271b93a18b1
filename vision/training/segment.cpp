// Segment a photograph with given models, so that a fold can be judged on pictures it never saw.
//
// usage: segment RAW WIDTH HEIGHT FIELD SCORE OUT [CAUTION [MIN_SIZE [plain]]]
//   FIELD  float32 planes of an edge field (.f32) or numbers of the classical networks
//   SCORE  float32 numbers of the networks that score candidates
//   OUT    uint16 label map, row by row, after refinement; before it with "plain"
#include "vision/classical/candidate_outline_finder.h"
#include "vision/refine/refine_outlines.h"
#include "vision/training/field_source.h"

#include <iostream>

namespace {

using namespace scree;
using namespace scree::vision;

void run(const std::vector<std::string>& arg) {
    const Photo photo = training::read_raw(arg[0], arg[1], arg[2]);
    const EdgeField field = training::read_field(photo, arg[3]);
    const auto score_numbers = training::read_numbers(arg[4]);
    const ScoreModel score = read_score_model(score_numbers);
    CandidateOptions options;
    if (arg.size() > 6)
        options.caution = std::stod(arg[6]);
    if (arg.size() > 7)
        options.min_size = std::stod(arg[7]);
    auto outlines = CandidateOutlineFinder(options, score).find(photo, field);
    if (arg.size() < 9) {
        const auto refined = refine_outlines(photo, field, outlines);
        std::ranges::transform(refined.rocks, outlines.begin(), &Rock::outline);
    }
    const LabelMap labels = paint_labels(outlines, photo.width(), photo.height());
    training::write_all(arg[5], labels.data(), labels.size());
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() < 6 || words.size() > 9 || (words.size() == 9 && words[8] != "plain")) {
        std::cerr << "usage: segment RAW WIDTH HEIGHT FIELD SCORE OUT [CAUTION [MIN_SIZE "
                     "[plain]]]\n";
        return 2;
    }
    try {
        run(words);
    } catch (const std::exception& error) {
        std::cerr << "segment: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
