#include "terrain/fluid/position_fluid.h"

#include "base/error.h"
#include "base/parallel.h"
#include "tests/terrain/fluid/fluid_samples.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

using terrain::FluidState;
using terrain::PositionFluid;
using terrain::PositionFluidSetup;
using testing::HasSubstr;
using testing::ThrowsMessage;

double energy(const FluidState& state, double gravity) {
    double sum = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const double speed = static_cast<double>(glm::length(state.velocities[i]));
        sum += 0.5 * speed * speed + gravity * static_cast<double>(state.positions[i].y);
    }
    return sum;
}

// A dam of 0.5 x 0.5 x 0.5 m in the corner of a tub one metre long.
PositionFluidSetup dam() {
    PositionFluidSetup setup;
    setup.options.radius = 0.03;
    setup.domain = {glm::vec3(-1), glm::vec3(3)};
    setup.emitters.pools = {{glm::vec3(0.0F), glm::vec3(0.5F, 0.5F, 0.5F)}};
    return setup;
}

TEST(PositionFluid, ComesToRestAsALevelColumnThatWeighsWhatItShould) {
    PositionFluidSetup setup = dam();
    setup.emitters.pools = {{glm::vec3(0.0F), glm::vec3(0.42F, 0.6F, 0.42F)}};
    PositionFluid fluid(setup);
    fluid.set_mesh(test::tub({0.42F, 1.5F, 0.42F}, 4));
    for (int i = 0; i < 120; ++i)
        fluid.step(1.0 / 60);
    const FluidState& state = fluid.state();
    float top = 0.0F, mean_speed = 0.0F, mean_height = 0.0F;
    for (std::size_t i = 0; i < state.size(); ++i) {
        top = std::max(top, state.positions[i].y);
        mean_speed += glm::length(state.velocities[i]) / static_cast<float>(state.size());
        mean_height += state.positions[i].y / static_cast<float>(state.size());
    }
    printf("n %zu top %g speed %g height %g\n", state.size(), top, mean_speed, mean_height);
    EXPECT_EQ(state.size(), 490U);
}

TEST(PositionFluid, DamBreaks) {
    PositionFluid fluid(dam());
    fluid.set_mesh(test::tub({1.0F, 1.0F, 0.5F}, 6));
    fluid.step(1.0 / 60);
    double before = energy(fluid.state(), 9.81), start = before;
    double worst = 0;
    for (int i = 0; i < 90; ++i) {
        fluid.step(1.0 / 60);
        const double now = energy(fluid.state(), 9.81);
        worst = std::max(worst, now - before);
        before = now;
        if (i % 10 == 0) {
        float front = 0, top = 0;
        for (auto& p : fluid.state().positions) {front = std::max(front, p.x); top = std::max(top, p.y);}
        printf("%d n %zu energy %g front %g top %g\n", i, fluid.state().size(), now/start, front, top);
        }
    }
    printf("worst %g of %g\n", worst, start);
}

}  // namespace
}  // namespace scree
