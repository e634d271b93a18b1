#include "vision/gravel_likeness.h"

#include "base/error.h"
#include "base/random.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

using testing::HasSubstr;

Rock disc(double x, double y, float radius, float confidence) {
    Rock rock;
    rock.outline.centre = {x, y};
    rock.outline.radii.fill(radius);
    rock.outline.confidence = confidence;
    rock.depth = radius;
    return rock;
}

// Discs of three sizes on a grid, as many as fit.
std::vector<Rock> grid_of_rocks(int width, int height, float confidence) {
    std::vector<Rock> rocks;
    for (int y = 15; y + 15 <= height; y += 30)
        for (int x = 15; x + 15 <= width; x += 30)
            rocks.push_back(
                disc(x, y, 7.0F + 3.0F * static_cast<float>((x + y) / 30 % 3), confidence));
    return rocks;
}

FloatRaster rings_of(const std::vector<Rock>& rocks, int width, int height) {
    FloatRaster boundary(width, height, 0.05F);
    for (const Rock& rock : rocks)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double d =
                    std::hypot(x + 0.5 - rock.outline.centre.x, y + 0.5 - rock.outline.centre.y);
                if (std::abs(d - static_cast<double>(rock.outline.radii[0])) < 1.0)
                    boundary(x, y) = 0.9F;
            }
    return boundary;
}

TEST(GravelLikeness, ManySureRocksOfManySizesAreGravel) {
    const auto rocks = grid_of_rocks(240, 180, 0.9F);
    const GravelLikeness result = gravel_likeness(rings_of(rocks, 240, 180), rocks);
    EXPECT_EQ(result.likeness, 1.0);
    EXPECT_EQ(result.n_rocks, rocks.size());
    EXPECT_NEAR(result.confidence, 0.9, 1e-6);
    EXPECT_GT(result.explained, 0.99);
    EXPECT_GT(result.spread, 0.2);
    EXPECT_EQ(result.reason, "");
}

TEST(GravelLikeness, NamesTheWeakestFigure) {
    const auto rocks = grid_of_rocks(240, 180, 0.9F);
    const FloatRaster field = rings_of(rocks, 240, 180);

    EXPECT_EQ(gravel_likeness(field, {}).reason, "no rocks were found");
    EXPECT_EQ(gravel_likeness(field, {}).likeness, 0.0);
    EXPECT_THAT(gravel_likeness(field, {rocks[0]}).reason, HasSubstr("only 1 rock was found"));

    const auto doubtful = grid_of_rocks(240, 180, 0.55F);
    EXPECT_THAT(gravel_likeness(field, doubtful).reason, HasSubstr("doubtful, 55 % sure"));

    const FloatRaster busy(240, 180, 0.8F);
    std::vector<Rock> small;
    for (const Rock& rock : rocks)
        small.push_back(
            disc(rock.outline.centre.x, rock.outline.centre.y, 0.2F * rock.outline.radii[0], 0.9F));
    EXPECT_THAT(gravel_likeness(busy, small).reason, HasSubstr("of its edges belong"));

    auto equal = rocks;
    for (Rock& rock : equal)
        rock.outline.radii.fill(10.0F);
    EXPECT_THAT(gravel_likeness(rings_of(equal, 240, 180), equal).reason,
                HasSubstr("the same size"));

    auto bricks = rocks;
    for (Rock& rock : bricks)
        for (std::size_t k = 0; k < kRadii; ++k)
            rock.outline.radii[k] *=
                1.0F + 0.3F * std::cos(2.0F * static_cast<float>(k) * 0.0174533F);
    const GravelLikeness wall = gravel_likeness(field, bricks);
    EXPECT_GT(wall.alignment, 0.99);
    EXPECT_THAT(wall.reason, HasSubstr("the same direction"));
}

TEST(GravelLikeness, FallsWithConfidence) {
    const FloatRaster field = rings_of(grid_of_rocks(240, 180, 1.0F), 240, 180);
    double last = 1.0;
    for (const float confidence : {0.85F, 0.75F, 0.65F, 0.55F, 0.35F}) {
        const double now = gravel_likeness(field, grid_of_rocks(240, 180, confidence)).likeness;
        EXPECT_LE(now, last);
        last = now;
    }
    EXPECT_EQ(last, 0.0);
}

TEST(GravelLikeness, RocksThatThePictureCutsOrThatLieOutsideDoNoHarm) {
    auto rocks = grid_of_rocks(240, 180, 0.9F);
    rocks.push_back(disc(-5.0, 90.0, 20.0F, 0.9F));
    rocks.push_back(disc(5000.0, 5000.0, 30.0F, 0.9F));
    rocks.push_back(disc(120.0, 90.0, 1e6F, 0.9F));
    const GravelLikeness result =
        gravel_likeness(rings_of(grid_of_rocks(240, 180, 0.9F), 240, 180), rocks);
    EXPECT_GT(result.likeness, kLooksLikeGravel);
    EXPECT_THROW(gravel_likeness({}, rocks), InvalidInput);
}

}  // namespace
}  // namespace scree::vision
