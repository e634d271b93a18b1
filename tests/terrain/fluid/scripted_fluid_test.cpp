#include "terrain/fluid/scripted_fluid.h"

#include "base/error.h"
#include "base/parallel.h"
#include "terrain/fluid/particle_ply.h"
#include "tests/terrain/fluid/fluid_samples.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

using terrain::FluidState;
using terrain::ScriptedFluid;
using terrain::ScriptedStream;
using testing::HasSubstr;
using testing::ThrowsMessage;

ScriptedStream stream() {
    return {.path = {{-1, 0.05F, 0}, {0, 0.05F, 0}, {0, 0.05F, 1}},
            .speed = 0.5,
            .half_width = 0.1,
            .half_height = 0.04,
            .per_metre = 30};
}

TEST(ScriptedFluid, IsFullFromTheStartAndFlowsAlongItsPath) {
    ScriptedFluid fluid({stream()});
    EXPECT_NEAR(static_cast<double>(fluid.state().size()), 60.0, 1.0);
    const FluidState before = fluid.state();
    EXPECT_EQ(fluid.step(0.1), 1);
    const FluidState& after = fluid.state();
    EXPECT_NEAR(static_cast<double>(after.size()), 60.0, 1.0);
    for (std::size_t i = 0; i < after.size(); ++i) {
        const glm::vec3 p = after.positions[i];
        EXPECT_TRUE((p.x >= -1.01F && p.x <= 0.101F && std::abs(p.z) <= 0.101F) ||
                    (std::abs(p.x) <= 0.101F && p.z >= -0.101F && p.z <= 1.01F));
        const auto old = std::find(before.ids.begin(), before.ids.end(), after.ids[i]);
        if (old != before.ids.end() && p.x < -0.2F) {
            const auto k = static_cast<std::size_t>(old - before.ids.begin());
            EXPECT_NEAR(p.x - before.positions[k].x, 0.05F, 1e-5F);
        }
        EXPECT_NEAR(glm::length(after.velocities[i]), 0.5F, 1e-6F);
    }
    fluid.step(20.0);
    EXPECT_EQ(fluid.state().tally.emitted, fluid.state().size() + fluid.state().tally.left_domain);
}

TEST(ScriptedFluid, TouchesWhatIsNearOnEitherSide) {
    ScriptedFluid fluid({stream()}, {.radius = 0.04});
    fluid.set_mesh(test::level_ground(2.0F, 20));
    std::size_t touching = 0;
    for (std::size_t i = 0; i < fluid.state().size(); ++i) {
        const float height = fluid.state().positions[i].y;
        EXPECT_EQ(fluid.state().contacts[i].touching(), std::abs(height) <= 0.05F) << height;
        touching += fluid.state().contacts[i].touching() ? 1 : 0;
    }
    EXPECT_GT(touching, 10U);
    EXPECT_EQ(terrain::colliding_positions(fluid.state()).size(), touching);
}

TEST(ScriptedFluid, FollowsFromTheTimeAlone) {
    ScriptedFluid once({stream(), stream()});
    once.step(0.75);
    ScriptedFluid often({stream(), stream()});
    const ThreadLimit limit(1);
    for (int i = 0; i < 3; ++i)
        often.step(0.25);
    EXPECT_TRUE(once.state() == often.state());
}

TEST(ScriptedFluid, WhatIsTakenOutStaysOut) {
    ScriptedFluid fluid({stream()});
    const std::uint64_t id = fluid.state().ids[0];
    const std::size_t n = fluid.state().size();
    const std::uint64_t gone[] = {id};
    terrain::remove_particles(fluid, gone);
    EXPECT_EQ(fluid.state().size(), n - 1);
    fluid.step(0.001);
    EXPECT_EQ(std::count(fluid.state().ids.begin(), fluid.state().ids.end(), id), 0);
    const glm::vec3 more[] = {glm::vec3(0.0F)};
    EXPECT_THAT([&] { terrain::add_particles(fluid, more); },
                ThrowsMessage<InvalidInput>(HasSubstr("takes no particles")));
}

TEST(ScriptedFluid, RefusesStreamsThatCannotFlow) {
    EXPECT_THROW(ScriptedFluid({}), InvalidInput);
    const auto refused = [](auto&& change, const char* why) {
        ScriptedStream s = stream();
        change(s);
        EXPECT_THAT([&] { ScriptedFluid({s}); }, ThrowsMessage<InvalidInput>(HasSubstr(why)));
    };
    refused([](auto& s) { s.path.resize(1); }, "stream 0 has a path of fewer than two places");
    refused([](auto& s) { s.path = {glm::vec3(1), glm::vec3(1)}; }, "without length");
    refused([](auto& s) { s.path[0].x = std::nanf(""); }, "not finite");
    refused([](auto& s) { s.speed = 0.0; }, "speed");
    refused([](auto& s) { s.half_width = -1.0; }, "half width");
    refused([](auto& s) { s.per_metre = 4e6; }, "at most 5e+06");
}

TEST(ParticlePly, HoldsEveryParticle) {
    ScriptedFluid fluid({stream()});
    const std::string ply = terrain::particles_as_ply(fluid.state());
    const std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                             std::to_string(fluid.state().size()) + "\n";
    EXPECT_EQ(ply.substr(0, head.size()), head);
    const auto body = ply.find("end_header\n") + 11;
    EXPECT_EQ(ply.size() - body, 29 * fluid.state().size());
    EXPECT_EQ(std::memcmp(ply.data() + body, &fluid.state().positions[0], 12), 0);
}

}  // namespace
}  // namespace scree
