#include "base/error.h"
#include "tests/fuzz/memory_file.h"
#include "vision/data/metrics.h"
#include "vision/image_io.h"

// Any bytes are a label map that scores fully against itself, or an error of ours.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scree::vision;
    static const scree::fuzz::MemoryFile file;
    try {
        const scree::LabelMap labels = read_labels(file.hold(data, size), {.max_pixels = 2e4});
        const LabelScore score = score_labels(labels, labels);
        if (score.n_truth != score.true_positives || score.n_truth != score.n_found)
            std::abort();
    } catch (const scree::Error&) {
    }
    return 0;
}
