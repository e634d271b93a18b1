#include "vision/classical/candidate_outline_finder.h"

#include "base/error.h"
#include "base/parallel.h"
#include "testdata/synthetic_photo.h"
#include "vision/classical/classical_edge_detector.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

std::vector<Outline> rocks_of(const Photo& photo, const CandidateOptions& options = {}) {
    return CandidateOutlineFinder(options).find(photo, ClassicalEdgeDetector().detect(photo));
}

double overlap(const LabelMap& a, std::uint16_t i, const LabelMap& b, std::uint16_t k) {
    double both = 0, either = 0;
    for (std::size_t p = 0; p < a.size(); ++p) {
        both += a.data()[p] == i && b.data()[p] == k ? 1 : 0;
        either += a.data()[p] == i || b.data()[p] == k ? 1 : 0;
    }
    return either > 0 ? both / either : 0;
}

// Bright discs on dark ground, with a little shading and noise.
Photo discs(std::vector<Outline>& truth) {
    Photo photo(420, 320, {38, 36, 34});
    unsigned state = 7;
    for (auto& c : photo)
        c = glm::u8vec3(c + glm::u8vec3(static_cast<std::uint8_t>(
                                (state = state * 1664525U + 1013904223U) >> 30U)));
    for (const auto& [x, y, r] : {std::tuple{60.0, 60.0, 34.0},
                                  {150.0, 58.0, 22.0},
                                  {235.0, 70.0, 40.0},
                                  {350.0, 80.0, 55.0},
                                  {80.0, 190.0, 60.0},
                                  {190.0, 170.0, 26.0},
                                  {280.0, 215.0, 48.0},
                                  {170.0, 265.0, 18.0},
                                  {370.0, 250.0, 30.0}}) {
        Outline o;
        o.centre = {x, y};
        o.radii.fill(static_cast<float>(r));
        truth.push_back(o);
        for (int v = 0; v < photo.height(); ++v)
            for (int u = 0; u < photo.width(); ++u) {
                const double d = std::hypot(u + 0.5 - x, v + 0.5 - y);
                const double cover = std::clamp(r + 0.5 - d, 0.0, 1.0);
                const double light = 150 + 40 * (x - u) / r;
                const glm::dvec3 colour = glm::dvec3(1.0, 0.95, 0.85) * light;
                photo(u, v) = glm::u8vec3(glm::dvec3(photo(u, v)) * (1 - cover) + colour * cover);
            }
    }
    return photo;
}

TEST(CandidateOutlineFinder, FindsBrightDiscsWithDarkGaps) {
    std::vector<Outline> truth;
    const Photo photo = discs(truth);
    const auto found = rocks_of(photo);
    const LabelMap a = paint_labels(truth, photo.width(), photo.height());
    const LabelMap b = paint_labels(found, photo.width(), photo.height());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const auto label =
            b(static_cast<int>(truth[i].centre.x), static_cast<int>(truth[i].centre.y));
        EXPECT_GT(overlap(a, static_cast<std::uint16_t>(i + 1), b, label), 0.9) << "disc " << i;
    }
}

TEST(CandidateOutlineFinder, BlankPicturesHoldNoRock) {
    for (const std::uint8_t level : std::initializer_list<std::uint8_t>{0, 1, 128, 254, 255})
        EXPECT_TRUE(rocks_of(Photo(200, 150, glm::u8vec3(level))).empty()) << int{level};
    Photo ramp(256, 200), diagonal(300, 300);
    for (int y = 0; y < 300; ++y)
        for (int x = 0; x < 300; ++x) {
            if (ramp.contains(x, y))
                ramp(x, y) = glm::u8vec3(static_cast<std::uint8_t>(x));
            diagonal(x, y) = glm::u8vec3((x + y) / 3, (x + y) / 4, y / 2);
        }
    EXPECT_TRUE(rocks_of(ramp).empty());
    EXPECT_TRUE(rocks_of(diagonal).empty());
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 500}, {500, 1}, {2, 2}})
        EXPECT_TRUE(rocks_of(Photo(w, h, {200, 10, 10})).empty());
}

TEST(CandidateOutlineFinder, MinSizeIsHonest) {
    const auto made = test::make_synthetic_photo(
        {.width = 500, .height = 400, .n_rocks = 200, .least_diameter = 8, .median_diameter = 20});
    std::size_t before = 100000;
    for (const double size : {6.0, 12.0, 25.0, 45.0}) {
        const auto found = rocks_of(made.photo, {.min_size = size});
        EXPECT_FALSE(found.empty());
        EXPECT_LT(found.size(), before);
        before = found.size();
        for (const auto& o : found)
            EXPECT_GE(equivalent_diameter(o), size);
    }
}

