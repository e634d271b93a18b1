#include "terrain/fluid/position_fluid.h"

#include "base/error.h"
#include "base/parallel.h"
#include "tests/terrain/fluid/fluid_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

using terrain::FluidState;
using terrain::PositionFluid;
using terrain::PositionFluidSetup;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kFrame = 1.0 / 60;

double energy(const FluidState& state, double gravity) {
    double sum = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const double speed = static_cast<double>(glm::length(state.velocities[i]));
        sum += 0.5 * speed * speed + gravity * static_cast<double>(state.positions[i].y);
    }
    return sum;
}

// Water in the corner of a tub.
PositionFluidSetup pool(const glm::vec3& high) {
    PositionFluidSetup setup;
    setup.options.radius = 0.04;
    setup.domain = {glm::vec3(-1), glm::vec3(3)};
    setup.emitters.pools = {{glm::vec3(0.0F), high}};
    return setup;
}

void run(PositionFluid& fluid, int frames, double seconds = kFrame) {
    for (int i = 0; i < frames; ++i)
        fluid.step(seconds);
}

TEST(PositionFluid, AColumnComesToRestAtItsOwnVolume) {
    PositionFluid fluid(pool({0.41F, 0.65F, 0.41F}));
    fluid.set_mesh(test::tub({0.4F, 1.2F, 0.4F}, 3));
    run(fluid, 90);
    const FluidState& state = fluid.state();
    ASSERT_EQ(state.size(), 5U * 5U * 8U);
    double height = 0.0, speed = 0.0, lowest = 1.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        height += static_cast<double>(state.positions[i].y) / 200.0;
        speed += static_cast<double>(glm::length(state.velocities[i])) / 200.0;
        lowest = std::min(lowest, static_cast<double>(state.positions[i].y));
    }
    // 200 particles of 8 cm fill 0.64 m of the tub; their mean height is half of that.
    EXPECT_NEAR(height, 0.32, 0.025);
    EXPECT_LT(speed, 0.1);
    EXPECT_NEAR(lowest, 0.04, 0.004);
}

TEST(PositionFluid, ADamBreaksLosesEnergyAndStaysInItsTub) {
    PositionFluid fluid(pool({0.4F, 0.48F, 0.4F}));
    fluid.set_mesh(test::tub({1.2F, 1.0F, 0.4F}, 5));
    fluid.step(kFrame);
    const std::size_t n = fluid.state().size();
    ASSERT_EQ(n, 5U * 6U * 5U);
    double before = energy(fluid.state(), 9.81);
    float front = 0.0F;
    for (int i = 0; i < 80; ++i) {
        fluid.step(kFrame);
        const double now = energy(fluid.state(), 9.81);
        EXPECT_LE(now, before * 1.002) << "frame " << i;
        before = now;
        for (const glm::vec3& p : fluid.state().positions)
            front = std::max(front, p.x);
    }
    EXPECT_GT(front, 1.1F);  // it reached the far wall
    EXPECT_EQ(fluid.state().size(), n);
    for (const glm::vec3& p : fluid.state().positions) {
        EXPECT_GT(p.y, 0.0F);
        EXPECT_TRUE(p.x > 0.0F && p.x < 1.2F && p.z > 0.0F && p.z < 0.4F);
    }
}

TEST(PositionFluid, AParticleRestsOnASlabWithoutGainingEnergy) {
    PositionFluidSetup setup;
    setup.options.radius = 0.05;
    PositionFluid fluid(setup);
    fluid.set_mesh(test::level_ground(1.0F, 7));
    const glm::vec3 places[] = {{0.013F, 0.3F, 0.02F}, {0.7F, 0.02F, 0.1F}, {-0.6F, -0.03F, 0.4F}};
    terrain::add_particles(fluid, places);
    double before = energy(fluid.state(), 9.81);
    for (int i = 0; i < 60; ++i) {
        fluid.step(kFrame);
        // The two that began inside the slab's radius are lifted out, no faster than that.
        const double now = energy(fluid.state(), 9.81);
        EXPECT_LE(now, before + (i == 0 ? 9.81 * 0.12 : 1e-3));
        before = now;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(fluid.state().positions[i].y, 0.05F, 0.002F);
        EXPECT_LT(glm::length(fluid.state().velocities[i]), 0.02F);
        EXPECT_TRUE(fluid.state().contacts[i].touching());
        EXPECT_NEAR(fluid.state().contacts[i].distance, 0.05F, 0.002F);
    }
}

