#include "meshing/rocks/radius_profile.h"

#include "tests/support/rock_samples.h"

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

const auto kWavy = test::outline_of({0, 0}, [](double a) { return 10.0 + 2.0 * std::cos(3 * a); });

double exact_area() {
    return 0.5 * (100.0 + 2.0) * 2.0 * std::numbers::pi;
}

TEST(RadiusProfile, PointSamplingInterpolates) {
    for (const int n : {3, 7, 30, 360, 500}) {
        const RadiusProfile profile = sample_radii(kWavy.radii, n, RadiusSampling::Point);
        ASSERT_EQ(profile.radius.size(), static_cast<std::size_t>(n));
        for (int s = 0; s < n; ++s) {
            const double a = 2.0 * std::numbers::pi * s / n;
            const auto i = static_cast<std::size_t>(s);
            EXPECT_NEAR(profile.radius[i], 10.0 + 2.0 * std::cos(3 * a), 1e-3);
            if (n >= 360) {
                EXPECT_NEAR(profile.slope[i], -6.0 * std::sin(3 * a), 0.01);
            }
        }
    }
}

TEST(RadiusProfile, AveragesAreTheMeanOverTheSegment) {
    const int n = 12;
    const RadiusProfile profile = sample_radii(kWavy.radii, n, RadiusSampling::Averaged);
    const double half = std::numbers::pi / n;
    for (int s = 0; s < n; ++s) {
        const double a = 2.0 * std::numbers::pi * s / n;
        const double mean =
            10.0 + 2.0 * (std::sin(3 * (a + half)) - std::sin(3 * (a - half))) / (6.0 * half);
        EXPECT_NEAR(profile.radius[static_cast<std::size_t>(s)], mean, 1e-3);
    }
}

TEST(RadiusProfile, AveragesStayBetweenLeastAndGreatest) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const vision::Rock rock = test::jagged_rock({0, 0}, 0.1, 10.0, seed);
        const auto [least, most] =
            std::minmax_element(rock.outline.radii.begin(), rock.outline.radii.end());
        for (const int n : {3, 8, 31, 719})
            for (const double r :
                 sample_radii(rock.outline.radii, n, RadiusSampling::Averaged).radius) {
                EXPECT_GE(r, *least - 1e-9);
                EXPECT_LE(r, *most + 1e-9);
            }
    }
}

TEST(RadiusProfile, AreaAndVolumeAreThoseOfTheClosedForm) {
    EXPECT_NEAR(equatorial_area(kWavy.radii), exact_area(), 1e-3 * exact_area());
    EXPECT_NEAR(ellipsoid_volume(kWavy.radii, 5.0), 4.0 / 3.0 * exact_area() * 5.0,
                1e-3 * exact_area() * 7.0);
    const auto disc = test::outline_of({0, 0}, [](double) { return 2.0; });
    EXPECT_NEAR(ellipsoid_volume(disc.radii, 2.0), 4.0 / 3.0 * std::numbers::pi * 8.0, 1e-9);
}

}  // namespace
}  // namespace scree::meshing
