#pragma once

// Inside image_io alone; not installed.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace scree::vision {

/// How a row is told from its neighbours before it is compressed: by the numbers of the PNG format.
enum class PngFilter : std::uint8_t {
    Above = 2,    ///< Less the value above; for labels, whose rows repeat.
    Average = 3,  ///< Less the mean of the values to the left and above; for photographs and maps.
};

/// What a PNG file is made of. Samples lie row by row without padding, in the machine's order.
struct PngPicture {
    std::size_t width = 0;
    std::size_t height = 0;
    int n_channels = 1;  ///< 1 grey, 3 red, green and blue, 4 with alpha, not premultiplied.
    int bits = 8;        ///< Of a sample: 8 or 16.
    const void* samples = nullptr;
    PngFilter filter = PngFilter::Average;
    bool is_srgb = false;  ///< Says that the values are colours of a screen.
    std::vector<std::pair<std::string, std::string>> texts = {};  ///< Keyword and Latin-1 text.
};

/// The file in memory. The bytes do not depend on the number of threads.
/// @pre  The picture has pixels.
/// @throw std::bad_alloc
std::vector<std::uint8_t> encode_png(const PngPicture& picture);

}  // namespace scree::vision
