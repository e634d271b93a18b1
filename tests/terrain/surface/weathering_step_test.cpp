#include "terrain/surface/weathering_step.h"

#include "base/error.h"
#include "meshing/curvature/umbrella.h"
#include "meshing/mesh/normals.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/sphere_meshes.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::TriMesh;
using terrain::StepRules;
using terrain::StepScratch;

// The step put together from its parts, one vertex after the other.
TriMesh plain_step(TriMesh mesh, const StepRules& rules) {
    const auto adjacency = meshing::build_adjacency(mesh);
    const auto normals = meshing::vertex_normals(mesh, adjacency);
    const auto curvature = meshing::mean_curvature(mesh, adjacency, normals, rules.curvature);
    const auto umbrella = meshing::umbrella_vectors(mesh, adjacency);
    const auto range = meshing::curvature_range(curvature, adjacency);
    const float factor =
        meshing::signed_factor(range.greatest(), meshing::CurvatureScale::DownscaleOnly);
    const double limit = meshing::mean_edge_length(mesh, adjacency) / rules.step_limit;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const float h = meshing::scale_signed(curvature[v], factor);
        if (h > 0.0F && adjacency.rim[v] == 0)
            mesh.positions[v] +=
                static_cast<float>(limit * std::pow(h, rules.power)) * glm::normalize(umbrella[v]);
    }
    return mesh;
}

TEST(WeatheringStep, EqualsItsPartsPutTogether) {
    for (const auto method : {meshing::CurvatureMethod::Tensor, meshing::CurvatureMethod::Cotangent,
                              meshing::CurvatureMethod::Quadric}) {
        TriMesh mesh = test::ellipsoid(test::random_sphere_points(700, 5), {1, 0.8, 0.6});
        const StepRules rules = {.power = 2.0, .curvature = method};
        const TriMesh expected = plain_step(mesh, rules);
        StepScratch scratch;
        terrain::weathering_step(mesh, meshing::build_adjacency(mesh), rules, scratch);
        for (std::size_t v = 0; v < mesh.positions.size(); ++v)
            EXPECT_LT(glm::distance(mesh.positions[v], expected.positions[v]), 1e-5F);
    }
}

class AnyShape : public testing::TestWithParam<unsigned> {};

TEST_P(AnyShape, KeepsTheCapAndLeavesHollowsAlone) {
    TriMesh mesh = test::lumpy_sphere(900, 0.3, GetParam());
    const TriMesh before = mesh;
    const auto adjacency = meshing::build_adjacency(mesh);
    StepScratch scratch;
    const auto report =
        terrain::weathering_step(mesh, adjacency, {.power = 1.0 + GetParam()}, scratch);
    const double limit = report.mean_edge / 10.0;
    std::size_t n_moved = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const double way =
            glm::distance(glm::dvec3(mesh.positions[v]), glm::dvec3(before.positions[v]));
        EXPECT_LE(way, limit);
        if (scratch.curvature[v] <= 0.0F) {
            EXPECT_EQ(mesh.positions[v], before.positions[v]);
        }
        n_moved += way > 0.0 ? 1 : 0;
    }
    EXPECT_GT(n_moved, 100U);
    EXPECT_LE(n_moved, report.n_moved);
    EXPECT_LT(report.range.low, 0.0F);
    EXPECT_LT(meshing::signed_volume(mesh), meshing::signed_volume(before));
}
INSTANTIATE_TEST_SUITE_P(Seeds, AnyShape, testing::Range(1U, 7U));

TEST(WeatheringStep, DoesNotDependOnUnitsWhereCurvatureIsHigh) {
    TriMesh small = test::icosphere(3, 0.1F);
    TriMesh large = test::icosphere(3, 0.8F);
    StepScratch scratch;
    terrain::weathering_step(small, meshing::build_adjacency(small), {}, scratch);
    terrain::weathering_step(large, meshing::build_adjacency(large), {}, scratch);
    for (std::size_t v = 0; v < small.positions.size(); ++v)
        EXPECT_LT(glm::distance(8.0F * small.positions[v], large.positions[v]), 1e-5F);
}

