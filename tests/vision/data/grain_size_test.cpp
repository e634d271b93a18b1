#include "vision/data/grain_size.h"

#include "base/error.h"
#include "base/number_text.h"
#include "base/whole_file.h"
#include "tests/support/temp_dir.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

using testing::HasSubstr;

RockSet discs(const std::vector<float>& radii) {
    RockSet set;
    set.width = set.height = 1000;
    for (const float radius : radii) {
        Rock rock;
        rock.outline.radii.fill(radius);
        rock.depth = radius;
        set.rocks.push_back(rock);
    }
    return set;
}

// The polygon through 360 points of a circle is this much smaller than the disc.
double polygon_factor() {
    return std::sqrt(std::sin(std::numbers::pi / 180.0) / (std::numbers::pi / 180.0));
}

TEST(GrainSize, PercentilesByNumberAreThoseOfTheRanks) {
    const GrainSizeCurve curve = grain_size_curve(discs({8, 1, 2, 4, 16}));
    const double f = 2.0 * polygon_factor();
    EXPECT_NEAR(curve.by_number.d50, 4 * f, 1e-9);
    EXPECT_NEAR(curve.by_number.d84, (8 + 0.36 * 8) * f, 1e-9);
    EXPECT_NEAR(curve.by_number.d16, (1 + 0.64) * f, 1e-9);
    EXPECT_EQ(curve.unit(), "px");
    EXPECT_EQ(curve.grains.front().rock, 1U);
    EXPECT_DOUBLE_EQ(curve.grains[1].finer_by_number, 0.4);
}

TEST(GrainSize, BySizeOfAreaLargeRocksWeighMore) {
    // Areas 1 : 9; the middles of their shares lie at 0.05 and 0.55.
    const GrainSizeCurve curve = grain_size_curve(discs({10, 30}));
    const double f = 2.0 * polygon_factor();
    EXPECT_NEAR(curve.grains[0].finer_by_area, 0.1, 1e-12);
    EXPECT_EQ(curve.grains[1].finer_by_area, 1.0);
    EXPECT_NEAR(curve.by_area.d50, (10 + 0.9 * 20) * f, 1e-9);
    EXPECT_NEAR(curve.by_area.d84, 30 * f, 1e-9);
}

TEST(GrainSize, CurveRisesToOne) {
    const GrainSizeCurve curve = grain_size_curve(discs({3, 3, 9, 27, 4, 5, 50}));
    for (std::size_t i = 1; i < curve.grains.size(); ++i) {
        EXPECT_LE(curve.grains[i - 1].diameter_px, curve.grains[i].diameter_px);
        EXPECT_LT(curve.grains[i - 1].finer_by_area, curve.grains[i].finer_by_area);
        EXPECT_LT(curve.grains[i - 1].finer_by_number, curve.grains[i].finer_by_number);
    }
    EXPECT_EQ(curve.grains.back().finer_by_area, 1.0);
    EXPECT_LE(curve.by_number.d16, curve.by_number.d50);
    EXPECT_LE(curve.by_area.d50, curve.by_area.d84);
}

TEST(GrainSize, ScaleGivesMillimetres) {
    RockSet set = discs({10, 10});
    set.metres_per_pixel = 0.0005;
    const GrainSizeCurve curve = grain_size_curve(set);
    EXPECT_EQ(curve.unit(), "mm");
    EXPECT_NEAR(curve.by_number.d50, 10 * polygon_factor(), 1e-9);
    EXPECT_THAT(sizes_to_csv(curve), HasSubstr("diameter_mm"));
}

TEST(GrainSize, CutRocksAreFlaggedOrLeftOut) {
    RockSet set = discs({10, 20, 2});
    set.rocks[1].outline.touches_border = true;
    EXPECT_TRUE(grain_size_curve(set).grains[2].cut);
    EXPECT_EQ(grain_size_curve(set, {.count_cut_rocks = false}).grains.size(), 2U);
    EXPECT_EQ(grain_size_curve(set, {.min_diameter_px = 8}).grains.size(), 2U);
}

TEST(GrainSize, NoRocksGiveAnEmptyCurve) {
    const GrainSizeCurve curve = grain_size_curve(RockSet{});
    EXPECT_TRUE(curve.grains.empty());
    EXPECT_EQ(curve.by_area.d50, 0.0);
    EXPECT_THAT(sizes_to_csv(curve), HasSubstr("rock,diameter_px"));
}

TEST(GrainSize, TextHasALineARock) {
    const test::TempDir dir;
    const GrainSizeCurve curve = grain_size_curve(discs({10, 20}));
    write_sizes_csv(dir / "sizes.csv", curve);
    const std::string text = read_whole_file(dir / "sizes.csv", 10000);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 6 + 1 + 2);
    EXPECT_THAT(text, HasSubstr("# D50 by number: "));
    EXPECT_THAT(text, HasSubstr("\n1,19.99"));
}

TEST(GrainSize, RefusesBadOptions) {
    EXPECT_THROW(grain_size_curve(RockSet{}, {.min_diameter_px = -1}), InvalidOption);
}

}  // namespace
}  // namespace scree::vision
