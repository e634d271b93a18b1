#include "terrain/surface/wet_erosion.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "meshing/mesh/normals.h"
#include "tests/support/mesh_shapes.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

using meshing::Adjacency;
using meshing::TriMesh;
using meshing::UnsignedScale;
using terrain::WetErosionOptions;
using terrain::WetErosionReport;
using terrain::WetErosionScratch;

TriMesh bumpy_ball(int levels = 4) {
    TriMesh mesh = test::icosphere(levels);
    for (glm::vec3& p : mesh.positions)
        p *= 1.0F + 0.12F * std::sin(7.0F * p.x) * std::sin(8.0F * p.y) * std::sin(9.0F * p.z);
    return mesh;
}

// Particles near the surface, on one side of it.
std::vector<glm::vec3> splash(const TriMesh& mesh, std::uint64_t seed, std::size_t n) {
    Rng rng({seed, 9, 0, 0});
    std::vector<glm::vec3> places;
    while (places.size() < n) {
        const glm::vec3 p = mesh.positions[rng.below(mesh.positions.size())];
        if (p.x > 0.2F)
            places.push_back(p * static_cast<float>(rng.uniform(1.0, 1.03)));
    }
    return places;
}

class WetErosion : public testing::TestWithParam<unsigned> {};

TEST_P(WetErosion, DistanceFactorsEqualThoseOfLookingAtAllParticles) {
    const TriMesh mesh = bumpy_ball(3);
    const auto water = splash(mesh, GetParam(), 150);
    for (const double reach : {0.03, 0.2, 3.0}) {
        std::vector<float> factors;
        terrain::distance_factors(mesh.positions, water, reach, factors);
        const auto far = static_cast<float>(reach);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            float best = far * far;
            for (const glm::vec3& p : water) {
                const glm::vec3 d = p - mesh.positions[i];
                best = std::min(best, glm::dot(d, d));
            }
            ASSERT_EQ(factors[i], best < far * far ? (far - std::sqrt(best)) / far : 0.0F);
        }
    }
}

TEST_P(WetErosion, MovesWetVerticesAloneInwardsAndWithinItsLimit) {
    const TriMesh before = bumpy_ball();
    const Adjacency adjacency = meshing::build_adjacency(before);
    const auto normals = meshing::vertex_normals(before, adjacency);
    const auto water = splash(before, GetParam(), 200);
    for (const Reading concave : {Reading::Sound, Reading::Literal}) {
        TriMesh mesh = before;
        WetErosionOptions options;
        options.concave = concave;
        options.influence = 2.0;
        options.step_limit = 5.0;
        WetErosionScratch scratch;
        const WetErosionReport report =
            terrain::erode_wet(mesh, adjacency, water, options, scratch);
        std::size_t n_wet = 0;
        std::size_t outward = 0;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const float factor = scratch.factors[i];
            const glm::vec3 way = mesh.positions[i] - before.positions[i];
            n_wet += factor > 0.0F ? 1 : 0;
            if (factor == 0.0F) {
                ASSERT_EQ(way, glm::vec3(0.0F));
            }
            EXPECT_LE(glm::length(way), factor * report.mean_edge / 5.0 + 1e-6);
            outward += glm::dot(way, normals[i]) > 1e-6F ? 1 : 0;
        }
        EXPECT_EQ(report.n_affected, n_wet);
        EXPECT_GT(report.n_moved, 200U);
        EXPECT_LT(n_wet, mesh.positions.size() / 2);
        EXPECT_EQ(outward > 0, concave == Reading::Literal);
        EXPECT_LT(meshing::signed_volume(mesh), meshing::signed_volume(before));
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, WetErosion, testing::Range(0U, 3U));

TEST(WetErosion, OneParticleWearsAConeThatFallsOffLinearly) {
    TriMesh mesh = test::sheet(20, 0.1F);
    const TriMesh before = mesh;
    const Adjacency adjacency = meshing::build_adjacency(mesh);
    const glm::vec3 drop[] = {{1.0F, 0.0F, 1.0F}};
    WetErosionScratch scratch;
    const auto report = terrain::erode_wet(mesh, adjacency, drop, {.influence = 4.0}, scratch);
    // On flat ground all curvature is equal: speed 1/2, straight down.
    const double reach = 4.0 * report.mean_edge;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 way = mesh.positions[i] - before.positions[i];
        const double away = static_cast<double>(glm::distance(before.positions[i], drop[0]));
        const double expected = std::max(0.0, 1.0 - away / reach) * 0.5 * report.mean_edge / 10.0;
        EXPECT_NEAR(-way.y, expected, 1e-6);
        EXPECT_NEAR(glm::length(way), expected, 1e-6);
    }
}

