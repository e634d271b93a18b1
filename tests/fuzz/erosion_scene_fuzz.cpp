#include "base/error.h"
#include "terrain/surface/erosion_scene.h"

#include <cstdint>
#include <string_view>

// Any bytes are a scene whose water can be set up, or an error of ours.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const auto scene = scree::terrain::erosion_scene_from_json(text, "fuzz");
        const scree::terrain::PositionFluid water(scene.water);
        scree::check(scene.ground);
        scree::check(scene.run);
        scree::check(scene.wear);
        scree::check(scene.sediment);
        scree::check(scene.output);
    } catch (const scree::Error&) {
    }
    return 0;
}
