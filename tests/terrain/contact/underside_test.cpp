#include "terrain/contact/underside.h"

#include "base/error.h"
#include "base/random.h"
#include "terrain/contact/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using meshing::TriMesh;
using testing::HasSubstr;

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr CellGrid kGrid{{0, 0, 40, 30}, 0.1};

glm::dmat4 moved(double x, double y, double z) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

// Height of the lowest crossing of a vertical line with a mesh, every triangle asked.
float lowest_crossing(const TriMesh& mesh, const glm::dmat4& place, double x, double z) {
    float lowest = kNone;
    for (const glm::uvec3& t : mesh.triangles) {
        glm::dvec3 p[3];
        for (int k = 0; k < 3; ++k)
            p[k] = glm::dvec3(place * glm::dvec4(glm::dvec3(mesh.positions[t[k]]), 1.0));
        const double area =
            (p[1].x - p[0].x) * (p[2].z - p[0].z) - (p[2].x - p[0].x) * (p[1].z - p[0].z);
        if (std::abs(area) < 1e-14)
            continue;
        const double v =
            ((x - p[0].x) * (p[2].z - p[0].z) - (p[2].x - p[0].x) * (z - p[0].z)) / area;
        const double w =
            ((p[1].x - p[0].x) * (z - p[0].z) - (x - p[0].x) * (p[1].z - p[0].z)) / area;
        if (v >= 0 && w >= 0 && v + w <= 1)
            lowest = std::min(
                lowest, static_cast<float>(p[0].y + v * (p[1].y - p[0].y) + w * (p[2].y - p[0].y)));
    }
    return lowest;
}

TEST(Underside, OfAMeshedSphereIsTheClosedForm) {
    const double radius = 0.9;
    const auto mesh = sphere_mesh({.radius_m = radius, .rings = 256});
    const glm::dvec3 centre(1.93, 1.4, 1.52);
    const Underside exact = underside_of_sphere(centre, radius, kGrid);
    const Underside seen = underside_of(mesh, moved(centre.x, centre.y, centre.z), kGrid);
    ASSERT_EQ(seen.window, exact.window);
    for (int y = 0; y < exact.window.height; ++y)
        for (int x = 0; x < exact.window.width; ++x) {
            const double away = std::hypot((exact.window.x + x + 0.5) * 0.1 - centre.x,
                                           (exact.window.y + y + 0.5) * 0.1 - centre.z);
            if (away < 0.97 * radius) {
                EXPECT_NEAR(seen.heights(x, y), exact.heights(x, y), 1e-3 * radius);
            }
            if (away > radius) {
                EXPECT_EQ(seen.heights(x, y), kNone);
                EXPECT_EQ(exact.heights(x, y), kNone);
            }
        }
    EXPECT_EQ(exact.heights(exact.window.width / 2, exact.window.height / 2),
              *std::min_element(exact.heights.begin(), exact.heights.end()));
}

class UndersideOfSoup : public testing::TestWithParam<unsigned> {};  // the parameter is a seed

TEST_P(UndersideOfSoup, IsTheLowestCrossingOverEveryCentre) {
    Rng rng({.seed = GetParam(), .stream = 7});
    TriMesh mesh;
    for (unsigned i = 0; i < 60; ++i) {
        const glm::dvec3 at(rng.uniform(-2, 2), rng.uniform(-1, 1), rng.uniform(-2, 2));
        for (int k = 0; k < 3; ++k)
            mesh.positions.emplace_back(
                at + glm::dvec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)));
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    mesh.triangles.emplace_back(0U, 0U, 5U);  // no area
    const glm::dmat4 place =
        glm::rotate(moved(1.5, 0.3, 1.2), rng.uniform(0.0, 6.0), glm::dvec3(0.3, 1.0, 0.2));
    const Underside seen = underside_of(mesh, place, kGrid);
    EXPECT_EQ(seen.window, kGrid.extent);  // larger than the ground: clipped to it
    int covered = 0;
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            const float expected = lowest_crossing(mesh, place, 0.1 * x + 0.05, 0.1 * y + 0.05);
            covered += expected < kNone ? 1 : 0;
            if (expected == kNone)
                EXPECT_EQ(seen.heights(x, y), kNone) << x << ", " << y;
            else
                EXPECT_NEAR(seen.heights(x, y), expected, 1e-6) << x << ", " << y;
        }
    EXPECT_EQ(seen.covered, covered);
}
INSTANTIATE_TEST_SUITE_P(Seeds, UndersideOfSoup, testing::Range(0U, 6U));