TEST(PositionFluid, FastRainDoesNotPassThroughThinGround) {
    PositionFluidSetup setup;
    setup.options.radius = 0.03;
    setup.domain = {glm::vec3(-2, -0.5F, -2), glm::vec3(2, 4, 2)};
    setup.emitters.rains.push_back(
        {.centre = {0, 2, 0}, .width = 1.6, .depth = 1.6, .rate = 600, .velocity = {3, -40, 1}});
    PositionFluid fluid(setup);
    fluid.set_mesh(test::level_ground(1.0F, 13));
    run(fluid, 30);
    EXPECT_GT(fluid.state().size(), 150U);
    std::size_t touching = 0;
    for (std::size_t i = 0; i < fluid.state().size(); ++i) {
        const glm::vec3 p = fluid.state().positions[i];
        if (std::abs(p.x) < 0.95F && std::abs(p.z) < 0.95F) {
            EXPECT_GT(p.y, -1e-4F);
        }
        touching += fluid.state().contacts[i].touching() ? 1 : 0;
    }
    EXPECT_GT(touching, 50U);
}

TEST(PositionFluid, FloatsWithoutGravityAndWithoutAMesh) {
    PositionFluidSetup setup = pool({0.3F, 0.3F, 0.3F});
    setup.gravity = glm::vec3(0.0F);
    PositionFluid fluid(setup);
    run(fluid, 20);
    ASSERT_EQ(fluid.state().size(), 27U);
    for (const glm::vec3& v : fluid.state().velocities)
        EXPECT_LT(glm::length(v), 0.2F);
    glm::vec3 middle(0.0F);
    for (const glm::vec3& p : fluid.state().positions)
        middle += p / 27.0F;
    EXPECT_LT(glm::distance(middle, glm::vec3(0.12F)), 0.005F);
}

TEST(PositionFluid, DividesLongFramesAndRefusesAbsurdOnes) {
    PositionFluid fluid(pool({0.3F, 0.3F, 0.3F}));
    fluid.set_mesh(test::tub({0.4F, 1.0F, 0.4F}, 2));
    fluid.step(kFrame);
    EXPECT_GE(fluid.step(0.1), 2);
    EXPECT_THAT([&] { fluid.step(100.0); },
                ThrowsMessage<InvalidInput>(HasSubstr("take shorter frames or larger particles")));
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()})
        EXPECT_THROW(fluid.step(bad), InvalidInput);
}

TEST(PositionFluid, CountsWhatLeavesDrainsAndFindsNoRoom) {
    PositionFluidSetup setup;
    setup.options.radius = 0.05;
    setup.options.max_particles = 60;
    setup.domain = {glm::vec3(-1, -1, -1), glm::vec3(1, 2, 1)};
    setup.emitters.sources.push_back(
        {.centre = {-0.5F, 0.5F, 0}, .velocity = {2, 0, 0}, .radius = 0.12});
    setup.emitters.sinks.push_back({{0.0F, -0.5F, 0.0F}, {0.4F, 0.2F, 1}});
    setup.emitters.pools.push_back({{-0.3F, -0.6F, -0.3F}, {0.3F, 0.3F, 0.3F}});
    PositionFluid fluid(setup);
    fluid.set_mesh(test::level_ground(0.4F, 4));  // water at its side falls out of the domain
    run(fluid, 120);
    const terrain::FluidTally& tally = fluid.state().tally;
    EXPECT_GT(tally.blocked, 50U);  // the lower half of the pool is buried
    EXPECT_GT(tally.refused, 0U);
    EXPECT_GT(tally.drained, 0U);
    EXPECT_GT(tally.left_domain, 0U);
    EXPECT_EQ(tally.emitted, fluid.state().size() + tally.drained + tally.left_domain);
    EXPECT_LE(fluid.state().size(), 60U);
}

