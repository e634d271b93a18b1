// Write the learned edge field of a photograph, so that a network can be judged by what the
// program makes of it.
//
// usage: export_field PHOTO OUT [--model FILE] [--fusion NUMBERS] [--FIELD NUMBER]...
//   FIELD    of LearnedOptions, such as levels, adapt (0 or 1), full, none
//   OUT      float32 planes of the photograph's size: boundary, inside, distance
//   NUMBERS  float32 numbers that read_fusion() takes
#include "base/error.h"
#include "vision/image_io.h"
#include "vision/learned/learned_edge_detector.h"
#include "vision/training/tool_files.h"

#include <iostream>
#include <span>

namespace {

using namespace scree;
using namespace scree::vision;

struct Wishes {
    LearnedOptions options;
    std::string model, fusion;
};

void set_option(const std::string& flag, const std::string& text, Wishes& wishes) {
    if (flag == "--model") {
        wishes.model = text;
        return;
    }
    if (flag == "--fusion") {
        wishes.fusion = text;
        return;
    }
    bool known = false;
    describe(wishes.options, [&](std::string_view name, auto& value, const FieldInfo&) {
        if (flag != "--" + std::string(name))
            return;
        known = true;
        value = static_cast<std::remove_reference_t<decltype(value)>>(std::stod(text));
    });
    if (!known)
        fail<InvalidOption>("unknown flag ", flag);
}

void run(std::span<char*> words) {
    Wishes wishes;
    for (std::size_t i = 3; i + 1 < words.size(); i += 2)
        set_option(words[i], words[i + 1], wishes);
    const LearnedEdgeDetector detector(
        wishes.options, wishes.model.empty() ? shipped_network() : read_network(wishes.model),
        wishes.fusion.empty() ? shipped_fusion()
                              : read_fusion(training::read_numbers(wishes.fusion)));
    const EdgeField field = detector.detect(read_photo(words[1]).pixels);
    std::vector<float> planes;
    for (const FloatRaster* plane : {&field.boundary, &field.inside, &field.distance})
        planes.insert(planes.end(), plane->begin(), plane->end());
    training::write_all(words[2], planes.data(), planes.size());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3 || argc % 2 == 0) {
        std::cerr << "usage: export_field PHOTO OUT [--model FILE] [--fusion NUMBERS]"
                     " [--FIELD NUMBER]...\n";
        return 2;
    }
    try {
        run(std::span(argv, static_cast<std::size_t>(argc)));
    } catch (const std::exception& error) {
        std::cerr << "export_field: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
