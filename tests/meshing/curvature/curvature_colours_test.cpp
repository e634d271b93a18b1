#include "meshing/curvature/curvature_colours.h"

#include <limits>

#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::curvature_colour;

TEST(CurvatureColours, RunFromBlueOverGreenToRed) {
    EXPECT_EQ(curvature_colour(-1.0F), glm::u8vec3(0, 0, 255));
    EXPECT_EQ(curvature_colour(0.0F), glm::u8vec3(0, 255, 0));
    EXPECT_EQ(curvature_colour(1.0F), glm::u8vec3(255, 0, 0));
    EXPECT_EQ(curvature_colour(0.5F), glm::u8vec3(128, 128, 0));
    EXPECT_EQ(curvature_colour(-7.0F), glm::u8vec3(0, 0, 255));
    EXPECT_EQ(curvature_colour(std::numeric_limits<float>::quiet_NaN()), glm::u8vec3(0, 255, 0));
}

TEST(CurvatureColours, ScaleEveryVertex) {
    const std::vector<float> curvature = {-2.0F, 0.0F, 2.0F};
    const auto colours = meshing::curvature_colours(curvature, 0.5F);
    ASSERT_EQ(colours.size(), 3U);
    EXPECT_EQ(colours[0], glm::u8vec3(0, 0, 255));
    EXPECT_EQ(colours[2], glm::u8vec3(255, 0, 0));
}

}  // namespace
}  // namespace scree
