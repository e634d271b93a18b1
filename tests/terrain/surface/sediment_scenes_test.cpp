#include "terrain/fluid/position_fluid.h"
#include "terrain/prepare/ground_lattice.h"
#include "terrain/surface/erosion_loop.h"
#include "tests/terrain/fluid/fluid_samples.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

using meshing::TriMesh;
using terrain::ErosionRun;
using terrain::SedimentOptions;

// The two scenes that the older scheme was shown on (`mesh-erosion.md` 8.7).
ErosionRun run_water(const TriMesh& mesh, const terrain::PositionFluidSetup& water,
                     const terrain::ErosionLoopOptions& times, const SedimentOptions& sediment) {
    ErosionRun run;
    run.mesh = mesh;
    terrain::PositionFluid fluid(water);
    terrain::ErosionLoopOptions loop = times;
    loop.scheme = terrain::ErosionScheme::Sediment;
    loop.check_every = 0;
    terrain::run_erosion(run, fluid, loop, {}, sediment);
    return run;
}

// A basin whose wall has a gap, and a slope below it.
double lake_height(double x, double z) {
    const double d = std::max(std::abs(x - 0.65), std::abs(z));
    if (d < 0.32)
        return -0.25;
    const double wall = x > 0.9 && std::abs(z) < 0.15 ? 0.0 : 0.25;
    return wall - 0.6 * std::max(0.0, x - 1.2);
}

TEST(SedimentScenes, ALakeThatSpillsWearsTheSlopeBelow) {
    auto ground = terrain::lattice_over({0, -0.6}, {2.6, 0.6}, 1800);
    for (int j = 0; j < ground.heights.height(); ++j)
        for (int i = 0; i < ground.heights.width(); ++i) {
            const glm::dvec2 p = ground.place(i, j);
            ground.heights(i, j) = static_cast<float>(lake_height(p.x, p.y));
        }
    const TriMesh before = terrain::lattice_mesh(ground);
    terrain::PositionFluidSetup water;
    water.options.radius = 0.035;
    water.domain = {{0.02F, -1.5F, -0.58F}, {2.55F, 1, 0.58F}};
    water.emitters.pools.push_back({{0.38F, -0.22F, -0.27F}, {0.92F, 0.0F, 0.27F}});
    water.emitters.sources.push_back(
        {.centre = {0.55F, 0.4F, 0}, .velocity = {0, -1.5F, 0}, .radius = 0.12});
    const ErosionRun run =
        run_water(before, water, {.steps = 70, .warm_up = 20}, {.rate = 2e-3, .critical = 4.0});
    double worn[2] = {};  // in the lake and below the spill
    int n[2] = {};
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        const glm::vec3 p = before.positions[i];
        const bool lake = std::max(std::abs(p.x - 0.65F), std::abs(p.z)) < 0.3F;
        const bool below = p.x > 1.25F && p.x < 2.3F && std::abs(p.z) < 0.14F;
        if (!lake && !below)
            continue;
        worn[below ? 1 : 0] += static_cast<double>(p.y - run.mesh.positions[i].y);
        ++n[below ? 1 : 0];
    }
    ASSERT_GT(std::min(n[0], n[1]), 30);
    EXPECT_GT(worn[1] / n[1], 5.0 * std::abs(worn[0] / n[0]));
    EXPECT_GT(worn[1] / n[1], 1e-3);
}

TEST(SedimentScenes, ATubeIsWornMostWhereTheJetStrikesFirst) {
    // A closed duct that water falls into at one end and leaves at the other.
    TriMesh before = test::block({0, 0, 0}, 1.0F, 14);
    for (glm::vec3& p : before.positions)
        p = {2.0F * (p.x + 0.5F), 0.6F * (p.y + 0.5F), 0.4F * p.z};
    for (glm::uvec3& t : before.triangles)
        std::swap(t.y, t.z);  // it faces inwards
    terrain::PositionFluidSetup water;
    water.options.radius = 0.03;
    water.domain = {{-0.1F, -0.1F, -0.3F}, {2.1F, 0.7F, 0.3F}};
    water.emitters.sources.push_back(
        {.centre = {0.35F, 0.5F, 0}, .velocity = {0.4F, -2.5F, 0}, .radius = 0.08});
    water.emitters.sinks.push_back({{1.85F, -0.1F, -0.3F}, {2.1F, 0.7F, 0.3F}});
    const ErosionRun run =
        run_water(before, water, {.steps = 60, .frame_seconds = 0.02, .warm_up = 10},
                  {.rate = 2e-3, .critical = 6.0, .shear = terrain::ShearVelocity::Full});
    std::size_t most = 0;
    double deepest = 0.0;
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        const double way =
            static_cast<double>(glm::distance(before.positions[i], run.mesh.positions[i]));
        if (way > deepest) {
            deepest = way;
            most = i;
        }
    }
    const glm::vec3 where = before.positions[most];
    EXPECT_GT(deepest, 1e-3);
    EXPECT_EQ(where.y, 0.0F);
    EXPECT_LT(std::hypot(where.x - 0.42F, where.z), 0.2F);
}

}  // namespace
}  // namespace scree
