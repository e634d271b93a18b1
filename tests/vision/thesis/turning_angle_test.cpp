#include "vision/thesis/turning_angle.h"

#include "base/random.h"
#include "vision/thesis/polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Contour {
    std::vector<glm::dvec2> hits;
    std::vector<std::uint8_t> escaped;
};

// 90 rays on a lobed shape, jittered, with one or two escapes, as A.7 describes its check.
Contour lobed_contour(std::uint64_t seed) {
    Rng rng({.seed = seed, .stream = 1});
    const double radius = rng.uniform(20, 60);
    const double lobe = rng.uniform(0.05, 0.15);
    const double phase = rng.uniform(0, 6.28);
    Contour contour;
    const int n_gaps = 1 + static_cast<int>(rng.below(2));
    const double width = rng.uniform(8, 30);
    const double first = rng.uniform(0, 360);
    const double escape = rng.uniform(1.5, 2.6);
    for (int l = 0; l < 90; ++l) {
        const double degrees = 4.0 * l;
        bool out = false;
        for (int g = 0; g < n_gaps; ++g) {
            const double offset = std::fmod(degrees - first - 140.0 * g + 720.0, 360.0);
            out = out || offset < width;
        }
        const double a = degrees * kDegree;
        double r = radius * (1.0 + lobe * std::cos(2 * a + phase) + 0.04 * std::cos(3 * a));
        r += rng.uniform(-0.5, 0.5);
        if (out)
            r *= escape;
        contour.hits.emplace_back(r * std::cos(a), r * std::sin(a));
        contour.escaped.push_back(out ? 1 : 0);
    }
    return contour;
}

struct Rates {
    double recall = 0.0;
    double good_deleted = 0.0;
};

Rates rates_of(TurnRule rule) {
    ThesisOptions options;
    options.turn_rule = rule;
    double n_out = 0;
    double n_out_deleted = 0;
    double n_good = 0;
    double n_good_deleted = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Contour contour = lobed_contour(seed);
        const auto filtered = filter_outliers(contour.hits, options);
        EXPECT_TRUE(filtered.accepted);
        EXPECT_GE(filtered.n_kept, 10);
        for (std::size_t i = 0; i < contour.hits.size(); ++i) {
            (contour.escaped[i] != 0 ? n_out : n_good) += 1;
            if (filtered.kept[i] == 0)
                (contour.escaped[i] != 0 ? n_out_deleted : n_good_deleted) += 1;
        }
    }
    return {n_out_deleted / n_out, n_good_deleted / n_good};
}

// The table of A.7: same ranges, on our own shapes.
TEST(TurningAngle, SignedOutwardFindsTheEscapesAndKeepsTheContour) {
    const Rates rates = rates_of(TurnRule::SignedOutward);
    EXPECT_GE(rates.recall, 0.9);
    EXPECT_LE(rates.good_deleted, 0.1);
}

TEST(TurningAngle, UnsignedAndAsPrintedFindsAlmostNothing) {
    const Rates rates = rates_of(TurnRule::UnsignedAnd);
    EXPECT_LE(rates.recall, 0.1);
    EXPECT_LE(rates.good_deleted, 0.02);
}

TEST(TurningAngle, UnsignedOrStripsSmoothContours) {
    const Rates rates = rates_of(TurnRule::UnsignedOr);
    EXPECT_GE(rates.recall, 0.4);
    EXPECT_GE(rates.good_deleted, 0.5);
}

TEST(TurningAngle, SignedInwardKeepsTheEscapes) {
    const Rates rates = rates_of(TurnRule::SignedInward);
    EXPECT_LE(rates.recall, 0.25);
}

TEST(TurningAngle, CosineOnlyFindsEscapesButDeletesMore) {
    const Rates rates = rates_of(TurnRule::CosineOnly);
    EXPECT_GE(rates.recall, 0.9);
    EXPECT_GT(rates.good_deleted, rates_of(TurnRule::SignedOutward).good_deleted);
}

TEST(TurningAngle, CriticalSeverityIsTheEdgeOfBothInequalities) {
    Rng rng({.seed = 8});
    ThesisOptions o;
    for (int i = 0; i < 500; ++i) {
        const double turn = rng.uniform(-std::numbers::pi, std::numbers::pi);
        const double severity = rng.uniform();
        const glm::dvec2 after{1 + std::cos(turn), std::sin(turn)};
        const double c = std::cos(turn);
        const double s = std::sin(turn);
        const bool cosine = c < o.cosine_factor * severity;
        const double b = o.sine_factor * severity;
        for (const auto& [rule, outlier] :
             {std::pair(TurnRule::SignedOutward, cosine && -s < b),
              std::pair(TurnRule::SignedInward, cosine && s < b),
              std::pair(TurnRule::UnsignedAnd, cosine && std::abs(s) < b),
              std::pair(TurnRule::UnsignedOr, cosine || std::abs(s) < b),
              std::pair(TurnRule::CosineOnly, cosine), std::pair(TurnRule::Off, false)}) {
            o.turn_rule = rule;
            EXPECT_EQ(critical_severity({0, 0}, {1, 0}, after, o) < severity, outlier) << turn;
        }
    }
}

