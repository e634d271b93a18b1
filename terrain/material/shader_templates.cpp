#include "terrain/material/shader_templates.h"

#include "base/error.h"
#include "base/number_text.h"
#include "terrain/material/corner_blend.h"
#include "terrain/material/hat_blend.h"
#include "terrain/material/map_check.h"

#include <cmath>
#include <string>

namespace scree::terrain {
namespace {

// A GLSL literal: a float needs a point or an exponent.
std::string literal(double value) {
    std::string text;
    append_number(text, static_cast<float>(value));
    if (text.find_first_of(".e") == std::string::npos)
        text += ".0";
    return text;
}

template <class Values, class Text>
std::string constant(std::string_view type, std::string_view name, const Values& values,
                     Text&& text_of) {
    std::string list;
    for (const auto& value : values) {
        if (!list.empty())
            list += ", ";
        list += text_of(value);
    }
    const std::string array = std::string(type) + "[" + std::to_string(values.size()) + "]";
    std::string text = "const ";
    text.append(array).append(" ").append(name).append(" = ").append(array);
    return text.append("(").append(list).append(");\n");
}

float linear_from_srgb(std::uint8_t code) {
    const float v = static_cast<float>(code) / 255.0F;
    return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

std::string plain_colour(const Material& material) {
    const glm::u8vec3 colour = material_colour(material);
    return "vec3(" + literal(linear_from_srgb(colour.x)) + ", " +
           literal(linear_from_srgb(colour.y)) + ", " + literal(linear_from_srgb(colour.z)) + ")";
}

// Everything that the blends of both stages read.
std::string tables(const std::vector<Material>& materials, double cell_size, bool literal_hat) {
    const auto number = [](double value) { return literal(value); };
    std::string text = "uniform usampler2D scree_ids;\n";
    text += "const float SCREE_CELL = " + literal(cell_size) + ";\n";
    text += "const int SCREE_MATERIALS = " + std::to_string(materials.size()) + ";\n";
    if (literal_hat) {
        std::vector<double> a, b, c, first, last;
        for (const HatBreaks& hat : hat_breaks(materials)) {
            a.push_back(hat.a);
            b.push_back(hat.b);
            c.push_back(hat.c);
            first.push_back(hat.first ? 1.0 : 0.0);
            last.push_back(hat.last ? 1.0 : 0.0);
        }
        text += constant("float", "SCREE_START", a, number);
        text += constant("float", "SCREE_PEAK", b, number);
        text += constant("float", "SCREE_END", c, number);
        text += constant("float", "SCREE_FIRST", first, number);
        return text + constant("float", "SCREE_LAST", last, number);
    }
    const FadeTable fades = fade_table(materials);
    const std::vector<int> slots(fades.slots.begin(),
                                 fades.slots.begin() + materials.back().id + 1);
    text += "const int SCREE_LAST_ID = " + std::to_string(materials.back().id) + ";\n";
    text += constant("int", "SCREE_SLOT", slots,
                     [](int slot) { return std::to_string(slot < 0 ? 0 : slot); });
    text += constant("float", "SCREE_LOW", fades.low, number);
    return text + constant("float", "SCREE_HIGH", fades.high, number);
}

constexpr std::string_view kCornerBlend = R"(
// Shares of the at most four materials around a place: those of the four nearest ids by their
// bilinear weights, faded by the hats' sides.
const int SCREE_SHARES = 4;
struct ScreeBlend { int count; int slots[4]; float weights[4]; };

float scree_faded(ScreeBlend corners, int one) {
    float low = 0.0;
    float high = 0.0;
    for (int k = 0; k < corners.count; ++k) {
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
    vec2 place = ground / SCREE_CELL - 0.5;
    vec2 corner = floor(place);
    vec2 f = place - corner;
    ivec2 last = textureSize(scree_ids, 0) - 1;
    ScreeBlend plain = ScreeBlend(0, int[4](0, 0, 0, 0), float[4](0.0, 0.0, 0.0, 0.0));
    for (int k = 0; k < 4; ++k) {
        float wx = k % 2 == 0 ? 1.0 - f.x : f.x;
        float wy = k < 2 ? 1.0 - f.y : f.y;
        ivec2 cell = clamp(ivec2(corner) + ivec2(k % 2, k / 2), ivec2(0), last);
        int slot = SCREE_SLOT[min(int(texelFetch(scree_ids, cell, 0).r), SCREE_LAST_ID)];
        int at = 0;
        while (at < plain.count && plain.slots[at] != slot)
            ++at;
        plain.slots[at] = slot;
        plain.count = max(plain.count, at + 1);
        plain.weights[at] += wx * wy;
    }
    ScreeBlend blend = plain;
    float sum = 0.0;
    int greatest = 0;
    for (int k = 0; k < plain.count; ++k) {
        blend.weights[k] = scree_faded(plain, k);
        sum += blend.weights[k];
        bool tie = plain.weights[k] == plain.weights[greatest] && plain.slots[k] < plain.slots[greatest];
        if (plain.weights[k] > plain.weights[greatest] || tie)
            greatest = k;
    }
    for (int k = 0; k < plain.count; ++k)
        blend.weights[k] = sum > 0.0 ? blend.weights[k] / sum : (k == greatest ? 1.0 : 0.0);
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

// One kind of texture: its sampler and the function that reads it for a material.
struct Kind {
    std::string_view sampler;
    std::string_view result;      // type of the function
    std::string_view parameters;  // behind slot and ground
    std::string_view look_up;     // textureGrad or textureLod
    std::string_view arguments;   // behind the coordinates; $ stands for the size
    std::string_view swizzle;
    std::string_view otherwise;
};

std::string with_size(std::string_view text, const std::string& size) {
    std::string result;
    for (const char c : text)
        result += c == '$' ? size : std::string(1, c);
    return result;
}

std::string reader(const Kind& kind, const std::vector<int>& users,
                   const std::vector<Material>& materials, TextureBinding binding) {
    const bool layers = binding == TextureBinding::Layers;
    std::string text;
    const auto add = [&text](auto... parts) { ((text += parts), ...); };
    if (!users.empty()) {
        add("uniform ", layers ? "sampler2DArray" : "sampler2D", " scree_", kind.sampler);
        if (!layers)
            add("[", std::to_string(users.size()), "]");
        add(";\n");
    }
    add(kind.result, " scree_", kind.sampler, "_of(int slot, vec2 ground", kind.parameters,
        ") {\n    switch (slot) {\n");
    for (std::size_t i = 0; i < users.size(); ++i) {
        const auto slot = static_cast<std::size_t>(users[i]);
        const std::string size = literal(materials[slot].textures.size_m);
        const std::string index = std::to_string(i);
        add("        case ", std::to_string(users[i]), ":\n            return ", kind.look_up,
            "(scree_", kind.sampler);
        if (layers)
            add(", vec3(ground / ", size, ", ", index, ".0)");
        else
            add("[", index, "], ground / ", size);
        add(with_size(kind.arguments, size), ").", kind.swizzle, ";\n");
    }
    add("        default:\n            return ", kind.otherwise, ";\n    }\n}\n");
    return text;
}

constexpr Kind kAlbedo{"albedo",           "vec3", ", vec2 dx, vec2 dy", "textureGrad",
                       ", dx / $, dy / $", "rgb",  "SCREE_COLOUR[slot]"};
constexpr Kind kNormal{"normal",           "vec3", ", vec2 dx, vec2 dy", "textureGrad",
                       ", dx / $, dy / $", "rgb",  "vec3(0.5, 0.5, 1.0)"};
constexpr Kind kDisplacement{"displacement", "float", ", float lod", "textureLod",
                             ", lod",        "r",     "0.0"};

// The derivatives are taken before the loop: within it they would be undefined.
constexpr std::string_view kFragmentBlend = R"(
vec3 scree_ground_colour(vec2 ground) {
    vec2 dx = dFdx(ground);
    vec2 dy = dFdy(ground);
    ScreeBlend blend = scree_blend(ground);
    vec3 colour = vec3(0.0);
    for (int k = 0; k < SCREE_SHARES; ++k)
        if (k < blend.count && blend.weights[k] > 0.0)
            colour += blend.weights[k] * scree_albedo_of(blend.slots[k], ground, dx, dy);
    return colour;
}

vec3 scree_ground_normal(vec2 ground) {
    vec2 dx = dFdx(ground);
    vec2 dy = dFdy(ground);
    ScreeBlend blend = scree_blend(ground);
    vec3 normal = vec3(0.0);
    for (int k = 0; k < SCREE_SHARES; ++k)
        if (k < blend.count && blend.weights[k] > 0.0)
            normal += blend.weights[k] * (scree_normal_of(blend.slots[k], ground, dx, dy) * 2.0 - 1.0);
    return normalize(normal);
}
)";

constexpr std::string_view kEvaluationBlend = R"(
float scree_ground_displacement(vec2 ground, float lod) {
    ScreeBlend blend = scree_blend(ground);
    float height = 0.0;
    for (int k = 0; k < SCREE_SHARES; ++k)
        if (k < blend.count && blend.weights[k] > 0.0)
            height += blend.weights[k] * scree_displacement_of(blend.slots[k], ground, lod);
    return height;
}
)";

constexpr std::string_view kFragmentMain = R"(
uniform vec3 scree_to_light;
layout(location = 0) in vec2 ground;
layout(location = 0) out vec4 colour;

void main() {
    vec3 n = scree_ground_normal(ground);
    float lit = max(0.0, dot(vec3(n.x, n.z, -n.y), normalize(scree_to_light)));
    colour = vec4(scree_ground_colour(ground) * (0.2 + 0.8 * lit), 1.0);
}
)";

constexpr std::string_view kEvaluationMain = R"(
layout(triangles, fractional_odd_spacing, ccw) in;
uniform mat4 scree_clip_from_world;
uniform float scree_displacement_lod;
layout(location = 0) in vec3 corner[];
layout(location = 0) out vec2 ground;

void main() {
    vec3 p = gl_TessCoord.x * corner[0] + gl_TessCoord.y * corner[1] + gl_TessCoord.z * corner[2];
    ground = p.xz;
    p.y += scree_ground_displacement(ground, scree_displacement_lod);
    gl_Position = scree_clip_from_world * vec4(p, 1.0);
}
)";

template <class Path>
std::vector<int> users_of(const std::vector<Material>& materials, Path path,
                          const ShaderOptions& options, std::string_view kind) {
    std::vector<int> users;
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (!(materials[i].textures.*path).empty())
            users.push_back(static_cast<int>(i));
    if (options.binding == TextureBinding::Separate &&
        users.size() > static_cast<std::size_t>(options.max_textures))
        fail<InvalidInput>("the map has ", users.size(), " ", kind, " textures, at most ",
                           options.max_textures, " may be bound apart; use layers");
    return users;
}

}  // namespace

