#include "vision/outline.h"

#include "base/error.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

Outline disc(double x, double y, float radius) {
    Outline outline;
    outline.centre = {x, y};
    outline.radii.fill(radius);
    outline.confidence = 1.0F;
    return outline;
}

int count(const LabelMap& labels, int label) {
    return static_cast<int>(std::count(labels.begin(), labels.end(), label));
}

TEST(Outline, DiscHasItsAreaAndDiameter) {
    const Outline outline = disc(50, 40, 20);
    EXPECT_NEAR(outline_area(outline), std::numbers::pi * 400, 0.1);
    EXPECT_NEAR(equivalent_diameter(outline), 40, 0.01);
    EXPECT_NEAR(radius_at(outline, -3.7), 20, 1e-6);
}

TEST(Outline, RadiusIsInterpolatedAcrossTheSeam) {
    Outline outline = disc(0, 0, 10);
    outline.radii[0] = 12;
    const double half_degree = std::numbers::pi / 360.0;
    EXPECT_NEAR(radius_at(outline, half_degree), 11, 1e-6);
    EXPECT_NEAR(radius_at(outline, -half_degree), 11, 1e-6);
}

TEST(PaintLabels, PixelCountMatchesTheArea) {
    const auto labels = paint_labels({disc(50.3, 40.7, 20)}, 100, 80);
    EXPECT_NEAR(count(labels, 1), std::numbers::pi * 400, 12);
}

TEST(PaintLabels, EarlierOutlineKeepsTheOverlap) {
    const auto labels = paint_labels({disc(40, 40, 15), disc(50, 40, 15)}, 100, 80);
    EXPECT_EQ(labels(45, 40), 1);
    EXPECT_EQ(labels(60, 40), 2);
}

TEST(PaintLabels, OutlinesBeyondThePictureAreCut) {
    const auto labels = paint_labels({disc(0, 0, 10), disc(500, 500, 10)}, 30, 30);
    EXPECT_NEAR(count(labels, 1), std::numbers::pi * 25, 6);
    EXPECT_EQ(count(labels, 2), 0);
}

TEST(PaintLabels, RefusesBadOutlines) {
    Outline bad = disc(5, 5, 3);
    bad.radii[7] = -1;
    EXPECT_THROW(paint_labels({bad}, 10, 10), InvalidInput);
    EXPECT_THROW(paint_labels(std::vector<Outline>(65536, disc(1, 1, 1)), 2, 2), InvalidInput);
}

}  // namespace
}  // namespace scree::vision