std::vector<glm::dvec2> ray_polygon(const std::vector<glm::dvec2>& corners, int n_rays) {
    const auto centre = area_centroid(corners);
    std::vector<glm::dvec2> hits;
    for (int l = 0; l < n_rays; ++l) {
        const double a = 2 * std::numbers::pi * l / n_rays;
        const glm::dvec2 d{std::cos(a), std::sin(a)};
        double best = 1e9;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 p = corners[i] - centre;
            const glm::dvec2 e = corners[(i + 1) % corners.size()] - corners[i];
            const double det = d.x * e.y - d.y * e.x;
            const double t = (p.x * e.y - p.y * e.x) / det;
            const double u = (p.x * d.y - p.y * d.x) / det;
            if (t > 0 && u >= -1e-9 && u <= 1 + 1e-9)
                best = std::min(best, t);
        }
        hits.push_back(centre + best * d);
    }
    return hits;
}

double area_kept(const std::vector<glm::dvec2>& hits, const FilteredPolygon& filtered) {
    std::vector<glm::dvec2> kept;
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (filtered.kept[i] != 0)
            kept.push_back(hits[i]);
    return std::abs(signed_area(kept)) / std::abs(signed_area(hits));
}

std::vector<glm::dvec2> regular_polygon(int n_corners, double turn) {
    std::vector<glm::dvec2> corners;
    for (int k = 0; k < n_corners; ++k) {
        const double a = turn + 2 * std::numbers::pi * k / n_corners;
        corners.emplace_back(60 * std::cos(a), 60 * std::sin(a));
    }
    return corners;
}

TEST(Schedule, TriangleLandsNearSeverity076AndLosesItsCorners) {
    for (int i = 0; i < 24; ++i) {
        const auto hits = ray_polygon(regular_polygon(3, (5.0 * i + 0.7) * kDegree), 90);
        const auto filtered = filter_outliers(hits, {});
        ASSERT_TRUE(filtered.accepted);
        EXPECT_NEAR(filtered.severity, 0.76, 0.03);
        EXPECT_GE(filtered.n_kept, 10);
        EXPECT_LT(area_kept(hits, filtered), 0.75);
    }
}

// Without the curves that fill the corners again.
TEST(Schedule, SquareKeepsItsArea) {
    for (int i = 0; i < 18; ++i) {
        const auto hits = ray_polygon(regular_polygon(4, 5.0 * i * kDegree), 90);
        const auto filtered = filter_outliers(hits, {});
        ASSERT_TRUE(filtered.accepted);
        EXPECT_GE(area_kept(hits, filtered), 0.93);
    }
}

TEST(Schedule, LeapingEqualsTryingEverySeverity) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Rng rng({.seed = seed, .stream = 2});
        std::vector<glm::dvec2> hits;
        const int n = 12 + static_cast<int>(rng.below(60));
        for (int l = 0; l < n; ++l) {
            const double a = 2 * std::numbers::pi * l / n;
            hits.push_back(rng.uniform(5, 30) * glm::dvec2(std::cos(a), std::sin(a)));
        }
        const auto filtered = filter_outliers(hits, {});
        bool found = false;
        for (int step = 0; step <= 100 && !found; ++step) {
            const auto kept = peeled(hits, 1.0 - 0.01 * step, {});
            if (std::count(kept.begin(), kept.end(), 1) < 10)
                continue;
            found = true;
            EXPECT_EQ(kept, filtered.kept);
            EXPECT_DOUBLE_EQ(filtered.severity, 1.0 - 0.01 * step);
        }
        EXPECT_EQ(found, filtered.accepted);
    }
}

TEST(Schedule, NeverReturnsFewerThanTheMinimumInEitherForm) {
    for (const auto schedule : {SeveritySchedule::Restart, SeveritySchedule::Cumulative})
        for (const auto rule : {TurnRule::SignedOutward, TurnRule::UnsignedOr}) {
            ThesisOptions options;
            options.schedule = schedule;
            options.turn_rule = rule;
            for (std::uint64_t seed = 0; seed < 30; ++seed) {
                const auto filtered = filter_outliers(lobed_contour(seed).hits, options);
                EXPECT_TRUE(!filtered.accepted || filtered.n_kept >= 10);
            }
        }
    EXPECT_FALSE(filter_outliers(std::vector<glm::dvec2>(9, glm::dvec2(0)), {}).accepted);
    EXPECT_FALSE(filter_outliers({}, {}).accepted);
}

TEST(TurningAngle, CoincidentVerticesAreHarmless) {
    auto hits = lobed_contour(3).hits;
    hits.insert(hits.begin() + 20, hits[20]);
    hits.insert(hits.begin() + 20, hits[20]);
    const auto kept = peeled(hits, 1.0, {});
    EXPECT_GT(std::count(kept.begin(), kept.end(), 1), 60);
    EXPECT_EQ(kept[20] + kept[21] + kept[22], 1);
}

}  // namespace
}  // namespace scree::vision
