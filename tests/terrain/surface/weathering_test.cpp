#include "terrain/surface/weathering.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/mesh/topology.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/sphere_meshes.h"
#include "tests/support/worn_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::TriMesh;
using terrain::weather;
using terrain::WeatheringOptions;

std::size_t intersections_of(const TriMesh& mesh) {
    return meshing::find_self_intersections(mesh, meshing::build_adjacency(mesh)).pairs.size();
}

TEST(Weathering, MakesASphereOfACube) {
    TriMesh mesh = test::cube(20);
    const double volume = meshing::signed_volume(mesh);
    EXPECT_NEAR(test::roundness(mesh), 0.577, 0.01);

    const auto report = weather(mesh, {.steps = 200, .small_faces = 0});

    EXPECT_EQ(report.steps, 200);
    EXPECT_EQ(report.restarts, 0);
    EXPECT_GE(test::roundness(mesh), 0.96);
    EXPECT_GE(test::sphericity(mesh), 0.995);
    EXPECT_NEAR(meshing::signed_volume(mesh) / volume, 0.211, 0.02);
    EXPECT_EQ(report.n_intersections, 0U);
    EXPECT_EQ(meshing::solid_defect(mesh), "");
}

// Worst and mean quality of triangles: 1 if equilateral, 0 without area.
std::pair<double, double> quality_of(const TriMesh& mesh) {
    double worst = 1.0, sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        const double squares =
            glm::dot(b - a, b - a) + glm::dot(c - b, c - b) + glm::dot(a - c, a - c);
        const double q = 2.0 * std::sqrt(3.0) * glm::length(glm::cross(b - a, c - a)) / squares;
        worst = std::min(worst, q);
        sum += q;
    }
    return {worst, sum / static_cast<double>(mesh.triangles.size())};
}

// `mesh-erosion.md` 3: the source's comparison of directions, after 100 steps.
TEST(Weathering, UmbrellaVectorsKeepTrianglesBetterThanNormals) {
    std::pair<double, double> quality[2];
    for (const auto direction :
         {terrain::WearDirection::Umbrella, terrain::WearDirection::Normal}) {
        TriMesh mesh = test::cube(20);
        weather(mesh, {.steps = 100, .direction = direction, .small_faces = 0, .check_every = 0});
        quality[static_cast<std::size_t>(direction)] = quality_of(mesh);
    }
    EXPECT_NEAR(quality[0].first, 0.716, 0.03);
    EXPECT_NEAR(quality[0].second, 0.861, 0.02);
    EXPECT_NEAR(quality[1].first, 0.398, 0.05);
    EXPECT_NEAR(quality[1].second, 0.773, 0.02);
}

TEST(Weathering, StopsShortOfASphereWhenReadLiterally) {
    TriMesh mesh = test::cube(12);
    weather(mesh, {.steps = 100, .reading = Reading::Literal});
    EXPECT_LT(test::roundness(mesh), 0.7);
}

TEST(Weathering, LosesLessWithAHigherPower) {
    double last = 0.0;
    for (const double power : {1.0, 2.0, 3.0, 5.0}) {
        TriMesh mesh = test::lumpy_sphere(2000, 0.25);
        weather(mesh, {.steps = 40, .power = power});
        const double volume = meshing::signed_volume(mesh);
        EXPECT_GT(volume, last + 0.01) << "power " << power;
        last = volume;
    }
}

TEST(Weathering, LosesVolumeInEveryStep) {
    terrain::Weathering run(test::lumpy_sphere(900, 0.25), {.steps = 30});
    double volume = meshing::signed_volume(run.mesh());
    while (run.advance()) {
        const double now = meshing::signed_volume(run.mesh());
        EXPECT_LT(now, volume);
        volume = now;
    }
}

TEST(Weathering, KeepsAProngedBodyWhole) {
    TriMesh mesh = test::pronged(1500);
    const double height = 2.3;
    const auto report =
        weather(mesh, {.steps = 120, .power = 5, .check_every = 1, .max_restarts = 0});
    EXPECT_FALSE(report.gave_up);
    EXPECT_EQ(report.steps, 120);
    EXPECT_EQ(intersections_of(mesh), 0U);
    const auto topology = meshing::analyse_topology(mesh);
    EXPECT_TRUE(topology.closed && topology.manifold);
    EXPECT_EQ(topology.genus, 0);
    float top = 0.0F;
    for (const glm::vec3& p : mesh.positions)
        top = std::max(top, p.y);
    EXPECT_LT(top, 0.95 * height);  // the prongs recede
}

TEST(Weathering, RemovesSmallFacesOnTheWay) {
    TriMesh mesh = test::ellipsoid(test::random_sphere_points(1500, 2), {1, 0.8, 0.6});
    const auto report = weather(mesh, {.steps = 10, .small_faces = 0.3, .check_every = 1});
    EXPECT_GT(report.n_collapsed, 100U);
    EXPECT_EQ(meshing::solid_defect(mesh), "");
    EXPECT_EQ(intersections_of(mesh), 0U);
}

TEST(Weathering, RecoversAnIrregularCubeByShorterSteps) {
    TriMesh mesh = test::irregular_cube(4, 5);
    ASSERT_EQ(meshing::solid_defect(mesh), "");
    const WeatheringOptions options = {.steps = 2,
                                       .step_limit = 1,
                                       .small_faces = 0,
                                       .check_every = 1,
                                       .restart_factor = 4,
                                       .max_restarts = 10};
    const auto report = weather(mesh, options);
    EXPECT_FALSE(report.gave_up);
    EXPECT_GT(report.restarts, 0);
    EXPECT_GT(report.step_limit, 1.0);
    EXPECT_NEAR(report.dose, 2.0, 1e-6);
    EXPECT_GT(report.steps, 2);
    EXPECT_EQ(intersections_of(mesh), 0U);
}

