#include "base/error.h"
#include "terrain/material/id_text.h"

#include <cstdint>
#include <cstdlib>

// Any bytes are an id file that round-trips, or an error of ours.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scree::terrain;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const std::string once = ids_to_text(ids_from_text(text, "fuzz", "dir"), "dir");
        if (ids_to_text(ids_from_text(once, "again", "dir"), "dir") != once)
            std::abort();
    } catch (const scree::Error&) {
    }
    return 0;
}
