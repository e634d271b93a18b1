#include "terrain/prepare/river_bed.h"

#include "base/error.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace scree {
namespace {

using terrain::BedOptions;
using terrain::BedProfile;
using terrain::beds_from_json;
using terrain::cut_bed;
using terrain::GroundLattice;
using terrain::RiverBed;
using testing::HasSubstr;
using testing::ThrowsMessage;

// 101 by 101 places a metre apart on y = slope * x.
GroundLattice plane(double slope) {
    GroundLattice ground = terrain::lattice_over({0, 0}, {100, 100}, 101 * 101);
    for (int j = 0; j < ground.heights.height(); ++j)
        for (int i = 0; i < ground.heights.width(); ++i)
            ground.heights(i, j) = static_cast<float>(slope * ground.place(i, j).x);
    return ground;
}

const std::vector<glm::dvec2> kAcross = {{-10, 50}, {110, 50}};

TEST(RiverBed, CutsAFlatBottomAndStraightBanks) {
    GroundLattice ground = plane(0.0);
    const auto report = cut_bed(ground, {kAcross, {.width = 6, .depth = 2, .bank = 4}});
    EXPECT_FLOAT_EQ(static_cast<float>(report.deepest), 2.0F);
    EXPECT_EQ(report.n_lowered, 13U * 101U);  // within 7 m, not at 7
    EXPECT_NEAR(report.length, 100.0, 1.5);
    for (int j = 0; j <= 100; ++j) {
        const double d = std::abs(j - 50);
        const double depth = d <= 3 ? 2.0 : d <= 7 ? 2.0 * (7 - d) / 4 : 0.0;
        EXPECT_NEAR(ground.heights(30, j), -depth, 1e-5) << j;
    }
}

TEST(RiverBed, CutsAParabola) {
    GroundLattice ground = plane(0.0);
    cut_bed(ground, {kAcross, {.width = 10, .depth = 2, .bank = 5, .profile = BedProfile::Round}});
    for (int j = 40; j <= 60; ++j) {
        const double share = (j - 50) / 10.0;
        EXPECT_NEAR(ground.heights(70, j), -2.0 * (1.0 - share * share), 1e-5) << j;
    }
}

TEST(RiverBed, FollowsALineWithBends) {
    GroundLattice ground = plane(0.0);
    const std::vector<glm::dvec2> line = {{20, 20}, {60, 20}, {60, 80}};
    cut_bed(ground, {line, {.width = 4, .depth = 1, .bank = 0}});
    EXPECT_FLOAT_EQ(ground.heights(40, 20), -1.0F);
    EXPECT_FLOAT_EQ(ground.heights(60, 50), -1.0F);
    EXPECT_FLOAT_EQ(ground.heights(61, 19), -1.0F);  // around the corner
    EXPECT_FLOAT_EQ(ground.heights(40, 23), 0.0F);
    EXPECT_FLOAT_EQ(ground.heights(17, 20), 0.0F);  // before its start
}

TEST(RiverBed, FallsWithTheLandInEitherDirection) {
    for (const bool reversed : {false, true}) {
        GroundLattice ground = plane(0.1);
        // A dam across the way of the water.
        for (int j = 0; j <= 100; ++j)
            ground.heights(50, j) += 5.0F;
        std::vector<glm::dvec2> line = kAcross;
        if (reversed)
            std::swap(line.front(), line.back());
        cut_bed(ground, {line, {.width = 4, .depth = 1, .bank = 2}});
        for (int i = 1; i <= 100; ++i)
            EXPECT_GE(ground.heights(i, 50), ground.heights(i - 1, 50) - 1e-5F) << i;
        EXPECT_NEAR(ground.heights(20, 50), 0.1 * 20 - 1.0, 1e-4);
        EXPECT_NEAR(ground.heights(50, 50), 0.1 * 51 - 1.0, 0.06);
    }
}

TEST(RiverBed, FollowsTheLandIfTold) {
    GroundLattice ground = plane(0.0);
    for (int j = 0; j <= 100; ++j)
        ground.heights(50, j) = 5.0F;
    cut_bed(ground, {kAcross, {.width = 4, .depth = 1, .bank = 2, .falling = false}});
    EXPECT_NEAR(ground.heights(50, 50), 4.0, 0.1);
}

TEST(RiverBed, NeverRaisesTheGround) {
    GroundLattice ground = plane(0.0);
    ground.heights(30, 51) = -7.0F;
    const GroundLattice before = ground;
    cut_bed(ground, {kAcross, {.width = 8, .depth = 2, .bank = 3}});
    for (std::size_t i = 0; i < ground.heights.size(); ++i)
        EXPECT_LE(ground.heights.data()[i], before.heights.data()[i]);
    EXPECT_EQ(ground.heights(30, 51), -7.0F);
}

TEST(RiverBed, KeepsWhatIsUnknown) {
    GroundLattice ground = plane(0.0);
    for (int i = 40; i < 60; ++i)
        for (int j = 0; j <= 100; ++j)
            ground.heights(i, j) = std::numeric_limits<float>::quiet_NaN();
    const auto report = cut_bed(ground, {kAcross, {.width = 6, .depth = 2, .bank = 4}});
    EXPECT_TRUE(std::isnan(ground.heights(50, 50)));
    EXPECT_NEAR(ground.heights(39, 50), -2.0, 1e-5);
    EXPECT_NEAR(ground.heights(60, 50), -2.0, 1e-5);
    EXPECT_LT(report.length, 85.0);
}

TEST(RiverBed, RefusesBedsThatAreNone) {
    GroundLattice ground = plane(0.0);
    EXPECT_THAT(
        [&] {
            cut_bed(ground, {{{1, 1}}, {}});
        },
        ThrowsMessage<InvalidInput>(HasSubstr("has 1 points, must be 2 to 2000")));
    EXPECT_THAT(
        [&] {
            cut_bed(ground, {{{1, 1}, {std::nan(""), 2}}, {}});
        },
        ThrowsMessage<InvalidInput>(HasSubstr("a point that is no number")));
    EXPECT_THAT(
        [&] {
            cut_bed(ground, {{{500, 1}, {600, 2}}, {}});
        },
        ThrowsMessage<InvalidInput>(HasSubstr("from (500, 1) on, lies nowhere over")));
    EXPECT_THAT(
        [&] {
            cut_bed(ground, {kAcross, {.width = 0, .bank = 0}});
        },
        ThrowsMessage<InvalidInput>(HasSubstr("neither width nor banks")));
    EXPECT_THROW(cut_bed(ground, {kAcross, {.depth = -1}}), InvalidOption);
    EXPECT_NO_THROW(cut_bed(ground, {{{5, 5}, {5, 5}}, {}}));  // a pool
}

TEST(BedFile, HoldsLinesAndOptions) {
    const auto beds = beds_from_json(R"({"format": "scree-beds", "version": 1, "beds": [
        {"line": [[0, 1], [2.5, 3]], "width": 7, "depth": 2, "bank": 3, "profile": "round",
         "falling": false},
        {"line": [[612345.25, 5512345], [612400, 5512300], [612500, 5512300]]}]})",
                                     "beds.json");
    ASSERT_EQ(beds.size(), 2U);
    EXPECT_EQ(beds[0].line[1], glm::dvec2(2.5, 3));
    EXPECT_EQ(beds[0].options.width, 7.0);
    EXPECT_EQ(beds[0].options.profile, BedProfile::Round);
    EXPECT_FALSE(beds[0].options.falling);
    EXPECT_EQ(beds[1].line[0], glm::dvec2(612345.25, 5512345));
    EXPECT_EQ(beds[1].options.depth, BedOptions{}.depth);
}

TEST(BedFile, NamesWhatIsWrong) {
    const auto says = [](const char* beds, const char* words) {
        const std::string text =
            R"({"format": "scree-beds", "version": 1, "beds": [)" + std::string(beds) + "]}";
        EXPECT_THAT([&] { beds_from_json(text, "b.json"); },
                    ThrowsMessage<InvalidInput>(HasSubstr(words)));
    };
    says(R"({"line": [[0, 1]]})", "b.json: beds[0].line must have at least 2 points");
    says(R"({"line": [[0, 1], [0]]})", "beds[0].line[1] must have 2 entries");
    says(R"({"line": [[0, 1], [1, 1]], "widht": 3})", "widht");
    says(R"({"line": [[0, 1], [1, 1]], "depth": -3})", "beds[0].depth");
    says(R"({"line": [[0, 1], [1, 1e12]]})", "beds[0].line[1][1]");
    says(R"({"width": 3})", "line");
    EXPECT_THROW(beds_from_json("{", "b.json"), InvalidInput);
    EXPECT_THROW(beds_from_json(R"({"format": "scree-erosion", "version": 1})", "b.json"),
                 InvalidInput);
}

}  // namespace
}  // namespace scree
