#include "vision/classical/complete_field.h"

#include "base/error.h"

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

EdgeField boundary_only() {
    EdgeField field{FloatRaster(30, 20), {}, {}};
    for (int y = 0; y < 20; ++y)
        field.boundary(10, y) = 1;
    return field;
}

TEST(CompleteField, FillsWhatIsMissing) {
    EdgeField storage;
    const EdgeField& field = complete_field(Photo(30, 20), boundary_only(), storage);
    EXPECT_EQ(field.inside(10, 5), 0);
    EXPECT_EQ(field.inside(20, 5), 1);
    EXPECT_EQ(field.distance(10, 5), 0);
    EXPECT_LT(field.distance(12, 5), field.distance(25, 5));
    EXPECT_LE(field.distance(29, 5), 1);
}

TEST(CompleteField, LeavesAFullFieldAlone) {
    EdgeField storage, given = boundary_only();
    given.inside = given.distance = FloatRaster(30, 20, 0.5F);
    EXPECT_EQ(&complete_field(Photo(30, 20), given, storage), &given);
}

TEST(CompleteField, SizesMustAgree) {
    EdgeField storage, given = boundary_only();
    EXPECT_THAT([&] { complete_field(Photo(30, 21), given, storage); },
                testing::ThrowsMessage<InvalidInput>(
                    "the boundary channel is 30 x 20, must be 30 x 21 like the photograph"));
}

}  // namespace
}  // namespace scree::vision