GroundShaders ground_shaders(const std::vector<Material>& materials, double cell_size,
                             const ShaderOptions& options) {
    check(options);
    check_materials(materials, "the map");
    if (!(cell_size > 0.0 && cell_size <= 1e6))
        fail<InvalidInput>("the map's cell size is ", cell_size, " m, must be in (0, 1e6]");
    GroundShaders shaders;
    shaders.albedo = users_of(materials, &MaterialTextures::albedo, options, "albedo");
    shaders.normal = users_of(materials, &MaterialTextures::normal, options, "normal");
    shaders.displacement =
        users_of(materials, &MaterialTextures::displacement, options, "displacement");

    std::string common = "// Made from a description map.\n";
    common += tables(materials, cell_size, options.literal_hat);
    common += options.literal_hat ? kLiteralBlend : kCornerBlend;
    std::string& fragment = shaders.fragment_functions;
    fragment = common + "\n" + constant("vec3", "SCREE_COLOUR", materials, plain_colour);
    fragment += reader(kAlbedo, shaders.albedo, materials, options.binding);
    fragment += reader(kNormal, shaders.normal, materials, options.binding);
    fragment += kFragmentBlend;
    std::string& evaluation = shaders.evaluation_functions;
    evaluation =
        common + "\n" + reader(kDisplacement, shaders.displacement, materials, options.binding);
    evaluation += kEvaluationBlend;
    shaders.fragment = "#version 450 core\n" + fragment + std::string(kFragmentMain);
    shaders.evaluation = "#version 450 core\n" + evaluation + std::string(kEvaluationMain);
    return shaders;
}

}  // namespace scree::terrain