TEST(Weathering, StartsAgainFromTheStartIfTold) {
    TriMesh mesh = test::irregular_cube(4, 5);
    const auto report = weather(mesh, {.steps = 2,
                                       .step_limit = 1,
                                       .small_faces = 0,
                                       .check_every = 1,
                                       .restart_from = terrain::RestartFrom::Start,
                                       .restart_factor = 4,
                                       .max_restarts = 10});
    EXPECT_FALSE(report.gave_up);
    EXPECT_EQ(report.steps, static_cast<std::int64_t>(std::llround(2 * report.step_limit)));
}

TEST(Weathering, SaysSoWhenItGivesUp) {
    const TriMesh start = test::irregular_cube(4, 5);
    TriMesh mesh = start;
    const auto report = weather(
        mesh,
        {.steps = 30, .step_limit = 0.2, .small_faces = 0, .check_every = 1, .max_restarts = 0});
    EXPECT_TRUE(report.gave_up);
    EXPECT_EQ(report.n_intersections, 0U);
    EXPECT_NE(report.tangle.a, report.tangle.b);
    EXPECT_EQ(intersections_of(mesh), 0U);  // the last clean state
}

TEST(Weathering, CountsWhatTheMeshCameWith) {
    TriMesh mesh = test::icosphere(3);
    const TriMesh other = test::icosphere(3);
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : other.positions)
        mesh.positions.push_back(p + glm::vec3(1.5F, 0.1F, 0));
    for (const glm::uvec3& t : other.triangles)
        mesh.triangles.push_back(t + n);
    const std::size_t before = intersections_of(mesh);
    const auto report = weather(mesh, {.steps = 5, .check_every = 1});
    EXPECT_GT(before, 0U);
    EXPECT_EQ(report.n_at_start, before);
    EXPECT_EQ(report.n_intersections, intersections_of(mesh));
}

TEST(Weathering, GivesTheSameDoseInShorterSteps) {
    TriMesh long_steps = test::lumpy_sphere(900, 0.2);
    TriMesh short_steps = long_steps;
    weather(long_steps, {.steps = 20, .step_limit = 10, .small_faces = 0});
    weather(short_steps, {.steps = 80, .step_limit = 40, .small_faces = 0});
    EXPECT_NEAR(meshing::signed_volume(long_steps) / meshing::signed_volume(short_steps), 1.0,
                0.02);
}

TEST(Weathering, StopsWhenNothingIsLeft) {
    TriMesh mesh = test::icosphere(1);
    const auto report =
        weather(mesh, {.steps = 100000, .step_limit = 5, .small_faces = 0, .check_every = 0});
    EXPECT_LT(report.steps, 100000);
    EXPECT_TRUE(report.vanished);
}

TEST(Weathering, SaysWhenUnitsMatter) {
    TriMesh large = test::icosphere(2, 20.0F);
    EXPECT_TRUE(weather(large, {.steps = 1}).depends_on_units);
    TriMesh small = test::icosphere(2, 0.2F);
    EXPECT_FALSE(weather(small, {.steps = 1}).depends_on_units);
}

TEST(Weathering, GoesOnFromAStateToTheSameResult) {
    const TriMesh start = test::pronged(700);
    const WeatheringOptions options = {
        .steps = 30, .power = 2, .freeze_scale = true, .check_every = 4};
    TriMesh whole = start;
    weather(whole, options);
    terrain::Weathering first(start, options);
    for (int i = 0; i < 14; ++i)
        first.advance();
    terrain::Weathering second(start, options, first.state());
    EXPECT_EQ(second.report().steps, 12);
    while (second.advance()) {
    }
    EXPECT_EQ(second.mesh().positions, whole.positions);
    EXPECT_EQ(second.mesh().triangles, whole.triangles);
}

TEST(Weathering, IsTheSameForAnyNumberOfThreads) {
    TriMesh all = test::lumpy_sphere(5000, 0.2);
    TriMesh one = all;
    weather(all, {.steps = 6, .check_every = 2});
    const ThreadLimit limit(1);
    weather(one, {.steps = 6, .check_every = 2});
    EXPECT_EQ(all.positions, one.positions);
    EXPECT_EQ(all.triangles, one.triangles);
}

TEST(Weathering, DoesNothingInNoSteps) {
    TriMesh mesh = test::cube(3);
    const TriMesh before = mesh;
    EXPECT_EQ(weather(mesh, {.steps = 0}).steps, 0);
    EXPECT_EQ(mesh.positions, before.positions);
}

TEST(WeatheringErrors, NameTheValueAndTheRange) {
    TriMesh mesh = test::cube(1);
    EXPECT_THAT([&] { weather(mesh, {.power = 0.5}); },
                testing::ThrowsMessage<InvalidOption>("power is 0.5, must be in [1, 100]"));
    TriMesh empty;
    EXPECT_THAT([&] { weather(empty); },
                testing::ThrowsMessage<InvalidInput>("the mesh has no triangle to weather"));
    mesh.positions[0].x = std::nanf("");
    EXPECT_THAT([&] { weather(mesh); }, testing::ThrowsMessage<InvalidInput>(
                                            "the mesh has a position or normal that is no number"));
}

}  // namespace
}  // namespace scree
