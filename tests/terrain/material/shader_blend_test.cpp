#include "base/random.h"
#include "terrain/gpu/gl_objects.h"
#include "terrain/gpu/shader_program.h"
#include "terrain/material/corner_blend.h"
#include "terrain/material/hat_blend.h"
#include "terrain/material/shader_templates.h"
#include "tests/terrain/gpu/gl_fixture.h"
#include "tests/terrain/material/map_samples.h"

#include <epoxy/gl.h>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

constexpr std::size_t kPoints = 4096;

// The blend of every point, a share for each of three materials.
constexpr const char* kMain = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer In { vec2 points[]; };
layout(std430, binding = 1) writeonly buffer Out { float shares[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    ScreeBlend blend = scree_blend(points[i]);
    float share[3] = float[3](0.0, 0.0, 0.0);
    for (int k = 0; k < blend.count; ++k)
        share[blend.slots[k]] += blend.weights[k];
    for (uint m = 0; m < 3; ++m)
        shares[3 * i + m] = share[m];
}
)";

GlTexture id_texture(const Raster<std::uint8_t>& ids) {
    GlTexture texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.id(), 1, GL_R8UI, ids.width(), ids.height());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture.id(), 0, 0, 0, ids.width(), ids.height(), GL_RED_INTEGER,
                        GL_UNSIGNED_BYTE, ids.data());
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

std::vector<glm::vec2> random_points(const DescriptionMap& map, std::uint64_t seed) {
    Rng rng({.seed = seed, .stream = 7});
    std::vector<glm::vec2> points;
    for (std::size_t i = 0; i < kPoints; ++i)
        points.emplace_back(rng.uniform(-1.0, 1.0 + map.ids.width()) * map.cell_size,
                            rng.uniform(-1.0, 1.0 + map.ids.height()) * map.cell_size);
    return points;
}

std::vector<float> blend_on_device(const DescriptionMap& map, const std::vector<glm::vec2>& points,
                                   bool literal) {
    const GroundShaders shaders =
        ground_shaders(map.materials, map.cell_size, {.literal_hat = literal});
    const ShaderProgram program(
        "the blend",
        {{ShaderStage::Compute, "#version 450 core\n" + shaders.evaluation_functions + kMain}});
    const GlTexture ids = id_texture(map.ids);
    const GlBuffer in(0), out(0);
    glNamedBufferStorage(in.id(), static_cast<GLsizeiptr>(points.size() * sizeof(glm::vec2)),
                         points.data(), 0);
    std::vector<float> shares(3 * points.size());
    const auto bytes = static_cast<GLsizeiptr>(shares.size() * sizeof(float));
    glNamedBufferStorage(out.id(), bytes, nullptr, 0);
    program.use();
    program.set("scree_ids", 0);
    glBindTextureUnit(0, ids.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out.id());
    glDispatchCompute(static_cast<GLuint>(points.size() / 64), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(out.id(), 0, bytes, shares.data());
    check_gl("the blend");
    return shares;
}

class ShaderBlend : public test::GlTest {};

TEST_F(ShaderBlend, CornersAreTheProcessors) {
    for (const bool own_hats : {false, true}) {
        DescriptionMap map = scree::test::random_map(9, 7, 3, false);
        if (own_hats) {
            map.materials[0].hat = {0.0, 0.0, 1.0 / 255.0};
            map.materials[1].hat = {1.0 / 255.0, 3.0 / 255.0, 4.0 / 255.0};
        }
        const auto points = random_points(map, 5);
        const FadeTable fades = fade_table(map.materials);
        const std::vector<float> shares = blend_on_device(map, points, false);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto cell = static_cast<float>(map.cell_size);
            const CornerWeights corners =
                corner_weights(map.ids, fades, points[i].x / cell, points[i].y / cell);
            float expected[3] = {};
            for (std::size_t k = 0; k < static_cast<std::size_t>(corners.count); ++k)
                expected[corners.slots[k]] += corners.weights[k];
            for (std::size_t m = 0; m < 3; ++m)
                EXPECT_NEAR(shares[3 * i + m], expected[m], 1e-4) << i;
        }
    }
}

TEST_F(ShaderBlend, LiteralHatsAreTheProcessors) {
    const DescriptionMap map = scree::test::random_map(9, 7, 4, false);
    const auto points = random_points(map, 6);
    const std::vector<HatBreaks> hats = hat_breaks(map.materials);
    const std::vector<float> shares = blend_on_device(map, points, true);
    std::vector<double> expected(3);
    for (std::size_t i = 0; i < points.size(); ++i) {
        hat_weights(hats,
                    filtered_id(map.ids, points[i].x / map.cell_size, points[i].y / map.cell_size),
                    expected);
        for (std::size_t m = 0; m < 3; ++m)
            EXPECT_NEAR(shares[3 * i + m], expected[m], 1e-4) << i;
    }
}

TEST_F(ShaderBlend, WholeShadersLink) {
    auto materials = scree::test::three_materials();
    materials[0].textures.albedo = "a.png";
    materials[2].textures = {"a.png", "d.exr", "n.png", 0.5, 0.02};
    const std::string vertex =
        "#version 450 core\nlayout(location = 0) out vec3 corner;\n"
        "void main() { corner = vec3(gl_VertexID); gl_Position = vec4(0.0); }\n";
    for (const bool literal : {false, true})
        for (const auto binding : {TextureBinding::Separate, TextureBinding::Layers}) {
            const GroundShaders shaders =
                ground_shaders(materials, 0.25, {.binding = binding, .literal_hat = literal});
            EXPECT_NO_THROW(
                ShaderProgram("the ground", {{ShaderStage::Vertex, vertex},
                                             {ShaderStage::TessEvaluation, shaders.evaluation},
                                             {ShaderStage::Fragment, shaders.fragment}}));
        }
}

}  // namespace
}  // namespace scree::terrain
