#include "meshing/rocks/generalised_ellipsoid.h"

#include "base/error.h"
#include "tests/support/rock_samples.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

constexpr double kPi = std::numbers::pi;

AngleFunction constant(double value) {
    return [value](double, double) { return value; };
}

TEST(GeneralisedEllipsoid, ConstantsGiveAnEllipsoid) {
    const GeneralisedEllipsoid surface = ellipsoid({3, 1, 2}, {5, 6, 7});
    for (double a = 0.0; a < 2.0 * kPi; a += 0.1)
        for (double e = -1.5; e < 1.5; e += 0.1) {
            const glm::dvec3 p = point_on(surface, a, e) - glm::dvec3(5, 6, 7);
            EXPECT_NEAR(p.x * p.x / 9 + p.y * p.y + p.z * p.z / 4, 1.0, 1e-12);
            const glm::dvec3 normal = glm::normalize(glm::dvec3(p.x / 9, p.y, p.z / 4));
            EXPECT_LT(glm::length(normal_on(surface, a, e) - normal), 1e-5);
        }
    EXPECT_EQ(normal_on(surface, 1.0, 0.5 * kPi), glm::dvec3(0, 1, 0));
    EXPECT_EQ(normal_on(surface, 1.0, -0.5 * kPi), glm::dvec3(0, -1, 0));
}

TEST(GeneralisedEllipsoid, AxesBelongToTheirFunctions) {
    const GeneralisedEllipsoid surface = {constant(3), constant(5), constant(7), {}};
    EXPECT_NEAR(point_on(surface, 0, 0).x, 3.0, 1e-12);
    EXPECT_NEAR(point_on(surface, 0, 0.5 * kPi).y, 5.0, 1e-12);
    EXPECT_NEAR(point_on(surface, 0.5 * kPi, 0).z, 7.0, 1e-12);
}

TEST(GeneralisedEllipsoid, RadiiGiveTheOutlineAndScaledSections) {
    const vision::Rock rock = test::lobed_rock({0, 0}, 40, 3);
    const GeneralisedEllipsoid surface =
        ellipsoid_from_radii(rock.outline.radii, rock.depth, {1, 2, 3});
    for (int k = 0; k < vision::kRadii; ++k) {
        const double a = k * kPi / 180.0;
        const glm::dvec2 border = silhouette_point(surface, a) - glm::dvec2(1, 3);
        EXPECT_LT(glm::length(border - vision::border_point(rock.outline, k)), 1e-4);
        const glm::dvec3 p = point_on(surface, a, 0.7) - surface.centre;
        EXPECT_LT(glm::length(glm::dvec2(p.x, p.z) - std::cos(0.7) * border), 1e-9);
        EXPECT_NEAR(p.y, static_cast<double>(rock.depth) * std::sin(0.7), 1e-9);
    }
}

TEST(GeneralisedEllipsoid, FunctionsOfAzimuthIgnoreElevation) {
    const GeneralisedEllipsoid surface =
        ellipsoid_by_azimuth([](double a) { return 2 + std::cos(a); }, [](double) { return 1.5; },
                             [](double a) { return 2 + std::sin(a); });
    EXPECT_NEAR(point_on(surface, 1.0, 0.3).x, (2 + std::cos(1.0)) * std::cos(1.0) * std::cos(0.3),
                1e-12);
    EXPECT_NEAR(point_on(surface, 1.0, 0.3).z, (2 + std::sin(1.0)) * std::sin(1.0) * std::cos(0.3),
                1e-12);
}

TEST(Regularity, AcceptsEllipsoidsAndSmoothRocks) {
    EXPECT_TRUE(check_regularity(ellipsoid({3, 1, 2})).regular());
    const auto radius = [](double a) { return 2 + 0.3 * std::cos(3 * a); };
    EXPECT_TRUE(check_regularity(ellipsoid_by_azimuth(
                                     radius, [](double) { return 1.0; }, radius))
                    .regular());
}

