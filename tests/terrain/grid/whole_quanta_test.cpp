#include "terrain/grid/whole_quanta.h"

#include "terrain/grid/settle.h"
#include "terrain/grid/sound_step.h"
#include "tests/terrain/grid/ground_fixtures.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr float kQuantum = 1.0F / 262144.0F;

double sum_of(const FloatRaster& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(WholeQuanta, CarryTheRestsOnAndLeaveZerosAlone) {
    FloatRaster u = scree::test::rough_ground(200, 100, 0.37, 8).heights;
    for (int x = 0; x < 200; ++x)
        u(x, 40) = 0.0F;
    const FloatRaster before = u;
    round_to_quanta(u, kQuantum);
    EXPECT_NEAR(sum_of(u), sum_of(before), 0.5 * double{kQuantum} + 1e-12);
    for (std::size_t i = 0; i < u.size(); ++i) {
        const float quanta = u.data()[i] / kQuantum;
        EXPECT_EQ(quanta, std::round(quanta));
        EXPECT_NEAR(u.data()[i], before.data()[i], double{kQuantum});
        EXPECT_EQ(before.data()[i] == 0.0F, u.data()[i] == 0.0F && i / 200 == 40);
    }
    const FloatRaster rounded = u;
    round_to_quanta(u, kQuantum);
    EXPECT_TRUE(u == rounded);
}

// A pile dug by a ball, brought to rest at once, is a ground like any other: it stays where it is,
// keeps its volume, and answers the next load.
TEST(WholeQuanta, ADeformerGoesOnFromReplacedDisplacements) {
    for (const Reading reading : {Reading::Sound, Reading::Literal}) {
        const Heightfield base = scree::test::flat_ground(200, 150);
        const SoilField soil(kSand);
        Deformer ground(base, soil, {.reading = reading});
        ground.step({{scree::test::ball(128.0, 70.0, 9.0, -3.0, 4.0F, 4.0F)}});
        FloatRaster wanted = ground.displacement(ground.extent());
        if (reading == Reading::Sound)
            settle_to_rest(wanted, base, soil);
        ground.replace_displacement(wanted);
        const FloatRaster got = ground.displacement(ground.extent());
        for (std::size_t i = 0; i < got.size(); ++i)
            ASSERT_NEAR(got.data()[i], wanted.data()[i], 2e-5);
        if (reading == Reading::Literal)
            continue;
        EXPECT_NEAR(ground.displaced_volume(), sum_of(wanted), 1e-5);
        const double volume = ground.displaced_volume();
        EXPECT_FALSE(ground.step({}).tiles_stepped == 0);  // looked at, and found at rest
        EXPECT_TRUE(ground.settle(50, 1e-3).at_rest);
        EXPECT_EQ(ground.displaced_volume(), volume);
        ground.step({{scree::test::ball(60.0, 70.0, 9.0, -3.0, 4.0F, 4.0F)}});
        EXPECT_LT(ground.displacement({60, 70, 1, 1})(0, 0), -1.0F);
        EXPECT_EQ(ground.displaced_volume(), volume);
    }
}

TEST(WholeQuanta, ErrorsNameSizesAndValues) {
    const Heightfield base = scree::test::flat_ground(8, 6);
    Deformer ground(base, SoilField(kSand));
    EXPECT_THAT([&] { ground.replace_displacement(FloatRaster(6, 8)); },
                ThrowsMessage<InvalidInput>(HasSubstr("6 x 8 cells, the ground 8 x 6")));
    FloatRaster broken(8, 6);
    broken(3, 3) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(ground.replace_displacement(broken), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
