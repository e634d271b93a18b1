#include "meshing/curvature/curvature_scale.h"

#include "base/error.h"
#include "tests/support/mesh_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::CurvatureScale;
using meshing::UnsignedScale;

TEST(SignedScale, LeavesSmallCurvatureAlone) {
    EXPECT_EQ(meshing::signed_factor(0.9F, CurvatureScale::DownscaleOnly), 1.0F);
    EXPECT_EQ(meshing::signed_factor(1.0F, CurvatureScale::DownscaleOnly), 1.0F);
    EXPECT_EQ(meshing::signed_factor(4.0F, CurvatureScale::DownscaleOnly), 0.25F);
}

TEST(SignedScale, StretchesOnlyAboveTheFloor) {
    EXPECT_EQ(meshing::signed_factor(0.5F, CurvatureScale::Always, 0.1F), 2.0F);
    EXPECT_EQ(meshing::signed_factor(0.05F, CurvatureScale::Always, 0.1F), 1.0F);
}

TEST(SignedScale, KeepsZeroAndTheRange) {
    EXPECT_EQ(meshing::scale_signed(0.0F, 0.25F), 0.0F);
    EXPECT_EQ(meshing::scale_signed(-4.0F, 0.25F), -1.0F);
    EXPECT_EQ(meshing::scale_signed(9.0F, 0.25F), 1.0F);
}

TEST(UnsignedScale, MapsTheWholeRange) {
    const std::vector<float> curvature = {-1.0F, 0.0F, 3.0F};
    EXPECT_THAT(meshing::scale_unsigned(curvature, {-1.0F, 3.0F}, UnsignedScale::MinMax),
                testing::ElementsAre(0.0F, 0.25F, 1.0F));
    EXPECT_THAT(meshing::scale_unsigned(curvature, {-1.0F, 3.0F}),
                testing::ElementsAre(0.0F, 0.25F, 1.0F));
}

TEST(UnsignedScale, LetsFlatsOfAConvexBodyMove) {
    const std::vector<float> curvature = {0.0F, 4.0F};
    EXPECT_THAT(meshing::scale_unsigned(curvature, {0.0F, 4.0F}), testing::ElementsAre(0.5F, 1.0F));
    EXPECT_THAT(meshing::scale_unsigned(curvature, {0.0F, 4.0F}, UnsignedScale::MinMax),
                testing::ElementsAre(0.0F, 1.0F));
}

TEST(UnsignedScale, IsAHalfWhereNothingDiffers) {
    EXPECT_THAT(meshing::scale_unsigned(std::vector<float>{2.0F, 2.0F}, {2.0F, 2.0F},
                                        UnsignedScale::MinMax),
                testing::Each(0.5F));
    EXPECT_THAT(meshing::scale_unsigned(std::vector<float>{0.0F, 0.0F}, {0.0F, 0.0F}),
                testing::Each(0.5F));
}

TEST(CurvatureRange, LeavesOutTheRim) {
    const auto adjacency = meshing::build_adjacency(test::sheet(2));  // vertex 4 is inside
    std::vector<float> curvature(9, 100.0F);
    curvature[4] = -2.0F;
    const auto range = meshing::curvature_range(curvature, adjacency);
    EXPECT_EQ(range.low, -2.0F);
    EXPECT_EQ(range.high, -2.0F);
    EXPECT_EQ(range.greatest(), 2.0F);
    EXPECT_EQ(meshing::curvature_quantile(curvature, adjacency, 1.0), 2.0F);
}

TEST(CurvatureRange, CountsTheQuantile) {
    const auto adjacency = meshing::build_adjacency(test::icosphere(0));
    std::vector<float> curvature;
    for (int i = 0; i < 12; ++i)
        curvature.push_back(static_cast<float>(i % 2 == 0 ? i : -i));
    EXPECT_EQ(meshing::curvature_quantile(curvature, adjacency, 0.0), 0.0F);
    EXPECT_EQ(meshing::curvature_quantile(curvature, adjacency, 10.0 / 11.0), 10.0F);
    EXPECT_THAT([&] { meshing::curvature_quantile(curvature, adjacency, 1.5); },
                testing::ThrowsMessage<InvalidInput>("the quantile is 1.5, must be in [0, 1]"));
}

}  // namespace
}  // namespace scree