TEST(WeatheringStep, WearsLargeUnitsSlowlyUnlessTold) {
    for (const auto scale :
         {meshing::CurvatureScale::DownscaleOnly, meshing::CurvatureScale::Always}) {
        TriMesh mesh = test::icosphere(3, 10.0F);
        StepScratch scratch;
        const auto report = terrain::weathering_step(mesh, meshing::build_adjacency(mesh),
                                                     {.scale = scale}, scratch);
        const double share = report.farthest * 10.0 / report.mean_edge;
        EXPECT_NEAR(share, scale == meshing::CurvatureScale::Always ? 1.0 : 0.1, 1e-3);
    }
}

TEST(WeatheringStep, ClampsOutliersByPercentile) {
    TriMesh mesh = test::lumpy_sphere(900, 0.3);
    TriMesh other = mesh;
    const auto adjacency = meshing::build_adjacency(mesh);
    StepScratch scratch;
    const auto all = terrain::weathering_step(mesh, adjacency, {}, scratch);
    const auto most = terrain::weathering_step(
        other, adjacency, {.scale = meshing::CurvatureScale::Percentile, .quantile = 0.5}, scratch);
    EXPECT_GT(most.factor, 1.5F * all.factor);
    EXPECT_LE(most.farthest, most.mean_edge / 10.0);
}

TEST(WeatheringStep, TreatsRimsAsTold) {
    TriMesh dome = test::sheet(8, 0.1F);
    for (glm::vec3& p : dome.positions)
        p.y = -0.5F * ((p.x - 0.4F) * (p.x - 0.4F) + (p.z - 0.4F) * (p.z - 0.4F));
    const auto adjacency = meshing::build_adjacency(dome);
    const auto moved = [&](meshing::RimPolicy policy) {
        TriMesh mesh = dome;
        StepScratch scratch;
        terrain::weathering_step(mesh, adjacency, {.rim = policy}, scratch);
        return mesh.positions[4] - dome.positions[4];  // in the middle of one side
    };
    EXPECT_EQ(moved(meshing::RimPolicy::Pinned), glm::vec3(0.0F));
    const glm::vec3 along_normal = moved(meshing::RimPolicy::NormalOnly);
    EXPECT_LT(along_normal.y, -1e-4F);
    EXPECT_GT(moved(meshing::RimPolicy::Free).z, 1e-4F);  // shrinks inwards
}

TEST(WeatheringStep, MultipliesByTheVectorItselfWhenReadLiterally) {
    TriMesh mesh = test::icosphere(3);
    const TriMesh before = mesh;
    const auto adjacency = meshing::build_adjacency(mesh);
    const auto umbrella = meshing::umbrella_vectors(mesh, adjacency);
    StepScratch scratch;
    const auto report =
        terrain::weathering_step(mesh, adjacency, {.reading = Reading::Literal}, scratch);
    const float length = static_cast<float>(report.mean_edge / 10.0);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        EXPECT_LT(glm::distance(mesh.positions[v], before.positions[v] + length * umbrella[v]),
                  1e-6F);
}

TEST(WeatheringStep, GoesAgainstTheNormalForComparison) {
    TriMesh mesh = test::icosphere(2);
    const TriMesh before = mesh;
    StepScratch scratch;
    terrain::weathering_step(mesh, meshing::build_adjacency(mesh),
                             {.direction = terrain::WearDirection::Normal}, scratch);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        EXPECT_LT(glm::length(glm::cross(mesh.positions[v], before.positions[v])), 1e-5F);
}

TEST(WeatheringStep, LeavesOddMeshesFinite) {
    TriMesh single;
    single.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 7, 7}};
    single.triangles = {{0, 1, 2}};
    TriMesh flat;
    flat.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}};
    flat.triangles = {{0, 1, 2}, {0, 2, 1}, {0, 1, 3}};
    for (TriMesh mesh : {single, flat, TriMesh{}}) {
        StepScratch scratch;
        terrain::weathering_step(mesh, meshing::build_adjacency(mesh),
                                 {.rim = meshing::RimPolicy::Free}, scratch);
        EXPECT_NO_THROW(meshing::check_mesh(mesh));
    }
}

TEST(WeatheringStepErrors, NameTheSizes) {
    TriMesh mesh = test::icosphere(0);
    const auto other = meshing::build_adjacency(test::icosphere(1));
    StepScratch scratch;
    EXPECT_THAT([&] { terrain::weathering_step(mesh, other, {}, scratch); },
                testing::ThrowsMessage<InvalidInput>(
                    "the mesh has 12 vertices and 20 triangles, its adjacency 42 and 80"));
}

}  // namespace
}  // namespace scree
