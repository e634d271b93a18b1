#include "terrain/material/shader_templates.h"

#include "base/error.h"
#include "terrain/material/blend_glsl.h"
#include "terrain/material/map_check.h"

#include <cmath>
#include <string>

namespace scree::terrain {
namespace {

float linear_from_srgb(std::uint8_t code) {
    const float v = static_cast<float>(code) / 255.0F;
    return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

std::string plain_colour(const Material& material) {
    const glm::u8vec3 colour = material_colour(material);
    return "vec3(" + glsl_number(linear_from_srgb(colour.x)) + ", " +
           glsl_number(linear_from_srgb(colour.y)) + ", " +
           glsl_number(linear_from_srgb(colour.z)) + ")";
}

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

// Textures apart: an array of samplers may be indexed by constants alone.
std::string separate_reader(const Kind& kind, const std::vector<int>& users,
                            const std::vector<Material>& materials) {
    std::string text;
    const auto add = [&text](auto... parts) { ((text += parts), ...); };
    if (!users.empty())
        add("uniform sampler2D scree_", kind.sampler, "[", std::to_string(users.size()), "];\n");
    add(kind.result, " scree_", kind.sampler, "_of(int slot, vec2 ground", kind.parameters,
        ") {\n    switch (slot) {\n");
    for (std::size_t i = 0; i < users.size(); ++i) {
        const auto slot = static_cast<std::size_t>(users[i]);
        const std::string size = glsl_number(materials[slot].textures.size_m);
        add("        case ", std::to_string(users[i]), ":\n            return ", kind.look_up,
            "(scree_", kind.sampler, "[", std::to_string(i), "], ground / ", size,
            with_size(kind.arguments, size), ").", kind.swizzle, ";\n");
    }
    add("        default:\n            return ", kind.otherwise, ";\n    }\n}\n");
    return text;
}

// Textures as layers: one look-up, whichever material it is.
std::string layered_reader(const Kind& kind, const std::vector<int>& users,
                           const std::vector<Material>& materials) {
    std::string text;
    const auto add = [&text](auto... parts) { ((text += parts), ...); };
    const auto head = [&] {
        add(kind.result, " scree_", kind.sampler, "_of(int slot, vec2 ground", kind.parameters,
            ") {\n");
    };
    if (users.empty()) {
        head();
        add("    return ", kind.otherwise, ";\n}\n");
        return text;
    }
    add("uniform sampler2DArray scree_", kind.sampler, ";\n");
    std::string layer = "slot";
    if (users.size() < materials.size()) {
        std::vector<int> layers(materials.size(), -1);
        for (std::size_t i = 0; i < users.size(); ++i)
            layers[static_cast<std::size_t>(users[i])] = static_cast<int>(i);
        const std::string table = std::string("SCREE_LAYER_OF_") + std::string(kind.sampler);
        add(glsl_constant("int", table, layers, [](int one) { return std::to_string(one); }));
        layer = table + "[slot]";
    }
    head();
    if (users.size() < materials.size())
        add("    if (", layer, " < 0)\n        return ", kind.otherwise, ";\n");
    add("    float size = SCREE_SIZE[slot];\n    return ", kind.look_up, "(scree_", kind.sampler,
        ", vec3(ground / size, float(", layer, "))", with_size(kind.arguments, "size"), ").",
        kind.swizzle, ";\n}\n");
    return text;
}

std::string reader(const Kind& kind, const std::vector<int>& users,
                   const std::vector<Material>& materials, TextureBinding binding) {
    return binding == TextureBinding::Layers ? layered_reader(kind, users, materials)
                                             : separate_reader(kind, users, materials);
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

    const std::string common = blend_glsl(materials, cell_size, options.literal_hat);
    std::string& fragment = shaders.fragment_functions;
    fragment = common + "\n" + glsl_constant("vec3", "SCREE_COLOUR", materials, plain_colour);
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
