#include "vision/classify/confusion.h"

#include "base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::vision {
namespace {

using Classes = Raster<std::uint8_t>;

// Truth: 3 sand, 1 mud. Found: 2 sand, 1 grass; mud called sand.
ConfusionMatrix small() {
    Classes truth(4, 1);
    Classes found(4, 1);
    truth(3, 0) = 1;
    found(2, 0) = 4;
    ConfusionMatrix matrix;
    add_to_confusion(matrix, truth, found);
    return matrix;
}

TEST(Confusion, CountsByHand) {
    const ConfusionMatrix matrix = small();
    EXPECT_EQ(matrix.counts[0][0], 2);
    EXPECT_EQ(matrix.counts[0][4], 1);
    EXPECT_EQ(matrix.counts[1][0], 1);
    EXPECT_DOUBLE_EQ(accuracy(matrix), 0.5);
    EXPECT_DOUBLE_EQ(recall(matrix, GroundClass::Sand), 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(precision(matrix, GroundClass::Sand), 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(recall(matrix, GroundClass::Rock), 0.0);
    EXPECT_DOUBLE_EQ(mean_overlap(matrix), 0.5 * (2.0 / 4.0 + 0.0));
}

TEST(Confusion, AddsPicturesUp) {
    ConfusionMatrix matrix = small();
    add_to_confusion(matrix, Classes(6, 1, 2), Classes(6, 1, 2));
    EXPECT_DOUBLE_EQ(accuracy(matrix), 0.8);
}

TEST(Confusion, IsShownWithRowsOfTruth) {
    const std::string table = confusion_table(small());
    EXPECT_THAT(table, testing::HasSubstr("| sand | 66.7 | 0.0 | 0.0 | 0.0 | 33.3 | 66.7 |"));
    EXPECT_THAT(table, testing::HasSubstr("right: 50.0 %"));
}

TEST(ConfusionErrors, NameTheSizeAndTheClass) {
    ConfusionMatrix matrix;
    EXPECT_THAT([&] { add_to_confusion(matrix, Classes(2, 2), Classes(2, 3)); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("2 x 3")));
    EXPECT_THAT([&] { add_to_confusion(matrix, Classes(2, 2), Classes(2, 2, 5)); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("class 5")));
}

}  // namespace
}  // namespace scree::vision
