#include "terrain/material/repeating_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

float linear_from_srgb(int code) {
    const float v = static_cast<float>(code) / 255.0F;
    return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

std::uint8_t srgb_from_linear(float light) {
    const float v = std::clamp(light, 0.0F, 1.0F);
    const float code = v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1.0F / 2.4F) - 0.055F;
    return static_cast<std::uint8_t>(std::lround(255.0F * code));
}

// Mean of the texels that fall into one of `n` equal parts of `length`, by area.
template <class Value>
std::vector<Value> averaged(const std::vector<Value>& line, int n) {
    const double step = static_cast<double>(line.size()) / n;
    std::vector<Value> result;
    for (int i = 0; i < n; ++i) {
        const double begin = i * step;
        const double end = (i + 1) * step;
        Value sum{};
        for (auto k = static_cast<std::size_t>(begin);
             k < line.size() && static_cast<double>(k) < end; ++k) {
            const double low = std::max(begin, static_cast<double>(k));
            const double high = std::min(end, static_cast<double>(k) + 1.0);
            sum += static_cast<float>((high - low) / step) * line[k];
        }
        result.push_back(sum);
    }
    return result;
}

template <class Value>
Raster<Value> shrunk(const Raster<Value>& texels, int width, int height) {
    Raster<Value> narrow(width, texels.height());
    for (int y = 0; y < texels.height(); ++y) {
        const std::vector<Value> row(texels.row(y), texels.row(y) + texels.width());
        const std::vector<Value> mean = averaged(row, width);
        std::copy(mean.begin(), mean.end(), narrow.row(y));
    }
    Raster<Value> result(width, height);
    std::vector<Value> column(static_cast<std::size_t>(texels.height()));
    for (int x = 0; x < width; ++x) {
        for (int y = 0; y < texels.height(); ++y)
            column[static_cast<std::size_t>(y)] = narrow(x, y);
        const std::vector<Value> mean = averaged(column, height);
        for (int y = 0; y < height; ++y)
            result(x, y) = mean[static_cast<std::size_t>(y)];
    }
    return result;
}

int wrapped(int i, int n) {
    return (i % n + n) % n;
}

}  // namespace

template <class Value>
RepeatingTexture<Value>::RepeatingTexture(const Raster<Value>& texels, double size_m,
                                          double pixel_m)
    : size_m_(size_m) {
    const double wanted = std::clamp(std::ceil(size_m / pixel_m), 1.0, 1e6);
    const int width = std::min(texels.width(), static_cast<int>(wanted));
    const int height = std::min(texels.height(), static_cast<int>(wanted));
    const bool finer = width < texels.width() || height < texels.height();
    texels_ = finer ? shrunk(texels, width, height) : texels;
}

template <class Value>
Value RepeatingTexture<Value>::at(double x, double z) const {
    const double u = (x / size_m_ - std::floor(x / size_m_)) * texels_.width() - 0.5;
    const double v = (z / size_m_ - std::floor(z / size_m_)) * texels_.height() - 0.5;
    const int x0 = static_cast<int>(std::floor(u));
    const int y0 = static_cast<int>(std::floor(v));
    const auto fx = static_cast<float>(u - x0);
    const auto fy = static_cast<float>(v - y0);
    const auto texel = [this](int column, int row) {
        return texels_(wrapped(column, texels_.width()), wrapped(row, texels_.height()));
    };
    const Value top = (1.0F - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0);
    const Value bottom = (1.0F - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1);
    return (1.0F - fy) * top + fy * bottom;
}

template class RepeatingTexture<float>;
template class RepeatingTexture<glm::vec3>;

Raster<glm::vec3> linear_light(const Photo& photo) {
    std::array<float, 256> table;
    for (int code = 0; code < 256; ++code)
        table[static_cast<std::size_t>(code)] = linear_from_srgb(code);
    Raster<glm::vec3> light(photo.width(), photo.height());
    std::transform(photo.begin(), photo.end(), light.begin(),
                   [&](glm::u8vec3 c) { return glm::vec3(table[c.x], table[c.y], table[c.z]); });
    return light;
}

glm::u8vec3 srgb_colour(glm::vec3 light) {
    return {srgb_from_linear(light.x), srgb_from_linear(light.y), srgb_from_linear(light.z)};
}

Raster<glm::vec3> unit_normals(const Photo& photo) {
    Raster<glm::vec3> normals(photo.width(), photo.height());
    std::transform(photo.begin(), photo.end(), normals.begin(),
                   [](glm::u8vec3 c) { return glm::vec3(c) / 127.5F - 1.0F; });
    return normals;
}

glm::u8vec3 normal_colour(glm::vec3 normal) {
    const float length = glm::length(normal);
    const glm::vec3 unit = length > 0.0F ? normal / length : glm::vec3(0.0F, 0.0F, 1.0F);
    const auto byte = [](float v) {
        return static_cast<std::uint8_t>(
            std::lround(std::clamp((v + 1.0F) * 127.5F, 0.0F, 255.0F)));
    };
    return {byte(unit.x), byte(unit.y), byte(unit.z)};
}

}  // namespace scree::terrain
