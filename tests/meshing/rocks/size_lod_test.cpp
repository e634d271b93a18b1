#include "meshing/rocks/size_lod.h"

#include "base/error.h"

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

TEST(SizeLod, GivesThePublishedSegments) {
    EXPECT_EQ(segments_for_size(30, 0.0), 3);
    EXPECT_EQ(segments_for_size(30, 1e-9), 3);
    EXPECT_EQ(segments_for_size(30, 0.1), 5);
    EXPECT_EQ(segments_for_size(30, 0.25), 9);
    EXPECT_EQ(segments_for_size(30, 0.5), 16);
    EXPECT_EQ(segments_for_size(30, 0.75), 23);
    EXPECT_EQ(segments_for_size(30, 0.99), 29);
    EXPECT_EQ(segments_for_size(30, 1.0), 30);
}

TEST(SizeLod, ShareFollowsThePublishedCurve) {
    EXPECT_DOUBLE_EQ(segment_share(30, 0.0), 0.1);
    EXPECT_NEAR(segment_share(30, 0.5), 0.5333, 1e-4);
    EXPECT_DOUBLE_EQ(segment_share(30, 1.0), 1.0);
    for (int i = 1; i <= 100; ++i)
        EXPECT_GE(segment_share(30, i / 100.0), segment_share(30, (i - 1) / 100.0));
}

TEST(SizeLod, LinksRingsToSegments) {
    EXPECT_EQ(rings_for_segments(3), 2);
    EXPECT_EQ(rings_for_segments(8), 5);
    EXPECT_EQ(rings_for_segments(30), 16);
}

TEST(SizeLod, NamesTheValueAndTheRange) {
    EXPECT_THAT([] { segments_for_size(30, 1.5); },
                testing::ThrowsMessage<InvalidOption>("share is 1.5, must be in [0, 1]"));
    EXPECT_THROW(segments_for_size(2, 0.5), InvalidOption);
    EXPECT_THROW(segments_for_size(30, 0.5, 2), InvalidOption);
    EXPECT_THROW(rings_for_segments(2), InvalidOption);
}

}  // namespace
}  // namespace scree::meshing
