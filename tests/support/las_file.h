#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace scree::test {

struct LasOptions {
    int format = 0;  ///< Of the points, 0 to 10.
    double scale = 0.001;
    glm::dvec3 offset{0.0};
};

/// The bytes of a LAS file: version 1.4 for formats from 6 on, else 1.2. Classes as many as points.
inline std::string las_file(const std::vector<glm::dvec3>& points,
                            const std::vector<std::uint8_t>& classes,
                            const LasOptions& options = {}) {
    constexpr std::size_t kSizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
    const bool modern = options.format >= 6;
    const std::size_t header = modern ? 375 : 227;
    const std::size_t record = kSizes[options.format];
    std::string bytes(header + record * points.size(), '\0');
    const auto put = [&](std::size_t at, auto value) {
        std::memcpy(bytes.data() + at, &value, sizeof value);  // little-endian machines alone
    };
    bytes.replace(0, 4, "LASF");
    put(24, std::uint8_t{1});
    put(25, static_cast<std::uint8_t>(modern ? 4 : 2));
    put(94, static_cast<std::uint16_t>(header));
    put(96, static_cast<std::uint32_t>(header));
    put(104, static_cast<std::uint8_t>(options.format));
    put(105, static_cast<std::uint16_t>(record));
    put(107, static_cast<std::uint32_t>(modern ? 0 : points.size()));
    if (modern)
        put(247, static_cast<std::uint64_t>(points.size()));
    for (int k = 0; k < 3; ++k) {
        put(131 + 8 * static_cast<std::size_t>(k), options.scale);
        put(155 + 8 * static_cast<std::size_t>(k), options.offset[k]);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t at = header + record * i;
        for (int k = 0; k < 3; ++k)
            put(at + 4 * static_cast<std::size_t>(k),
                static_cast<std::int32_t>(
                    std::lround((points[i][k] - options.offset[k]) / options.scale)));
        put(at + (modern ? 16 : 15), classes[i]);
    }
    return bytes;
}

}  // namespace scree::test
