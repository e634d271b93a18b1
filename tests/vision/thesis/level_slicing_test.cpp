#include "vision/thesis/level_slicing.h"

#include "base/random.h"

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

constexpr ChangeMode kModes[] = {ChangeMode::Any, ChangeMode::Pair, ChangeMode::All,
                                 ChangeMode::Abs};

GreyRaster noise(std::uint64_t seed, unsigned n_values) {
    GreyRaster grey(41, 23);
    Rng rng({.seed = seed});
    for (auto& v : grey)
        v = static_cast<std::uint8_t>(rng.below(n_values));
    return grey;
}

ThesisOptions with(ChangeMode mode, int levels = 256, int offset = 2) {
    ThesisOptions options;
    options.change = mode;
    options.levels = levels;
    options.offset = offset;
    return options;
}

GreyRaster line_picture(int thickness) {
    GreyRaster grey(40, 40, 200);
    for (int y = 20; y < 20 + thickness; ++y)
        for (int x = 0; x < 40; ++x)
            grey(x, y) = 50;
    return grey;
}

TEST(LevelSlicing, ClosedFormEqualsTheLoopOverLevelsBitForBit) {
    for (const ChangeMode mode : kModes)
        for (const int levels : {1, 7, 100, 256, 1000})
            for (const unsigned n_values : {4U, 256U}) {
                const auto options = with(mode, levels, 1 + levels % 3);
                const GreyRaster grey = noise(static_cast<std::uint64_t>(levels), n_values);
                ASSERT_EQ(accumulate_changes(grey, options),
                          accumulate_changes_by_levels(grey, options))
                    << names_of(mode)[static_cast<std::size_t>(mode)] << " " << levels;
            }
}

TEST(LevelSlicing, GivesTheQuantisedWeberContrast) {
    const auto changed = accumulate_changes(line_picture(2), with(ChangeMode::Any));
    EXPECT_EQ(changed(20, 20), 0.75F);  // 1 - floor(256 * 50 / 200) / 256
    EXPECT_EQ(changed(20, 10), 0.0F);
    EXPECT_EQ(changed(20, 18), 0.0F) << "the brighter side shows no change";
    EXPECT_EQ(accumulate_changes(line_picture(2), with(ChangeMode::Abs))(20, 20), 150.0F / 256.0F);
}

TEST(LevelSlicing, PairFindsNarrowLinesAllFindsNone) {
    const auto pair = accumulate_changes(line_picture(2), with(ChangeMode::Pair));
    EXPECT_EQ(pair(20, 20), 0.75F);
    const auto wide = accumulate_changes(line_picture(8), with(ChangeMode::Pair));
    EXPECT_EQ(wide(20, 23), 0.0F) << "wider than twice the offset";
    const auto all = accumulate_changes(line_picture(2), with(ChangeMode::All));
    EXPECT_EQ(all(20, 20), 0.0F) << "neighbours along the line are as dark";
    GreyRaster spot(9, 9, 200);
    spot(4, 4) = 50;
    EXPECT_EQ(accumulate_changes(spot, with(ChangeMode::All))(4, 4), 0.75F);
}

TEST(LevelSlicing, BlackNeighboursAndBlackPicturesShowNoChange) {
    for (const ChangeMode mode : kModes)
        EXPECT_EQ(accumulate_changes(GreyRaster(9, 9), with(mode)), FloatRaster(9, 9));
    GreyRaster grey(9, 9);
    grey(4, 4) = 9;
    EXPECT_EQ(accumulate_changes(grey, with(ChangeMode::Any))(4, 4), 0.0F);
    EXPECT_EQ(accumulate_changes(grey, with(ChangeMode::Any))(4, 2), 1.0F) << "sum never exceeds 1";
}

TEST(LevelSlicing, OptionsAreChecked) {
    EXPECT_THAT([] { accumulate_changes(GreyRaster(2, 2), with(ChangeMode::Any, 0)); },
                testing::ThrowsMessage<InvalidOption>(testing::HasSubstr("levels is 0")));
    ThesisOptions even;
    even.median_kernel = 4;
    EXPECT_THAT([&] { check_thesis(even); },
                testing::ThrowsMessage<InvalidOption>(testing::HasSubstr("median-kernel is 4")));
}

}  // namespace
}  // namespace scree::vision
