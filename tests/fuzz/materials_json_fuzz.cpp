#include "base/error.h"
#include "terrain/material/layers_json.h"
#include "terrain/material/map_rules.h"
#include "terrain/material/materials_json.h"

#include <cstdint>
#include <cstdlib>

// Any bytes are a table of materials that round-trips, or rules, or layers, or an error of ours.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scree::terrain;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const std::string once = materials_to_json(materials_from_json(text, "fuzz", "dir"), "dir");
        if (materials_to_json(materials_from_json(once, "again", "dir"), "dir") != once)
            std::abort();
    } catch (const scree::Error&) {
    }
    Material sand;
    sand.name = "sand";
    try {
        rules_from_json(text, "fuzz", {sand});
    } catch (const scree::Error&) {
    }
    try {
        const LayerStack stack = layers_from_json(text, "fuzz", {sand}, "dir");
        if (stack.layers.empty() || !(stack.surface_depth_m > 0.0))
            std::abort();
    } catch (const scree::Error&) {
    }
    return 0;
}