// A table: a top on four legs, open below. Under the top its bottom counts, under a leg the leg's.
TEST(Underside, SeesHollowUndersidesAndHoles) {
    TriMesh table = box_mesh({.size_m = {2.0, 0.2, 2.0}});
    const TriMesh leg = box_mesh({.size_m = {0.4, 1.0, 0.4}});
    for (const glm::vec3 at :
         {glm::vec3(-0.8, -0.6, -0.8), {0.8, -0.6, -0.8}, {-0.8, -0.6, 0.8}, {0.8, -0.6, 0.8}}) {
        const auto first = static_cast<unsigned>(table.positions.size());
        for (const glm::vec3& p : leg.positions)
            table.positions.push_back(p + at);
        for (const glm::uvec3& t : leg.triangles)
            table.triangles.push_back(t + first);
    }
    Underside seen = underside_of(table, moved(2.0, 2.0, 1.5), kGrid);
    EXPECT_EQ(seen.window, (CellWindow{10, 5, 21, 21}));
    EXPECT_NEAR(seen.heights(10, 10), 1.9F, 1e-6F);  // the hollow
    EXPECT_NEAR(seen.heights(1, 1), 0.9F, 1e-6F);    // a leg
    EXPECT_EQ(seen.heights(20, 20), kNone);          // touched, but its centre is beyond the edge
    // Without its underside the top is open, and what is seen through the hole is its upper face.
    std::erase_if(table.triangles, [&](const glm::uvec3& t) {
        return t.x < 8 && std::max({table.positions[t.x].y, table.positions[t.y].y,
                                    table.positions[t.z].y}) < 0.0F;
    });
    seen = underside_of(table, moved(2.0, 2.0, 1.5), kGrid);
    EXPECT_NEAR(seen.heights(10, 10), 2.1F, 1e-6F);
}

TEST(Underside, ShowsNothingOutsideTheGround) {
    const auto ball = sphere_mesh({.radius_m = 0.5, .rings = 8});
    const Underside away = underside_of(ball, moved(-3, 0, 1), kGrid);
    EXPECT_TRUE(away.window.empty());
    EXPECT_EQ(away.covered, 0);
    const Underside half = underside_of(ball, moved(0, 0, 1), kGrid);
    EXPECT_EQ(half.window.x, 0);
    EXPECT_EQ(half.window.width, 6);  // cells 0 to 5 are touched
    EXPECT_TRUE(underside_of_sphere({0, 0, -9}, 1, kGrid).window.empty());
    EXPECT_TRUE(underside_of(ball, moved(1e12, 0, 1), kGrid).window.empty());
}

TEST(Underside, OfSomethingSmallerThanACellIsLostAndSaysSo) {
    const auto grain = sphere_mesh({.radius_m = 0.02, .rings = 6});
    const Underside between = underside_of(grain, moved(1.0, 0.0, 1.0), kGrid);
    EXPECT_FALSE(between.window.empty());
    EXPECT_EQ(between.covered, 0);
    EXPECT_TRUE(between.lost);
    EXPECT_FALSE(underside_of(grain, moved(0.0, 0.0, 1.0), kGrid).lost);  // half outside
    EXPECT_EQ(underside_of(grain, moved(1.05, 0.0, 1.05), kGrid).covered, 1);
}

TEST(UndersideErrors, RefuseWhatIsNoNumber) {
    auto ball = sphere_mesh({.radius_m = 0.5, .rings = 8});
    EXPECT_THAT([&] { underside_of(ball, moved(std::nan(""), 0, 0), kGrid); },
                testing::ThrowsMessage<InvalidInput>(HasSubstr("its matrix is not finite")));
    EXPECT_THROW(underside_of(ball, moved(0, 0, 0), {{0, 0, 4, 4}, 0.0}), InvalidInput);
    EXPECT_THROW(underside_of_sphere({0, std::nan(""), 0}, 1, kGrid), InvalidInput);
    EXPECT_THROW(underside_of_sphere({0, 0, 0}, -1, kGrid), InvalidInput);
    ball.positions[3].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(underside_of(ball, moved(0, 0, 0), kGrid), InvalidInput);
    ball = sphere_mesh({.radius_m = 0.5, .rings = 8});
    ball.triangles[0].x = 4000;
    EXPECT_THROW(underside_of(ball, moved(0, 0, 0), kGrid), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
