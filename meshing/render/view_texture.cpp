#include "meshing/render/view_texture.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scree::meshing {
namespace {

const std::array<float, 256>& linear_table() {
    static const auto table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double c = static_cast<double>(i) / 255.0;
            values[i] =
                static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
        }
        return values;
    }();
    return table;
}

}  // namespace

Photo shrunk_photo(const Photo& photo, int factor) {
    const int width = std::max(1, photo.width() / factor);
    const int height = std::max(1, photo.height() / factor);
    Photo out(width, height);
    parallel_for_each_index(0, static_cast<std::size_t>(height), 8, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        const int bottom = std::min(photo.height(), (y + 1) * factor);
        for (int x = 0; x < width; ++x) {
            const int right = std::min(photo.width(), (x + 1) * factor);
            glm::uvec3 sum(0);
            for (int v = y * factor; v < bottom; ++v)
                for (int u = x * factor; u < right; ++u)
                    sum += glm::uvec3(photo(u, v));
            const int n = (bottom - y * factor) * (right - x * factor);
            out(x, y) = glm::u8vec3(sum / static_cast<std::uint32_t>(n));
        }
    });
    return out;
}

glm::vec3 light_at(const Photo& photo, const glm::vec2& texcoord) {
    const auto& linear = linear_table();
    const auto right_most = static_cast<float>(photo.width() - 1);
    const auto lowest = static_cast<float>(photo.height() - 1);
    const float u =
        std::clamp(texcoord.x * static_cast<float>(photo.width()) - 0.5F, 0.0F, right_most);
    const float v =
        std::clamp(texcoord.y * static_cast<float>(photo.height()) - 0.5F, 0.0F, lowest);
    const int x = static_cast<int>(u);
    const int y = static_cast<int>(v);
    const float fx = u - static_cast<float>(x);
    const float fy = v - static_cast<float>(y);
    const auto light = [&](int column, int row) {
        const glm::u8vec3& c =
            photo(std::min(column, photo.width() - 1), std::min(row, photo.height() - 1));
        return glm::vec3(linear[c.x], linear[c.y], linear[c.z]);
    };
    const glm::vec3 above = light(x, y) * (1 - fx) + light(x + 1, y) * fx;
    const glm::vec3 below = light(x, y + 1) * (1 - fx) + light(x + 1, y + 1) * fx;
    return above * (1 - fy) + below * fy;
}

std::uint8_t coded_byte(float light) {
    static const auto table = [] {
        std::array<std::uint8_t, 4097> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double v = static_cast<double>(i) / 4096.0;
            const double c = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
            values[i] = static_cast<std::uint8_t>(std::lround(255.0 * c));
        }
        return values;
    }();
    return table[static_cast<std::size_t>((light > 0.0F ? std::min(light, 1.0F) : 0.0F) * 4096.0F +
                                          0.5F)];
}

}  // namespace scree::meshing
