#include "terrain/view/look_layers.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/vec2.hpp>

namespace scree::terrain {
namespace {

float clamped_byte(float value) {
    return std::clamp(std::round(value), 0.0F, 255.0F);
}

// Columns (or rows) of a source under each of `side` target ones: boxes when it shrinks, linear
// between centres, round the seam, when it grows.
struct Taps {
    std::vector<std::vector<std::pair<int, float>>> of;
    Taps(int source, int side) : of(static_cast<std::size_t>(side)) {
        const double ratio = static_cast<double>(source) / side;
        for (int t = 0; t < side; ++t) {
            auto& taps = of[static_cast<std::size_t>(t)];
            if (ratio <= 1.0) {
                const double at = (t + 0.5) * ratio - 0.5;
                const int low = static_cast<int>(std::floor(at));
                const auto share = static_cast<float>(at - low);
                taps = {{(low + source) % source, 1.0F - share}, {(low + 1) % source, share}};
                continue;
            }
            const double begin = t * ratio;
            const double end = (t + 1) * ratio;
            for (int s = static_cast<int>(begin); s < source && s < end; ++s)
                taps.emplace_back(
                    s, static_cast<float>((std::min(end, s + 1.0) - std::max(begin, double(s))) /
                                          ratio));
        }
    }
};

template <class Value, class Read>
Raster<Value> resampled(int width, int height, int side, Read&& read) {
    const Taps columns(width, side);
    const Taps rows(height, side);
    Raster<Value> narrow(side, height);
    parallel_for_each_index(0, static_cast<std::size_t>(height), 8, [&](std::size_t y) {
        for (int x = 0; x < side; ++x) {
            Value sum{};
            for (const auto& [s, share] : columns.of[static_cast<std::size_t>(x)])
                sum += read(s, static_cast<int>(y)) * share;
            narrow(x, static_cast<int>(y)) = sum;
        }
    });
    Raster<Value> out(side, side);
    parallel_for_each_index(0, static_cast<std::size_t>(side), 8, [&](std::size_t y) {
        for (int x = 0; x < side; ++x) {
            Value sum{};
            for (const auto& [s, share] : rows.of[y])
                sum += narrow(x, s) * share;
            out(x, static_cast<int>(y)) = sum;
        }
    });
    return out;
}

// Mean over a square of 2 radius + 1 texels, round the seams.
FloatRaster blurred(const FloatRaster& in, int radius) {
    const int n = in.width();
    const auto wrap = [n](int i) { return (i % n + n) % n; };
    FloatRaster rows(n, n);
    FloatRaster out(n, n);
    const float share = 1.0F / static_cast<float>(2 * radius + 1);
    for (int y = 0; y < n; ++y) {
        double sum = 0.0;
        for (int k = -radius; k <= radius; ++k)
            sum += in(wrap(k), y);
        for (int x = 0; x < n; ++x) {
            rows(x, y) = static_cast<float>(sum) * share;
            sum += double{in(wrap(x + radius + 1), y)} - in(wrap(x - radius), y);
        }
    }
    for (int x = 0; x < n; ++x) {
        double sum = 0.0;
        for (int k = -radius; k <= radius; ++k)
            sum += rows(x, wrap(k));
        for (int y = 0; y < n; ++y) {
            out(x, y) = static_cast<float>(sum) * share;
            sum += double{rows(x, wrap(y + radius + 1))} - rows(x, wrap(y - radius));
        }
    }
    return out;
}

Raster<glm::vec2> slopes_of_heights(const FloatRaster& heights, double size_m) {
    const int n = heights.width();
    const auto per_span = static_cast<float>(n / (2.0 * size_m));
    Raster<glm::vec2> slopes(n, n);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            slopes(x, y) = {(heights((x + 1) % n, y) - heights((x + n - 1) % n, y)) * per_span,
                            (heights(x, (y + 1) % n) - heights(x, (y + n - 1) % n)) * per_span};
    return slopes;
}

// glTF: red to the right, green to the top of the picture, which is -z on the ground.
glm::vec2 slope_of_normal(const glm::u8vec3& c) {
    const float up = std::max(static_cast<float>(c.z) / 127.5F - 1.0F, 0.15F);
    return {-(static_cast<float>(c.x) - 128.0F) / 127.5F / up,
            (static_cast<float>(c.y) - 128.0F) / 127.5F / up};
}

void add_albedo(const MaterialLook& look, int side, std::vector<std::uint8_t>& out) {
    static const auto table = [] {
        std::array<float, 256> linear{};
        for (std::size_t i = 0; i < 256; ++i)
            linear[i] = linear_of_srgb(static_cast<float>(i) / 255.0F);
        return linear;
    }();
    const auto srgb = [](float v) {
        return v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1.0F / 2.4F) - 0.055F;
    };
    if (look.albedo.empty())
        return;
    const auto linear =
        resampled<glm::vec3>(look.albedo.width(), look.albedo.height(), side, [&](int x, int y) {
            const glm::u8vec3 c = look.albedo(x, y);
            return glm::vec3(table[c.x], table[c.y], table[c.z]);
        });
    for (const glm::vec3& c : linear) {
        for (int i = 0; i < 3; ++i)
            out.push_back(static_cast<std::uint8_t>(clamped_byte(255.0F * srgb(c[i]))));
        out.push_back(255);
    }
}

// The detail of one look: heights about their mean, slopes, and the sky that its hollows see.
struct Detail {
    FloatRaster heights;
    Raster<glm::vec2> slopes;
    float range = 0.0F;     // of the heights, metres
    float steepest = 0.0F;  // of the slopes
};

Detail detail_of(const MaterialLook& look, int side) {
    Detail detail;
    if (!look.displacement.empty()) {
        detail.heights =
            resampled<float>(look.displacement.width(), look.displacement.height(), side,
                             [&](int x, int y) { return look.displacement(x, y); });
        double sum = 0.0;
        for (const float h : detail.heights)
            sum += h;
        const auto mean = static_cast<float>(sum / static_cast<double>(detail.heights.size()));
        for (float& h : detail.heights) {
            h -= mean;
            detail.range = std::max(detail.range, 2.0F * std::abs(h));
        }
    }
    if (!look.normal.empty())
        detail.slopes =
            resampled<glm::vec2>(look.normal.width(), look.normal.height(), side,
                                 [&](int x, int y) { return slope_of_normal(look.normal(x, y)); });
    else if (!detail.heights.empty())
        detail.slopes = slopes_of_heights(detail.heights, look.size_m);
    for (const glm::vec2& s : detail.slopes)
        detail.steepest = std::max({detail.steepest, std::abs(s.x), std::abs(s.y)});
    detail.steepest = std::min(detail.steepest, 4.0F);
    return detail;
}

void add_detail(const Detail& detail, int side, std::uint8_t* out) {
    FloatRaster narrow;
    FloatRaster wide;
    if (detail.range > 0.0F) {
        narrow = blurred(detail.heights, std::max(1, side / 96));
        wide = blurred(detail.heights, std::max(1, side / 24));
    }
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x, out += 4) {
            const glm::vec2 slope =
                detail.steepest > 0.0F ? detail.slopes(x, y) / detail.steepest : glm::vec2(0.0F);
            out[0] = static_cast<std::uint8_t>(clamped_byte(128.0F + 127.0F * slope.x));
            out[1] = static_cast<std::uint8_t>(clamped_byte(128.0F + 127.0F * slope.y));
            out[2] = 128;
            out[3] = 255;
            if (!(detail.range > 0.0F))
                continue;
            const float h = detail.heights(x, y) / detail.range;
            const float below = std::max(0.0F, narrow(x, y) / detail.range - h) * 1.6F +
                                std::max(0.0F, wide(x, y) / detail.range - h) * 1.1F;
            out[2] = static_cast<std::uint8_t>(clamped_byte(255.0F * (h + 0.5F)));
            out[3] = static_cast<std::uint8_t>(clamped_byte(255.0F / (1.0F + 1.5F * below)));
        }
}

