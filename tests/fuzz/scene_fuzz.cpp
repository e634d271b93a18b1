#include "base/error.h"
#include "terrain/contact/object_motion.h"
#include "terrain/scene/scene_file.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

// Any bytes are a scene whose objects have a finite place at every time, or an error of ours.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scree::terrain;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const Scene scene = scene_from_json(text, "fuzz", "/nowhere");
        for (const SceneObject& object : scene.objects)
            for (const double time : {-1.0, 0.0, 0.7, 1e6})
                if (!std::isfinite(matrix_of(pose_at(object.motion, time))[3].x))
                    std::abort();
    } catch (const scree::Error&) {
    }
    return 0;
}
