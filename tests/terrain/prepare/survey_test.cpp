#include "terrain/prepare/survey.h"

#include "base/error.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

namespace scree {
namespace {

using terrain::GroundLattice;
using terrain::lattice_of_points;
using terrain::SurveyOptions;
using terrain::SurveyReport;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr glm::dvec3 kFar(612345.0, 0.0, -5512345.0);

double land(double x, double z) {
    return 30.0 + 0.25 * x - 0.125 * z;
}

std::vector<glm::dvec3> survey_of_plane(std::size_t n, std::uint64_t seed = 1) {
    Rng rng({.seed = seed});
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < n; ++i) {
        // The corners, then anywhere on 80 by 50 m.
        const double x = i < 4 ? (i % 2 == 0 ? 0.0 : 80.0) : rng.uniform(0.0, 80.0);
        const double z = i < 4 ? (i < 2 ? 0.0 : 50.0) : rng.uniform(0.0, 50.0);
        points.push_back(kFar + glm::dvec3(x, land(x, z), z));
    }
    return points;
}

// Greatest distance of a known place from the plane; counts the known ones.
double error_of(const GroundLattice& ground, std::size_t* n_known = nullptr) {
    double worst = 0.0;
    for (int j = 0; j < ground.heights.height(); ++j)
        for (int i = 0; i < ground.heights.width(); ++i) {
            const double h = static_cast<double>(ground.heights(i, j));
            if (std::isnan(h))
                continue;
            const glm::dvec2 p = ground.place(i, j);
            worst = std::max(worst, std::abs(h - land(p.x, p.y)));
            if (n_known != nullptr)
                ++*n_known;
        }
    return worst;
}

TEST(Survey, ReproducesAPlaneFarFromTheOrigin) {
    SurveyReport report;
    const auto points = survey_of_plane(4000);
    const GroundLattice ground = lattice_of_points(points, {}, 2000, {}, &report);
    std::size_t n_known = 0;
    EXPECT_LT(error_of(ground, &n_known), 1e-4);
    EXPECT_NEAR(static_cast<double>(n_known), 2000.0, 150.0);
    EXPECT_EQ(report.n_points, 4000U);
    EXPECT_EQ(report.n_ground, 4000U);
    EXPECT_LT(report.n_thinned, 2100U);
    EXPECT_NEAR(report.area, 4000.0, 60.0);
    EXPECT_EQ(report.moved, glm::dvec2(kFar.x, kFar.z));
}

TEST(Survey, TakesTheGroundClassAlone) {
    auto points = survey_of_plane(3000);
    std::vector<std::uint8_t> classes(points.size(), meshing::kGroundClass);
    for (std::size_t i = 4; i < points.size(); i += 2) {
        points[i].y -= 10.0;  // below, so that thinning would keep them
        classes[i] = 7;       // noise
    }
    SurveyReport report;
    EXPECT_LT(error_of(lattice_of_points(points, classes, 800, {}, &report)), 1e-4);
    EXPECT_LT(report.n_ground, 1510U);
    EXPECT_GT(error_of(lattice_of_points(points, classes, 800, {.ground_only = false})), 5.0);
    std::fill(classes.begin(), classes.end(), std::uint8_t{1});  // nothing classified
    lattice_of_points(points, classes, 800, {}, &report);
    EXPECT_EQ(report.n_ground, 3000U);
}

TEST(Survey, ThinningKeepsTheLowest) {
    auto points = survey_of_plane(6000);
    for (std::size_t i = 5; i < points.size(); i += 5)
        points[i].y += 6.0;  // leaves
    EXPECT_LT(error_of(lattice_of_points(points, {}, 400, {.spacing = 6.0})), 1e-3);
    EXPECT_GT(error_of(lattice_of_points(points, {}, 400, {.spacing = 0.1})), 3.0);
    SurveyReport report;
    lattice_of_points(points, {}, 400, {.spacing = 5.0, .keep = terrain::ThinKeep::Middle},
                      &report);
    EXPECT_LE(report.n_thinned, 17U * 11U);
}

TEST(Survey, DropsWhatStandsTooSteep) {
    auto points = survey_of_plane(3000);
    for (glm::dvec3& p : points)
        if (std::hypot(p.x - kFar.x - 40.0, p.z - kFar.z - 25.0) < 1.5)
            p.y += 8.0;  // a tree whose crown hides the ground
    const SurveyOptions bare = {.spacing = 1.0, .steepest = 45.0};
    SurveyReport report;
    EXPECT_LT(error_of(lattice_of_points(points, {}, 1000, bare, &report)), 1e-4);
    EXPECT_GT(report.n_steep, 1U);
    EXPECT_GT(error_of(lattice_of_points(points, {}, 1000, {.spacing = 1.0})), 5.0);
}

TEST(Survey, LeavesWideGapsOpenIfTold) {
    auto points = survey_of_plane(5000);
    std::erase_if(points, [](const glm::dvec3& p) {
        return std::hypot(p.x - kFar.x - 40.0, p.z - kFar.z - 25.0) < 10.0;
    });
    const auto unknown = [&](double longest) {
        const auto ground = lattice_of_points(points, {}, 2000, {.longest = longest});
        return std::isnan(height_at(ground, 40.0, 25.0));
    };
    EXPECT_FALSE(unknown(0.0));
    EXPECT_TRUE(unknown(6.0));
}

TEST(Survey, RefusesWhatIsNoGround) {
    const auto points = survey_of_plane(100);
    EXPECT_THAT(
        [&] {
            lattice_of_points({points.data(), 2}, {}, 100, {});
        },
        ThrowsMessage<InvalidInput>(HasSubstr("has 2 points of ground")));
    std::vector<glm::dvec3> bad = points;
    bad[7].y = std::nan("");
    EXPECT_THAT([&] { lattice_of_points(bad, {}, 100, {}); },
                ThrowsMessage<InvalidInput>(HasSubstr("no number")));
    bad = points;
    for (glm::dvec3& p : bad)
        p.z = 3.0;
    EXPECT_THAT([&] { lattice_of_points(bad, {}, 100, {}); },
                ThrowsMessage<InvalidInput>(HasSubstr("both must be positive")));
    for (std::size_t i = 0; i < bad.size(); ++i)
        bad[i] = {static_cast<double>(i), 0.0, static_cast<double>(i)};
    EXPECT_THAT([&] { lattice_of_points(bad, {}, 100, {}); },
                ThrowsMessage<InvalidInput>(HasSubstr("span no ground")));
    EXPECT_THAT([&] { lattice_of_points(points, {}, 100, {.spacing = 1e-9}); },
                ThrowsMessage<InvalidInput>(HasSubstr("raise spacing")));
    EXPECT_THAT([&] { lattice_of_points(points, {}, 100, {.longest = 1e-3}); },
                ThrowsMessage<InvalidInput>(HasSubstr("raise longest")));
    const std::vector<std::uint8_t> few(3, 2);
    EXPECT_THROW(lattice_of_points(points, few, 100, {}), InvalidInput);
    EXPECT_THROW(lattice_of_points(points, {}, 100, {.steepest = 100}), InvalidOption);
}

}  // namespace
}  // namespace scree