TEST(WetErosion, SharpRidgesFollowTheUmbrellaAndFlatsTheNormal) {
    const TriMesh before = test::cube(8);
    const Adjacency adjacency = meshing::build_adjacency(before);
    TriMesh mesh = before;
    WetErosionScratch scratch;
    terrain::erode_wet(mesh, adjacency, mesh.positions, {}, scratch);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 way = mesh.positions[i] - before.positions[i];
        const glm::vec3 p = glm::abs(before.positions[i]);
        const int on_sides = (p.x > 0.49F) + (p.y > 0.49F) + (p.z > 0.49F);
        if (on_sides == 3) {
            EXPECT_LT(glm::dot(way, before.positions[i]), 0.0F);
            EXPECT_NEAR(glm::length(way), scratch.speeds[i] * 0.1F * 0.14F, 0.004F);
        } else if (on_sides == 1 && std::max({p.x + p.y, p.y + p.z, p.x + p.z}) < 0.8F) {
            // Without hollows the range is symmetric: flats go at half speed.
            EXPECT_NEAR(scratch.speeds[i], 0.5F, 1e-4F);
            EXPECT_GT(-glm::dot(glm::normalize(way), scratch.normals[i]), 0.999F);
        }
    }
    TriMesh literal = before;
    terrain::erode_wet(literal, adjacency, before.positions, {.range = UnsignedScale::MinMax},
                       scratch);
    std::size_t still = 0;
    for (std::size_t i = 0; i < literal.positions.size(); ++i)
        still += glm::distance(literal.positions[i], before.positions[i]) < 1e-6F ? 1 : 0;
    EXPECT_GT(still, 100U);  // as printed, the flats of a convex body stand still
}

TEST(WetErosion, APowerSlowsWhatIsFlat) {
    const TriMesh before = bumpy_ball();
    const Adjacency adjacency = meshing::build_adjacency(before);
    double last = 0.0;
    for (const double power : {4.0, 2.0, 1.0}) {
        TriMesh mesh = before;
        WetErosionScratch scratch;
        terrain::erode_wet(mesh, adjacency, before.positions, {.power = power}, scratch);
        const double lost = meshing::signed_volume(before) - meshing::signed_volume(mesh);
        EXPECT_GT(lost, last);
        last = lost;
    }
}

TEST(WetErosion, RimsObeyTheirPolicy) {
    const TriMesh before = test::sheet(6, 0.1F);
    const Adjacency adjacency = meshing::build_adjacency(before);
    for (const auto policy : {meshing::RimPolicy::Pinned, meshing::RimPolicy::NormalOnly}) {
        TriMesh mesh = before;
        WetErosionScratch scratch;
        terrain::erode_wet(mesh, adjacency, before.positions, {.rim = policy}, scratch);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::vec3 way = mesh.positions[i] - before.positions[i];
            EXPECT_EQ(way.x, 0.0F);
            EXPECT_EQ(way.y < 0.0F, adjacency.rim[i] == 0 || policy != meshing::RimPolicy::Pinned);
        }
    }
}

TEST(WetErosion, SameBytesForAnyThreads) {
    const auto run = [](int threads) {
        const ThreadLimit limit(threads);
        TriMesh mesh = bumpy_ball();
        const Adjacency adjacency = meshing::build_adjacency(mesh);
        const auto water = splash(mesh, 5, 300);
        WetErosionScratch scratch;
        for (int i = 0; i < 5; ++i)
            terrain::erode_wet(mesh, adjacency, water, {.influence = 2.0}, scratch);
        return mesh.positions;
    };
    EXPECT_TRUE(run(1) == run(3));
}

TEST(WetErosion, TakesNoWaterAndRefusesBadOptions) {
    TriMesh mesh = test::icosphere(1);
    const TriMesh before = mesh;
    const Adjacency adjacency = meshing::build_adjacency(mesh);
    WetErosionScratch scratch;
    EXPECT_EQ(terrain::erode_wet(mesh, adjacency, {}, {}, scratch).n_affected, 0U);
    EXPECT_EQ(mesh.positions, before.positions);
    EXPECT_THAT([&] { terrain::erode_wet(mesh, adjacency, {}, {.power = 0.5}, scratch); },
                testing::ThrowsMessage<InvalidOption>("power is 0.5, must be in [1, 100]"));
    EXPECT_THROW(terrain::erode_wet(mesh, adjacency, {}, {.step_limit = 0.0}, scratch),
                 InvalidOption);
}

}  // namespace
}  // namespace scree