TEST(CandidateOutlineFinder, SameRocksForAnyThreadCount) {
    const auto made = test::make_synthetic_photo({.width = 400, .height = 300, .n_rocks = 100});
    std::vector<Outline> found[2];
    for (const int threads : {1, 4}) {
        const ThreadLimit limit(threads);
        found[threads / 4] = rocks_of(made.photo);
    }
    ASSERT_EQ(found[0].size(), found[1].size());
    for (std::size_t i = 0; i < found[0].size(); ++i) {
        EXPECT_EQ(found[0][i].centre, found[1][i].centre);
        EXPECT_EQ(found[0][i].radii, found[1][i].radii);
        EXPECT_EQ(found[0][i].confidence, found[1][i].confidence);
    }
}

TEST(CandidateOutlineFinder, CroppingTwoRowsChangesNothingElsewhere) {
    const auto made = test::make_synthetic_photo({.width = 600, .height = 450, .n_rocks = 220});
    Photo cropped(600, 448);
    std::copy(made.photo.row(2), made.photo.row(2) + cropped.size(), cropped.begin());
    const auto before = rocks_of(made.photo);
    auto after = rocks_of(cropped);
    for (auto& o : after)
        o.centre.y += 2;
    const LabelMap a = paint_labels(before, 600, 450), b = paint_labels(after, 600, 450);
    int kept = 0, all = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const Outline& o = before[i];
        if (o.centre.y - *std::ranges::max_element(o.radii) < 40)
            continue;
        std::map<int, int> votes;
        for (std::size_t p = 0; p < a.size(); ++p)
            if (a.data()[p] == i + 1)
                ++votes[b.data()[p]];
        double best = 0;
        for (const auto& vote : votes)
            if (vote.first > 0)
                best = std::max(best, overlap(a, static_cast<std::uint16_t>(i + 1), b,
                                              static_cast<std::uint16_t>(vote.first)));
        kept += best > 0.9 ? 1 : 0;
        ++all;
    }
    EXPECT_GT(all, 50);
    EXPECT_GE(kept, 0.95 * all);
}

TEST(CandidateOutlineFinder, ReadsAFieldThatItDidNotMake) {
    const auto made = test::make_synthetic_photo(
        {.width = 400, .height = 300, .n_rocks = 60, .whole_rocks = true});
    EdgeField field{FloatRaster(400, 300), FloatRaster(400, 300), FloatRaster(400, 300)};
    for (const auto& o : made.outlines)
        for (int y = 0; y < 300; ++y)
            for (int x = 0; x < 400; ++x) {
                const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - o.centre;
                const double away = radius_at(o, std::atan2(d.y, d.x)) - std::hypot(d.x, d.y);
                const float edge = static_cast<float>(std::exp(-0.5 * away * away));
                field.boundary(x, y) = std::max(field.boundary(x, y), edge);
                if (away > 0) {
                    field.inside(x, y) = 1;
                    field.distance(x, y) = static_cast<float>(
                        std::min(1.0, away / *std::ranges::min_element(o.radii)));
                }
            }
    const auto found = CandidateOutlineFinder().find(made.photo, field);
    const LabelMap labels = paint_labels(found, 400, 300);
    int hits = 0;
    for (std::size_t i = 0; i < made.outlines.size(); ++i) {
        const glm::dvec2 c = made.outlines[i].centre;
        const auto label = labels.contains(static_cast<int>(c.x), static_cast<int>(c.y))
                               ? labels(static_cast<int>(c.x), static_cast<int>(c.y))
                               : std::uint16_t{0};
        hits += label > 0 &&
                overlap(made.labels, static_cast<std::uint16_t>(i + 1), labels, label) > 0.8;
    }
    EXPECT_GE(hits, 0.9 * static_cast<double>(made.outlines.size()));
}

TEST(CandidateOutlineFinder, ConfidenceFalls) {
    const auto made = test::make_synthetic_photo({.width = 300, .height = 200, .n_rocks = 60});
    const auto found = rocks_of(made.photo);
    EXPECT_TRUE(std::ranges::is_sorted(found, std::ranges::greater(), &Outline::confidence));
}

TEST(CandidateOutlineFinderErrors, NameTheValueAndTheRange) {
    EXPECT_THAT([] { CandidateOutlineFinder({.min_size = 1}); },
                testing::ThrowsMessage<InvalidOption>("min-size is 1, must be in [3, 10000] px"));
    EXPECT_THAT([] { CandidateOutlineFinder().find(Photo(4, 4), {}); },
                testing::ThrowsMessage<InvalidInput>(
                    "the boundary channel is 0 x 0, must be 4 x 4 like the photograph"));
}

}  // namespace
}  // namespace scree::vision
