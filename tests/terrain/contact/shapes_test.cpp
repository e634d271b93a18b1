#include "terrain/contact/shapes.h"

#include "base/error.h"
#include "meshing/mesh/bounds.h"
#include "terrain/contact/underside.h"
#include "tests/support/mesh_checks.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;

TEST(Shapes, AreClosedAndFaceOutwards) {
    for (const int rings : {3, 8, 48})
        test::expect_valid(sphere_mesh({.radius_m = 0.3, .rings = rings}));
    test::expect_valid(box_mesh({.size_m = {0.1, 0.5, 2}}));
    test::expect_valid(tyre_mesh({}));
    test::expect_valid(tyre_mesh({.tread_depth_m = 0, .segments = 16}));
    for (const bool left : {false, true})
        test::expect_valid(boot_mesh({.left = left}));
    test::expect_valid(boot_mesh({.lugs = 1, .segments = 16}));
}

TEST(Shapes, HaveTheirSize) {
    EXPECT_NEAR(meshing::signed_volume(sphere_mesh({.radius_m = 2, .rings = 200})),
                32.0 / 3 * std::numbers::pi, 0.02);
    EXPECT_NEAR(meshing::signed_volume(box_mesh({.size_m = {0.5, 2, 3}})), 3.0, 1e-6);
    const meshing::Box tyre = meshing::bounding_box(tyre_mesh({.radius_m = 0.4, .width_m = 0.2}));
    EXPECT_NEAR(tyre.max.y, 0.4, 0.004);
    EXPECT_NEAR(tyre.max.z, 0.108, 1e-6);  // the walls bulge beyond the tread
    const meshing::Box boot = meshing::bounding_box(boot_mesh({.length_m = 0.28, .width_m = 0.1}));
    EXPECT_NEAR(boot.max.x - boot.min.x, 0.28, 1e-6);
    EXPECT_NEAR(boot.max.z - boot.min.z, 0.1, 0.01);
    EXPECT_NEAR(boot.min.y, 0.0, 1e-6);
}

TEST(Shapes, ALeftBootMirrorsTheRightOne) {
    const auto right = boot_mesh({});
    const auto left = boot_mesh({.left = true});
    const auto box = meshing::bounding_box(right);
    const auto mirrored = meshing::bounding_box(left);
    EXPECT_NEAR(box.min.z, -mirrored.max.z, 1e-6);
    EXPECT_GT(std::abs(box.min.z + box.max.z), 1e-3);
}

// Grooves across the tread: a slick touches along its middle, a treaded tyre only with its lugs.
TEST(Shapes, TreadLeavesGrooves) {
    const CellGrid grid{{0, 0, 200, 100}, 0.005};
    const auto place = glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, 0.33, 0.25));
    const auto reach = [&](double depth) {
        const Underside under = underside_of(tyre_mesh({.tread_depth_m = depth}), place, grid);
        int cells = 0;
        for (const float height : under.heights)
            cells += height < 0.010F ? 1 : 0;
        return cells;
    };
    EXPECT_LT(reach(0.02), 0.75 * reach(0.0));
    EXPECT_GT(reach(0.02), 0.25 * reach(0.0));
}

TEST(ShapesErrors, NameTheValue) {
    EXPECT_THAT([] { sphere_mesh({.radius_m = -1}); },
                testing::ThrowsMessage<InvalidOption>(HasSubstr("radius_m is -1")));
    EXPECT_THAT(
        [] {
            box_mesh({.size_m = {1, 0, 1}});
        },
        testing::ThrowsMessage<InvalidOption>(HasSubstr("size_m holds 0")));
    EXPECT_THROW(tyre_mesh({.tread_depth_m = 0.2}), InvalidOption);
    EXPECT_THROW(tyre_mesh({.lugs = 0}), InvalidOption);
    EXPECT_THROW(boot_mesh({.lug_depth_m = 0.1}), InvalidOption);
    EXPECT_THROW(boot_mesh({.length_m = std::numeric_limits<double>::quiet_NaN()}), InvalidOption);
}

}  // namespace
}  // namespace scree::terrain
