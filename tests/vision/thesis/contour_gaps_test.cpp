#include "vision/thesis/contour_gaps.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree::vision {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

glm::dvec2 on_ellipse(double degrees) {
    return {50 * std::cos(degrees * kDegree), 35 * std::sin(degrees * kDegree)};
}

double ellipse_radius(double azimuth) {
    return 1.0 / std::hypot(std::cos(azimuth) / 50, std::sin(azimuth) / 35);
}

TEST(ContourGaps, EllipseGapIsFilledWithinThreePercent) {
    for (int from = 0; from < 360; from += 15)
        for (const int width : {12, 28, 44}) {
            const ContourGap gap{on_ellipse(from - 4), on_ellipse(from), on_ellipse(from + width),
                                 on_ellipse(from + width + 4)};
            const auto points = gap_points(gap, {0, 0}, {});
            ASSERT_EQ(points.size(), 5U);
            for (const glm::dvec2 p : points) {
                const double r = ellipse_radius(std::atan2(p.y, p.x));
                EXPECT_NEAR(glm::length(p), r, 0.03 * r) << from << " " << width;
            }
        }
}

TEST(ContourGaps, CurveLeavesAndArrivesAlongTheTangents) {
    const ContourGap gap{{0, 0}, {3, 0}, {9, 6}, {9, 8}};
    const auto curve = gap_curve(gap);
    const double third = std::sqrt(72.0) / 3.0;
    EXPECT_NEAR(curve[1].x, 3 + third, 1e-12);
    EXPECT_NEAR(curve[1].y, 0, 1e-12);
    EXPECT_NEAR(curve[2].x, 9, 1e-12);
    EXPECT_NEAR(curve[2].y, 6 - third, 1e-12);
}

// Tangents that point backwards make the plain curve loop; the guard goes round instead.
TEST(ContourGaps, GuardKeepsAzimuthRisingAndRadiiBounded) {
    const ContourGap gap{{12, 30}, {10, -1}, {10, 8}, {40, 60}};
    ThesisOptions options;
    const auto check_all = [&](const std::vector<glm::dvec2>& points) {
        double before = std::atan2(gap.last.y, gap.last.x);
        bool fine = true;
        for (const glm::dvec2 p : points) {
            const double azimuth = std::atan2(p.y, p.x);
            fine = fine && azimuth > before && glm::length(p) < 1.5 * 12.9 &&
                   glm::length(p) > 0.5 * 10;
            before = azimuth;
        }
        return fine;
    };
    EXPECT_TRUE(check_all(gap_points(gap, {0, 0}, options)));
    options.gap_fill = GapFill::PlainBezier;
    EXPECT_EQ(gap_points(gap, {0, 0}, options).size(), 5U);
    options.gap_fill = GapFill::Chord;
    EXPECT_TRUE(gap_points(gap, {0, 0}, options).empty());
}

TEST(ContourGaps, AngleCountsOnwardsPastTheSeam) {
    const ContourGap gap{{}, on_ellipse(350), on_ellipse(10), {}};
    EXPECT_LT(gap_angle(gap, {0, 0}), 20 * kDegree);
    const ContourGap wide{{}, on_ellipse(10), on_ellipse(350), {}};
    EXPECT_GT(gap_angle(wide, {0, 0}), 330 * kDegree);
}

}  // namespace
}  // namespace scree::vision
