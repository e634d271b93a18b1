#include "terrain/view/tessellation.h"

#include "terrain/gpu/gl_objects.h"
#include "terrain/gpu/shader_program.h"
#include "terrain/view/lattice.h"
#include "tests/terrain/gpu/gl_fixture.h"

#include <algorithm>
#include <cmath>
#include <epoxy/gl.h>
#include <map>
#include <numbers>
#include <vector>

#include <glm/vec4.hpp>

namespace scree::terrain {
namespace {

std::array<glm::vec3, 6> points_of(const Lattice& lattice, const LatticePatch& patch) {
    std::array<glm::vec3, 6> points;
    for (std::size_t i = 0; i < 6; ++i) {
        const glm::vec2 at = lattice.positions[patch[i]];
        points[i] = {at.x, 0.05F * std::sin(3.0F * at.x) * std::cos(2.0F * at.y), at.y};
    }
    return points;
}

TEST(Tessellation, WeightIsTheGaussian) {
    for (float d = 0.0F; d < 6.0F; d += 0.01F) {
        const glm::vec3 at(d, 0.0F, 0.0F);
        const float got = tessellation_weight(at, at, at, {{0, 0, 0}, 0.7F, 8.0F});
        const double t = std::pow(double{d} / 0.7, 2.0);
        EXPECT_NEAR(got, std::exp(-t), 4e-7 * (1.0 + t) * std::exp(-t) + 1e-30);
    }
}

TEST(Tessellation, SharedEdgesAgreeBitForBitAndStayInRange) {
    const Lattice lattice = make_lattice({0.0, 0.0, 5.0, 3.3}, 23);
    constexpr int kEnds[3][2] = {{1, 2}, {0, 2}, {0, 1}};
    for (const float amount : {0.0F, 3.0F, 8.0F, 64.0F, 1000.0F}) {
        const TessellationRule rule{{2.1F, 0.3F, 1.7F}, 0.9F, amount};
        std::map<std::pair<std::uint32_t, std::uint32_t>, float> seen;
        std::size_t n_shared = 0;
        for (const LatticePatch& patch : lattice.patches) {
            const PatchFactors factors = patch_factors(points_of(lattice, patch), rule);
            EXPECT_GE(factors.inside, 1.0F);
            EXPECT_LE(factors.inside, 64.0F);
            for (std::size_t e = 0; e < 3; ++e) {
                EXPECT_GE(factors.edge[e], 1.0F);
                EXPECT_LE(factors.edge[e], factors.inside);
                const auto key = std::minmax(patch[static_cast<std::size_t>(kEnds[e][0])],
                                             patch[static_cast<std::size_t>(kEnds[e][1])]);
                const auto [found, is_new] = seen.emplace(key, factors.edge[e]);
                n_shared += is_new ? 0 : 1;
                EXPECT_EQ(found->second, factors.edge[e]);
            }
        }
        EXPECT_GT(n_shared, 1000U);
    }
}

TEST(Tessellation, RimPatchesTakeTheirOwnWeight) {
    const std::array<glm::vec3, 6> points{glm::vec3(0, 0, 0), {0, 0, 1}, {1, 0, 0},
                                          {0, 0, 0},          {1, 0, 0}, {0, 0, 1}};
    const PatchFactors factors = patch_factors(points, {{2, 0, 1}, 2.0F, 16.0F});
    for (const float edge : factors.edge)
        EXPECT_EQ(edge, factors.inside);
}

// The distance from the reference at which the inside factor falls to half, by direction.
TEST(Tessellation, ContoursOfTheFactorsAreCircles) {
    const Lattice lattice = make_lattice({0.0, 0.0, 10.0, 10.0}, 120);
    const glm::vec3 centre(5.03F, 0.0F, 4.97F);
    const TessellationRule rule{centre, 2.0F, 32.0F};
    constexpr std::size_t kSectors = 36;
    std::vector<double> inner(kSectors, 0.0);    // farthest finer than the level
    std::vector<double> outer(kSectors, 100.0);  // nearest coarser than it
    for (const LatticePatch& patch : lattice.patches) {
        std::array<glm::vec3, 6> points;
        for (std::size_t i = 0; i < 6; ++i)
            points[i] = {lattice.positions[patch[i]].x, 0.0F, lattice.positions[patch[i]].y};
        const glm::vec3 mean = (points[0] + points[1] + points[2]) / 3.0F - centre;
        const double angle = std::atan2(mean.z, mean.x) + std::numbers::pi;
        const auto sector =
            std::min(kSectors - 1, static_cast<std::size_t>(angle / (2.0 * std::numbers::pi) *
                                                            static_cast<double>(kSectors)));
        const double distance = std::hypot(mean.x, mean.z);
        const PatchFactors factors = patch_factors(points, rule);
        if (*std::min_element(factors.edge.begin(), factors.edge.end()) > 17.0F)
            inner[sector] = std::max(inner[sector], distance);
        else
            outer[sector] = std::min(outer[sector], distance);
    }
    double least = 100.0;
    double most = 0.0;
    for (std::size_t i = 0; i < kSectors; ++i) {
        const double radius = (inner[i] + outer[i]) / 2.0;
        least = std::min(least, radius);
        most = std::max(most, radius);
    }
    EXPECT_NEAR(least, 2.0 * std::sqrt(std::log(2.0)), 0.1);
    EXPECT_LT(most / least, 1.05);
}

class TessellationShader : public test::GlTest {};

TEST_F(TessellationShader, GivesTheFactorsOfTheFunction) {
    const Lattice lattice = make_lattice({0.0, 0.0, 5.0, 3.3}, 23);
    const TessellationRule rule{{2.1F, 0.3F, 1.7F}, 0.9F, 37.0F};
    std::vector<glm::vec4> points;
    for (const LatticePatch& patch : lattice.patches)
        for (const glm::vec3& point : points_of(lattice, patch))
            points.emplace_back(point, 0.0F);
    const std::string text = "#version 450 core\n" + std::string(tessellation_glsl()) + R"(
        layout(local_size_x = 64) in;
        layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
        layout(std430, binding = 1) writeonly buffer Factors { vec4 factors[]; };
        uniform vec3 reference;
        uniform float per_radius2;
        uniform float amount;
        void main() {
            uint i = gl_GlobalInvocationID.x;
            if (i >= uint(factors.length()))
                return;
            vec3 p[6];
            for (uint k = 0u; k < 6u; ++k)
                p[k] = points[6u * i + k].xyz;
            factors[i] = patch_factors(p, reference, per_radius2, amount);
        })";
    const ShaderProgram program("factors", {{ShaderStage::Compute, text}});
    GlBuffer in(0), out(0);
    std::vector<glm::vec4> got(lattice.patches.size());
    const auto n_out = static_cast<GLsizeiptr>(got.size() * sizeof(glm::vec4));
    glNamedBufferStorage(in.id(), static_cast<GLsizeiptr>(points.size() * sizeof(glm::vec4)),
                         points.data(), 0);
    glNamedBufferStorage(out.id(), n_out, nullptr, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out.id());
    program.set("reference", rule.reference);
    program.set("per_radius2", per_radius2(rule));
    program.set("amount", rule.amount);
    program.use();
    glDispatchCompute(static_cast<GLuint>((got.size() + 63) / 64), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(out.id(), 0, n_out, got.data());
    check_gl("the test");
    for (std::size_t i = 0; i < got.size(); ++i) {
        const PatchFactors wanted = patch_factors(points_of(lattice, lattice.patches[i]), rule);
        for (int e = 0; e < 3; ++e)
            EXPECT_EQ(got[i][e], wanted.edge[static_cast<std::size_t>(e)]);
        EXPECT_EQ(got[i].w, wanted.inside);
    }
}

}  // namespace
}  // namespace scree::terrain