void check_look(const MaterialLook& look, std::size_t index) {
    if (!(look.size_m > 0.0) || !std::isfinite(look.size_m))
        fail<InvalidInput>("look ", index, " repeats every ", look.size_m,
                           " m, it must be positive");
    for (const float h : look.displacement)
        if (!std::isfinite(h))
            fail<InvalidInput>("look ", index, " has a displacement that is no finite number");
}

int common_side(std::span<const MaterialLook> looks, std::size_t max_bytes) {
    int longest = 1;
    for (const MaterialLook& look : looks)
        longest =
            std::max({longest, look.albedo.width(), look.albedo.height(), look.displacement.width(),
                      look.displacement.height(), look.normal.width(), look.normal.height()});
    int side = 1;
    while (side < longest && side < 1024)
        side *= 2;
    const auto bytes = [&](int s) {
        return looks.size() * 12U * static_cast<std::size_t>(s) * static_cast<std::size_t>(s);
    };
    while (side > 16 && bytes(side) > max_bytes)
        side /= 2;
    return side;
}

}  // namespace

float linear_of_srgb(float value) {
    return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

LookLayers make_look_layers(std::span<const MaterialLook> looks, std::size_t max_bytes) {
    for (std::size_t i = 0; i < looks.size(); ++i)
        check_look(looks[i], i);
    LookLayers layers;
    layers.side = common_side(looks, max_bytes);
    const std::size_t n =
        4U * static_cast<std::size_t>(layers.side) * static_cast<std::size_t>(layers.side);
    layers.detail.resize(looks.size() * n);
    for (std::size_t i = 0; i < looks.size(); ++i) {
        const MaterialLook& look = looks[i];
        add_albedo(look, layers.side, layers.albedo);
        const Detail detail = detail_of(look, layers.side);
        layers.relief.insert(layers.relief.end(), detail.heights.begin(), detail.heights.end());
        add_detail(detail, layers.side, layers.detail.data() + i * n);
        LookRecord record;
        for (int c = 0; c < 3; ++c)
            record.colour[c] = linear_of_srgb(std::clamp(look.colour[c], 0.0F, 1.0F));
        record.colour.w = std::clamp(look.roughness, 0.05F, 1.0F);
        record.measure = {static_cast<float>(1.0 / look.size_m), detail.range, detail.steepest,
                          look.albedo.empty() ? 0.0F : 1.0F};
        layers.records.push_back(record);
    }
    return layers;
}

}  // namespace scree::terrain
