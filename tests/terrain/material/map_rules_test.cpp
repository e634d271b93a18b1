#include "terrain/material/map_rules.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "tests/terrain/material/map_samples.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr const char* kRules = R"({"format": "scree-rules", "version": 1, "water_level": 0.2,
 "rules": [
  {"material": "wet mud", "water_distance": {"max": 1.0}},
  {"material": 7, "slope_deg": {"min": 30}, "height": {"min": 0.5, "max": 9}}],
 "otherwise": "sand"})";

// Flat, then a ramp of 45 degrees.
Heightfield ramp() {
    Heightfield ground{FloatRaster(20, 6), 0.5};
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 20; ++x)
            ground.heights(x, y) = 0.5F * static_cast<float>(std::max(0, x - 5));
    return ground;
}

TEST(MapRules, FirstMatchWins) {
    const auto materials = test::three_materials();
    const RuleSet rules = rules_from_json(kRules, "r", materials);
    const DescriptionMap map = map_from_rules(ramp(), rules, materials);
    for (int x = 0; x < 20; ++x) {
        const int expected = x <= 7 ? 3 : 7;  // wet to x = 5 (height 0), and 1 m beyond it
        EXPECT_EQ(map.ids(x, 3), expected) << x;
    }
    EXPECT_TRUE(map.repose.empty());
    EXPECT_EQ(map.cell_size, 0.5);
}

TEST(MapRules, CurvatureIsHalfTheLaplacian) {
    Heightfield bowl{FloatRaster(9, 9), 0.25};
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x)
            bowl.heights(x, y) =
                static_cast<float>(0.0625 * ((x - 4) * (x - 4) + (y - 4) * (y - 4)));
    RuleSet rules;
    rules.rules.resize(1);
    rules.rules[0].id = 7;
    rules.rules[0].ranges[2] = {1.999, 2.001, 0.0};
    const DescriptionMap map = map_from_rules(bowl, rules, test::three_materials());
    for (const std::uint8_t id : map.ids)
        EXPECT_EQ(id, 7);
}

// A soft edge: ids switch at the end of the range, where the parameters are half and half.
TEST(MapRules, SoftRangesMixParametersOnly) {
    const auto materials = test::three_materials();
    Heightfield ground{FloatRaster(101, 2), 1.0};
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 101; ++x)
            ground.heights(x, y) = static_cast<float>(x) / 100.0F;
    RuleSet rules;
    rules.rules.resize(1);
    rules.rules[0].id = 7;
    rules.rules[0].ranges[0] = {0.5, 9.0, 0.4};
    const DescriptionMap map = map_from_rules(ground, rules, materials);
    EXPECT_EQ(map.ids(49, 0), 0);
    EXPECT_EQ(map.ids(50, 0), 7);
    EXPECT_NEAR(map.mobility(50, 0), 0.5 * (0.5 + 0.8), 1e-5);
    EXPECT_NEAR(map.mobility(29, 0), 0.5, 1e-6);
    EXPECT_NEAR(map.mobility(71, 0), 0.8, 1e-6);
    EXPECT_NEAR(map.mobility(40, 0), 0.5 + 0.3 * (0.25 * 0.25 * 2.5), 1e-5);
    for (int x = 1; x < 101; ++x)
        EXPECT_GE(map.mobility(x, 0), map.mobility(x - 1, 0) - 1e-6F);
}

TEST(MapRules, AreTheSameForAnyThreadCount) {
    Rng rng({.seed = 4});
    Heightfield ground{FloatRaster(90, 70), 0.5};
    for (float& value : ground.heights)
        value = static_cast<float>(rng.uniform());
    const auto materials = test::three_materials();
    RuleSet rules = rules_from_json(kRules, "r", materials);
    rules.rules[1].ranges[1].soft = 10.0;
    const DescriptionMap many = map_from_rules(ground, rules, materials);
    const ThreadLimit one(1);
    EXPECT_TRUE(test::same_map(many, map_from_rules(ground, rules, materials)));
}

struct Wrong {
    const char* from;
    const char* to;
    const char* words;
};
class MapRulesErrors : public testing::TestWithParam<Wrong> {};

TEST_P(MapRulesErrors, NameThePath) {
    std::string text = kRules;
    const auto at = text.find(GetParam().from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::string(GetParam().from).size(), GetParam().to);
    EXPECT_THAT(
        [&] { rules_from_json(text, "r.json", test::three_materials()); },
        ThrowsMessage<InvalidInput>(AllOf(HasSubstr("r.json"), HasSubstr(GetParam().words))));
}
INSTANTIATE_TEST_SUITE_P(
    All, MapRulesErrors,
    testing::Values(
        Wrong{"\"wet mud\"", "\"snow\"", "rules[0].material is \"snow\", which is no material"},
        Wrong{"\"material\": 7", "\"material\": 8", "rules[1].material is 8"},
        Wrong{"\"material\": 7", "\"material\": 7.5", "rules[1].material is of type number"},
        Wrong{"\"sand\"", "null", "otherwise is of type null"},
        Wrong{"\"slope_deg\"", "\"slope\"", "rules[1] has the unknown member \"slope\""},
        Wrong{"\"min\": 30", "\"least\": 30", "rules[1].slope_deg has the unknown member"},
        Wrong{"\"min\": 0.5, \"max\": 9", "\"min\": 9, \"max\": 1",
              "rules[1].height has min 9 above"},
        Wrong{"\"max\": 1.0", "\"max\": 1.0, \"soft\": -1", "water_distance.soft is -1"},
        Wrong{"\"water_level\": 0.2,", "", "rules[0].water_distance needs the member water_level"},
        Wrong{"\"otherwise\": \"sand\"", "\"a\": 1", "otherwise is missing"}));

TEST(MapRules, SayWhatIsWrong) {
    const auto materials = test::three_materials();
    RuleSet rules;
    rules.rules.resize(1);
    rules.rules[0].ranges[3].high = 1.0;
    EXPECT_THAT([&] { map_from_rules(ramp(), rules, materials); },
                ThrowsMessage<InvalidInput>(HasSubstr("rule 0 asks for water_distance")));
    rules.rules[0].ranges[3] = {};
    rules.otherwise = 4;
    EXPECT_THAT([&] { map_from_rules(ramp(), rules, materials); },
                ThrowsMessage<InvalidInput>(HasSubstr("id 4, which has no material")));
    Heightfield holes = ramp();
    holes.heights(2, 2) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(map_from_rules(holes, {}, materials), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