TEST(PositionFluid, RefusesASourceInsideTheMesh) {
    PositionFluidSetup setup;
    setup.emitters.sources.push_back({.centre = {0, 0.1F, 0}, .radius = 0.1});
    PositionFluid inside(setup);
    EXPECT_THAT(
        [&] {
            inside.set_mesh(test::block({0, 0, 0}, 1.0F, 4));
        },
        ThrowsMessage<InvalidInput>(HasSubstr("source 0 lies inside the mesh")));
    setup.emitters.sources[0].centre = {0, 0.5F, 0};  // half its opening is free
    PositionFluid half(setup);
    half.set_mesh(test::block({0, 0, 0}, 1.0F, 4));
    run(half, 20);
    EXPECT_GT(half.state().tally.emitted, 0U);
    EXPECT_GT(half.state().tally.blocked, 0U);
}

TEST(PositionFluid, RefusesBadSetups) {
    PositionFluidSetup setup;
    setup.options.radius = 0.0;
    EXPECT_THROW(PositionFluid{setup}, InvalidOption);
    setup = {};
    setup.gravity.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(PositionFluid{setup}, InvalidInput);
    setup = {};
    setup.domain.low.y = setup.domain.high.y;
    EXPECT_THROW(PositionFluid{setup}, InvalidInput);
    setup = {};
    setup.emitters.sources.push_back({.velocity = {0, 0, 0}});
    EXPECT_THAT([&] { PositionFluid{setup}; },
                ThrowsMessage<InvalidInput>("source 0 flows at 0 m/s; take 0.001 to 1000"));
    setup = {};
    setup.emitters.rains.push_back({.rate = 1e7});
    PositionFluid flood(setup);
    EXPECT_THAT([&] { flood.step(0.5); },
                ThrowsMessage<InvalidInput>(HasSubstr("lower their rates")));
}

FluidState poured(int threads, bool interrupted) {
    const ThreadLimit limit(threads);
    PositionFluidSetup setup = pool({0.4F, 0.4F, 0.4F});
    setup.emitters.sources.push_back(
        {.centre = {0.6F, 0.7F, 0.2F}, .velocity = {-1, -1, 0}, .radius = 0.1});
    const auto mesh = test::tub({1.0F, 1.0F, 0.4F}, 5);
    PositionFluid fluid(setup);
    fluid.set_mesh(mesh);
    run(fluid, 15);
    if (!interrupted) {
        run(fluid, 15);
        return fluid.state();
    }
    PositionFluid second(setup);
    second.set_mesh(mesh);
    second.restore(fluid.state());
    run(second, 15);
    return second.state();
}

TEST(PositionFluid, SameBytesForAnyThreadsAndWhenTakenUpAgain) {
    const FluidState one = poured(1, false);
    EXPECT_GT(one.size(), 150U);
    EXPECT_TRUE(one == poured(2, false));
    EXPECT_TRUE(one == poured(3, true));
}

TEST(FluidState, ParticlesCanBeAddedAndRemoved) {
    PositionFluid fluid({});
    const std::vector<glm::vec3> places = {{0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {3, 1, 0}};
    terrain::add_particles(fluid, places, {0, 0, 1});
    const std::uint64_t gone[] = {2, 0, 77};
    terrain::remove_particles(fluid, gone);
    EXPECT_THAT(fluid.state().ids, testing::ElementsAre(1U, 3U));
    EXPECT_EQ(fluid.state().positions[1], places[3]);
    EXPECT_EQ(fluid.state().tally.removed, 2U);
    FluidState broken = fluid.state();
    broken.ids[1] = 1;
    EXPECT_THAT([&] { fluid.restore(broken); },
                ThrowsMessage<InvalidInput>(HasSubstr("ids must increase")));
    broken = fluid.state();
    broken.velocities[0].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(fluid.restore(broken), InvalidInput);
    broken = fluid.state();
    broken.radius = 1.0;
    EXPECT_THROW(fluid.restore(broken), InvalidInput);
}

}  // namespace
}  // namespace scree
