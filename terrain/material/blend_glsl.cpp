#include "terrain/material/blend_glsl.h"

#include "base/number_text.h"
#include "terrain/material/corner_blend.h"
#include "terrain/material/hat_blend.h"

#include <algorithm>

namespace scree::terrain {
namespace {

constexpr std::string_view kIdentity = R"(
int scree_slot(uint id) { return min(int(id), SCREE_LAST_ID); }
)";
constexpr std::string_view kLookedUp = R"(
int scree_slot(uint id) { return SCREE_SLOT[min(int(id), SCREE_LAST_ID)]; }
)";

// What every blend reads.
std::string common_tables(const std::vector<Material>& materials, double cell_size) {
    std::string text = "// Made from a description map.\nuniform usampler2D scree_ids;\n";
    text += "const float SCREE_CELL = " + glsl_number(cell_size) + ";\n";
    text += "const int SCREE_MATERIALS = " + std::to_string(materials.size()) + ";\n";
    return text + glsl_constant("float", "SCREE_SIZE", materials, [](const Material& one) {
               return glsl_number(one.textures.size_m);
           });
}

std::string hat_tables(const std::vector<Material>& materials) {
    const auto number = [](double value) { return glsl_number(value); };
    std::vector<double> a, b, c, first, last;
    for (const HatBreaks& hat : hat_breaks(materials)) {
        a.push_back(hat.a);
        b.push_back(hat.b);
        c.push_back(hat.c);
        first.push_back(hat.first ? 1.0 : 0.0);
        last.push_back(hat.last ? 1.0 : 0.0);
    }
    return glsl_constant("float", "SCREE_START", a, number) +
           glsl_constant("float", "SCREE_PEAK", b, number) +
           glsl_constant("float", "SCREE_END", c, number) +
           glsl_constant("float", "SCREE_FIRST", first, number) +
           glsl_constant("float", "SCREE_LAST", last, number);
}

constexpr std::string_view kCorners = R"(
// Shares of the at most four materials around a place: those of the four nearest ids by their
// bilinear weights, faded by the hats' sides. Entries without a share have the weight 0.
const int SCREE_SHARES = 4;
struct ScreeBlend { int count; int slots[4]; float weights[4]; };

ScreeBlend scree_corners(vec2 ground) {
    vec2 place = ground / SCREE_CELL - 0.5;
    vec2 corner = floor(place);
    vec2 f = place - corner;
    ivec2 last = textureSize(scree_ids, 0) - 1;
    ScreeBlend corners;
    corners.count = SCREE_SHARES;
    for (int k = 0; k < SCREE_SHARES; ++k) {
        float wx = k % 2 == 0 ? 1.0 - f.x : f.x;
        float wy = k < 2 ? 1.0 - f.y : f.y;
        ivec2 cell = clamp(ivec2(corner) + ivec2(k % 2, k / 2), ivec2(0), last);
        corners.slots[k] = scree_slot(texelFetch(scree_ids, cell, 0).r);
        corners.weights[k] = wx * wy;
    }
    // Equal ones are one, at the first of their places.
    for (int k = 1; k < SCREE_SHARES; ++k)
        for (int first = 0; first < k; ++first)
            if (corners.slots[first] == corners.slots[k]) {
                corners.weights[first] += corners.weights[k];
                corners.weights[k] = 0.0;
            }
    return corners;
}
)";

// Every hat reaches to its neighbours: nothing fades faster than the weights do.
constexpr std::string_view kPlainBlend = R"(
ScreeBlend scree_blend(vec2 ground) { return scree_corners(ground); }
)";

constexpr std::string_view kFadedBlend = R"(
float scree_faded(ScreeBlend corners, int one) {
    float low = 0.0;
    float high = 0.0;
    for (int k = 0; k < SCREE_SHARES; ++k) {
        low += corners.slots[k] < corners.slots[one] ? corners.weights[k] : 0.0;
        high += corners.slots[k] > corners.slots[one] ? corners.weights[k] : 0.0;
    }
    float others = low + high;
    float reach = low * SCREE_LOW[corners.slots[one]] + high * SCREE_HIGH[corners.slots[one]];
    if (others <= 0.0)
        return 1.0;
    return reach <= 0.0 ? 0.0 : max(0.0, 1.0 - others * others / reach);
}

