#include "base/error.h"
#include "vision/data/rockdata_text.h"

#include <cstdint>
#include <cstdlib>

// Any bytes are rocks that round-trip, or an error of ours.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scree::vision;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const std::string once = rocks_to_text(rocks_from_text(text, "fuzz", {.max_pixels = 1e5}));
        if (rocks_to_text(rocks_from_text(once, "again")) != once)
            std::abort();
    } catch (const scree::Error&) {
    }
    return 0;
}
