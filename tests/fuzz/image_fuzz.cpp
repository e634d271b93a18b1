#include "base/error.h"
#include "tests/fuzz/memory_file.h"
#include "vision/image_io.h"

#include <cmath>

// Any bytes are a photograph of the declared size, heights, four channels or planes, or an error of
// ours.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scree::vision;
    static const scree::fuzz::MemoryFile file;
    const auto& path = file.hold(data, size);
    const ReadLimits limits{.max_pixels = 2e4};
    try {
        const PhotoFile photo = read_photo(path, limits);
        if (photo.pixels.empty() || static_cast<double>(photo.pixels.size()) > limits.max_pixels)
            std::abort();
    } catch (const scree::Error&) {
    }
    try {
        const HeightImage heights = read_heights(path, limits);
        for (const float height : heights.metres)
            if (!std::isfinite(height))
                std::abort();
    } catch (const scree::Error&) {
    }
    try {
        const RgbaImage picture = read_rgba(path, limits);
        if (picture.values.empty() || (picture.bits != 8 && picture.bits != 16))
            std::abort();
    } catch (const scree::Error&) {
    }
    try {
        for (const NamedPlane& plane : read_planes(path, limits))
            for (const float value : plane.values)
                if (!std::isfinite(value))
                    std::abort();
    } catch (const scree::Error&) {
    }
    return 0;
}