ScreeBlend scree_blend(vec2 ground) {
    ScreeBlend plain = scree_corners(ground);
    ScreeBlend blend = plain;
    float sum = 0.0;
    float most = plain.weights[0];
    int greatest = plain.slots[0];
    for (int k = 0; k < SCREE_SHARES; ++k) {
        blend.weights[k] = plain.weights[k] > 0.0 ? scree_faded(plain, k) : 0.0;
        sum += blend.weights[k];
        bool tie = plain.weights[k] == most && plain.weights[k] > 0.0 && plain.slots[k] < greatest;
        if (plain.weights[k] > most || tie) {
            most = plain.weights[k];
            greatest = plain.slots[k];
        }
    }
    for (int k = 0; k < SCREE_SHARES; ++k) {
        float one = plain.weights[k] > 0.0 && plain.slots[k] == greatest ? 1.0 : 0.0;
        blend.weights[k] = sum > 0.0 ? blend.weights[k] / sum : one;
    }
    return blend;
}
)";

constexpr std::string_view kLiteralBlend = R"(
// Shares of all materials by their hats over the filtered id, as published. Valid only between
// neighbours in the table.
const int SCREE_SHARES = SCREE_MATERIALS;
struct ScreeBlend { int count; int slots[SCREE_MATERIALS]; float weights[SCREE_MATERIALS]; };

float scree_hat(int m, float t) {
    float a = SCREE_START[m];
    float b = SCREE_PEAK[m];
    float c = SCREE_END[m];
    if (t == b || (SCREE_FIRST[m] > 0.0 && t <= b) || (SCREE_LAST[m] > 0.0 && t >= b))
        return 1.0;
    if (t < a || t > c)
        return 0.0;
    return t < b ? (t - a) / (b - a) : (c - t) / (c - b);
}

ScreeBlend scree_blend(vec2 ground) {
    ivec2 last = textureSize(scree_ids, 0) - 1;
    vec2 place = clamp(ground / SCREE_CELL - 0.5, vec2(0.0), vec2(last));
    ivec2 low = ivec2(place);
    ivec2 high = min(low + 1, last);
    vec2 f = place - vec2(low);
    float top = mix(float(texelFetch(scree_ids, low, 0).r),
                    float(texelFetch(scree_ids, ivec2(high.x, low.y), 0).r), f.x);
    float bottom = mix(float(texelFetch(scree_ids, ivec2(low.x, high.y), 0).r),
                       float(texelFetch(scree_ids, high, 0).r), f.x);
    float t = mix(top, bottom, f.y) / 255.0;
    ScreeBlend blend;
    blend.count = SCREE_MATERIALS;
    float sum = 0.0;
    int nearest = 0;
    for (int m = 0; m < SCREE_MATERIALS; ++m) {
        blend.slots[m] = m;
        blend.weights[m] = scree_hat(m, t);
        sum += blend.weights[m];
        if (abs(SCREE_PEAK[m] - t) < abs(SCREE_PEAK[nearest] - t))
            nearest = m;
    }
    for (int m = 0; m < SCREE_MATERIALS; ++m)
        blend.weights[m] = sum > 0.0 ? blend.weights[m] / sum : (m == nearest ? 1.0 : 0.0);
    return blend;
}
)";

// The blend by corners, with no more in it than the map needs: it runs for every sample.
std::string corner_blend_glsl(const std::vector<Material>& materials) {
    const FadeTable fades = fade_table(materials);
    const std::vector<int> slots(fades.slots.begin(),
                                 fades.slots.begin() + materials.back().id + 1);
    std::string text = "const int SCREE_LAST_ID = " + std::to_string(materials.back().id) + ";\n";
    if (slots.size() == materials.size()) {
        text += kIdentity;
    } else {
        text += glsl_constant("int", "SCREE_SLOT", slots,
                              [](int slot) { return std::to_string(slot < 0 ? 0 : slot); });
        text += kLookedUp;
    }
    text += kCorners;
    const auto whole = [](float share) { return share == 1.0F; };
    if (std::all_of(fades.low.begin(), fades.low.end(), whole) &&
        std::all_of(fades.high.begin(), fades.high.end(), whole))
        return text += kPlainBlend;
    const auto number = [](double value) { return glsl_number(value); };
    text += glsl_constant("float", "SCREE_LOW", fades.low, number);
    text += glsl_constant("float", "SCREE_HIGH", fades.high, number);
    return text += kFadedBlend;
}

}  // namespace

std::string glsl_number(double value) {
    std::string text;
    append_number(text, static_cast<float>(value));
    if (text.find_first_of(".e") == std::string::npos)
        text += ".0";
    return text;
}

std::string blend_glsl(const std::vector<Material>& materials, double cell_size, bool literal_hat) {
    const std::string common = common_tables(materials, cell_size);
    return common + (literal_hat ? hat_tables(materials) + std::string(kLiteralBlend)
                                 : corner_blend_glsl(materials));
}

}  // namespace scree::terrain
