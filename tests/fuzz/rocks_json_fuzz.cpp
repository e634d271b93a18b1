#include "base/error.h"
#include "vision/data/grain_size.h"
#include "vision/data/rocks_json.h"

#include <cstdint>
#include <cstdlib>

// Any bytes are rocks that round-trip, can be measured and painted, or an error of ours.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scree::vision;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const RockSet set = rocks_from_json(text, "fuzz", {.max_pixels = 1e5});
        const std::string once = rocks_to_json(set);
        if (rocks_to_json(rocks_from_json(once, "again")) != once)
            std::abort();
        grain_size_curve(set);
        std::vector<Outline> outlines;
        for (const Rock& rock : set.rocks)
            outlines.push_back(rock.outline);
        paint_labels(outlines, set.width, set.height);
    } catch (const scree::Error&) {
    }
    return 0;
}
