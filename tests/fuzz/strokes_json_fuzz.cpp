#include "base/error.h"
#include "terrain/material/strokes.h"

#include <cstdint>
#include <cstdlib>

// Any bytes are strokes that can be laid on a small ground, or an error of ours.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scree::terrain;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    Material sand;
    sand.name = "sand";
    Material mud;
    mud.id = 7;
    mud.name = "mud";
    try {
        StrokeScript script = strokes_from_json(text, "fuzz", {sand, mud});
        const std::string once = strokes_to_json(script);
        if (strokes_to_json(strokes_from_json(once, "again", {sand, mud})) != once)
            std::abort();
        script.width = script.width == 0 ? 0 : 24;
        script.height = 16;
        if (script.width > 0)
            for (const std::uint8_t id : map_from_strokes(script, {sand, mud}).ids)
                if (id != 0 && id != 7)
                    std::abort();
    } catch (const scree::Error&) {
    }
    return 0;
}