TEST(Regularity, AcceptsARadialSurfaceWhateverItsPoles) {
    const AngleFunction rho = [](double a, double e) {
        return 2.0 + 0.2 * std::cos(e) * std::cos(a) + 0.3 * std::sin(e);
    };
    const RegularityReport report = check_regularity({rho, rho, rho, {}});
    EXPECT_TRUE(report.radial);
    EXPECT_TRUE(report.regular());
    const RegularityReport flat = check_regularity({constant(2), rho, constant(2), {}});
    EXPECT_FALSE(flat.radial);
    EXPECT_FALSE(flat.flat_poles);  // h = 2 + 0.2 cos e cos a has a slope of 0.2 there
    EXPECT_FALSE(flat.regular());
    EXPECT_TRUE(flat.star_shaped());
}

TEST(Regularity, RejectsEachBrokenConditionByItself) {
    RegularityReport report = check_regularity(
        {[](double a, double) { return 0.5 + std::cos(a); }, constant(1), constant(2), {}});
    EXPECT_FALSE(report.positive_radii);
    EXPECT_TRUE(report.positive_depth);

    report = check_regularity(
        {constant(2), [](double, double e) { return 1.0 + 0.5 * e; }, constant(2), {}});
    EXPECT_FALSE(report.flat_poles);
    EXPECT_TRUE(report.positive_depth);

    report = check_regularity(
        {constant(2), [](double, double e) { return std::cos(e) - 0.5; }, constant(2), {}});
    EXPECT_FALSE(report.positive_depth);
    EXPECT_TRUE(report.positive_radii);

    const AngleFunction spiral = [](double a, double) { return 2.0 + 0.1 * a; };
    report = check_regularity({spiral, constant(1), spiral, {}});
    EXPECT_FALSE(report.periodic);
    EXPECT_FALSE(report.regular());

    const AngleFunction corner = [](double a, double) { return 2.0 + 0.2 * std::abs(a - kPi); };
    report = check_regularity({corner, constant(1), corner, {}});
    EXPECT_TRUE(report.periodic);
    EXPECT_FALSE(report.differentiable);
    EXPECT_TRUE(report.star_shaped());
    EXPECT_FALSE(report.regular());
}

TEST(Regularity, RejectsAnEquatorThatTurnsBack) {
    const AngleFunction f = [](double a, double) { return 2.0 + 1.5 * std::sin(4 * a); };
    const AngleFunction g = [](double a, double) { return 2.0 - 1.5 * std::sin(4 * a); };
    const RegularityReport report = check_regularity({f, constant(1), g, {}});
    EXPECT_TRUE(report.positive_radii);
    EXPECT_FALSE(report.turning_equator);
    EXPECT_FALSE(report.oriented);
    const RegularityReport same = check_regularity({f, constant(1), f, {}});
    EXPECT_TRUE(same.turning_equator);  // with f = g the condition is r^2 > 0
}

TEST(Regularity, RejectsWhatIsNoNumber) {
    const RegularityReport report = check_regularity(
        {constant(std::numeric_limits<double>::quiet_NaN()), constant(1), constant(1), {}});
    EXPECT_FALSE(report.positive_radii);
    EXPECT_FALSE(report.periodic);
    EXPECT_FALSE(report.oriented);
    EXPECT_FALSE(report.regular());
}

TEST(RegularityErrors, NameTheValue) {
    EXPECT_THAT(
        [] {
            ellipsoid({1, 0, 1});
        },
        testing::ThrowsMessage<InvalidInput>("the semi-axes are (1, 0, 1), all must be positive"));
    const float bad[] = {1.0F, -1.0F, 1.0F};
    EXPECT_THROW(ellipsoid_from_radii(bad, 1.0), InvalidInput);
    const float good[] = {1.0F, 1.0F, 1.0F};
    EXPECT_THROW(ellipsoid_from_radii(good, 0.0), InvalidInput);
    EXPECT_THROW(ellipsoid_from_radii({good, 2}, 1.0), InvalidInput);
    EXPECT_THROW(check_regularity(ellipsoid({1, 1, 1}), {.azimuths = 2}), InvalidOption);
    EXPECT_THROW(check_regularity(ellipsoid({1, 1, 1}), {.tolerance = 0}), InvalidOption);
}

}  // namespace
}  // namespace scree::meshing
