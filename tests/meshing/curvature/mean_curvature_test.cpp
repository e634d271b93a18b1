#include "meshing/curvature/mean_curvature.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/mesh/normals.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/sphere_meshes.h"

#include <array>
#include <numbers>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::CurvatureMethod;
using meshing::TriMesh;

std::vector<float> curvature_of(const TriMesh& mesh, CurvatureMethod method) {
    const auto adjacency = meshing::build_adjacency(mesh);
    const auto normals = meshing::vertex_normals(mesh, adjacency);
    return meshing::mean_curvature(mesh, adjacency, normals, method);
}

class EveryMethod : public testing::TestWithParam<CurvatureMethod> {};

TEST_P(EveryMethod, GivesOneOverTheRadiusOfASphere) {
    const double tolerance = GetParam() == CurvatureMethod::Tensor ? 6e-6 : 6e-3;
    for (const float radius : {0.1F, 1.0F, 10.0F})
        for (const float h : curvature_of(test::icosphere(4, radius), GetParam()))
            EXPECT_NEAR(h * radius, 1.0, tolerance);
}

TEST_P(EveryMethod, ConvergesOnATorus) {
    const auto worst = [&](std::uint32_t n) {
        const TriMesh mesh = test::torus(2.0, 0.7, 2 * n, n);
        const auto curvature = curvature_of(mesh, GetParam());
        double error = 0.0;
        for (std::uint32_t v = 0; v < curvature.size(); ++v) {
            const double c = std::cos(2 * std::numbers::pi * (v % n) / n);
            const double exact = 0.5 * (1 / 0.7 + c / (2.0 + 0.7 * c));
            error = std::max(error, std::abs(static_cast<double>(curvature[v]) - exact));
        }
        return error;
    };
    const double coarse = worst(24);
    const double fine = worst(48);
    EXPECT_LT(fine, GetParam() == CurvatureMethod::Tensor ? 0.0014 : 0.02);
    EXPECT_NEAR(coarse / fine, 4.0, 0.4);  // second order
}

TEST_P(EveryMethod, GivesHalfOfACylindersCurvature) {
    constexpr std::uint32_t kAround = 96;
    const auto curvature = curvature_of(test::tube(2.0, 2.0, kAround, 16), GetParam());
    for (std::uint32_t v = 4 * kAround; v < 12 * kAround; ++v)
        EXPECT_NEAR(curvature[v], 0.25, 1e-3);
}

TEST_P(EveryMethod, IsZeroOnAPlane) {
    for (const float h : curvature_of(test::sheet(6), GetParam()))
        EXPECT_NEAR(h, 0.0, 1e-7);
}

TEST_P(EveryMethod, ChangesSignWithTheSideThatIsOut) {
    const TriMesh mesh = test::lumpy_sphere(800, 0.2);
    const auto outwards = curvature_of(mesh, GetParam());
    const auto inwards = curvature_of(test::flipped(mesh), GetParam());
    for (std::size_t v = 0; v < outwards.size(); ++v)
        EXPECT_NEAR(outwards[v], -inwards[v], 1e-4F * (1.0F + std::abs(outwards[v])));
}

TEST_P(EveryMethod, FallsAsTheMeshGrows) {
    TriMesh mesh = test::lumpy_sphere(800, 0.2);
    const auto small = curvature_of(mesh, GetParam());
    for (glm::vec3& p : mesh.positions)
        p *= 8.0F;  // a power of two, so that nothing is rounded
    const auto large = curvature_of(mesh, GetParam());
    for (std::size_t v = 0; v < small.size(); ++v)
        EXPECT_NEAR(small[v], 8.0F * large[v], 1e-5F * (1.0F + std::abs(small[v])));
}

TEST_P(EveryMethod, IsFiniteOnOddMeshes) {
    TriMesh flat;
    flat.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {9, 9, 9}, {1, 0, 0}};
    flat.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {1, 5, 3}};
    TriMesh single;
    single.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    single.triangles = {{0, 1, 2}};
    TriMesh corners;
    corners.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    corners.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    for (const TriMesh& mesh : {flat, single, corners, TriMesh{}})
        for (const float h : curvature_of(mesh, GetParam()))
            EXPECT_TRUE(std::isfinite(h));
}

TEST_P(EveryMethod, IsTheSameForAnyNumberOfThreads) {
    const TriMesh mesh = test::lumpy_sphere(6000);
    const auto all = curvature_of(mesh, GetParam());
    const ThreadLimit one(1);
    EXPECT_EQ(all, curvature_of(mesh, GetParam()));
}
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod,
                         testing::Values(CurvatureMethod::Tensor, CurvatureMethod::Cotangent,
                                         CurvatureMethod::Quadric));

// Trace of the tensor by the normal equations that the source's estimator solves, in a frame.
double fitted_trace(const std::array<glm::dvec3, 3>& p, const std::array<glm::dvec3, 3>& n) {
    const glm::dvec3 u = glm::normalize(p[1] - p[0]);
    const glm::dvec3 w = glm::normalize(glm::cross(glm::cross(p[1] - p[0], p[2] - p[0]), u));
    double xx = 0, xy = 0, yy = 0, xa = 0, mixed = 0, yb = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 edge = p[(k + 2) % 3] - p[(k + 1) % 3];
        const glm::dvec3 turn = n[(k + 2) % 3] - n[(k + 1) % 3];
        const double x = glm::dot(edge, u), y = glm::dot(edge, w);
        const double a = glm::dot(turn, u), b = glm::dot(turn, w);
        xx += x * x, xy += x * y, yy += y * y;
        xa += x * a, mixed += x * b + y * a, yb += y * b;
    }
    // [xx xy 0; xy xx+yy xy; 0 xy yy] (p q r) = (xa mixed yb), by Cramer's rule
    const double det = xx * ((xx + yy) * yy - xy * xy) - xy * xy * yy;
    const double first = xa * ((xx + yy) * yy - xy * xy) - xy * (mixed * yy - xy * yb);
    const double last =
        xx * ((xx + yy) * yb - mixed * xy) - xy * (xy * yb - 0.0 * mixed) + xa * (xy * xy);
    return (first + last) / det;
}

TEST(TensorCurvature, EqualsThePlainLeastSquaresForm) {
    const TriMesh mesh = test::ellipsoid(test::random_sphere_points(400, 3), {1.0, 0.8, 0.6});
    const auto adjacency = meshing::build_adjacency(mesh);
    const auto normals = meshing::vertex_normals(mesh, adjacency);
    const auto curvature =
        meshing::mean_curvature(mesh, adjacency, normals, CurvatureMethod::Tensor);
    std::vector<double> sum(curvature.size(), 0.0);
    std::vector<double> area(curvature.size(), 0.0);
    for (const glm::uvec3& t : mesh.triangles) {
        std::array<glm::dvec3, 3> p;
        std::array<glm::dvec3, 3> n;
        for (int k = 0; k < 3; ++k) {
            p[static_cast<std::size_t>(k)] = glm::dvec3(mesh.positions[t[k]]);
            n[static_cast<std::size_t>(k)] = glm::dvec3(normals[t[k]]);
        }
        const double half_trace = 0.5 * fitted_trace(p, n);
        const double whole = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        std::array<double, 3> dots{};
        for (std::size_t k = 0; k < 3; ++k)
            dots[k] = glm::dot(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3;
            const std::size_t j = (k + 2) % 3;
            double part = 0.0;  // Meyer's mixed area
            if (std::min({dots[0], dots[1], dots[2]}) < 0.0)
                part = dots[k] < 0.0 ? whole / 2 : whole / 4;
            else
                part = (glm::dot(p[j] - p[k], p[j] - p[k]) * dots[i] +
                        glm::dot(p[i] - p[k], p[i] - p[k]) * dots[j]) /
                       (16.0 * whole);
            sum[t[static_cast<int>(k)]] += part * half_trace;
            area[t[static_cast<int>(k)]] += part;
        }
    }
    for (std::size_t v = 0; v < curvature.size(); ++v)
        EXPECT_NEAR(curvature[v], sum[v] / area[v], 1e-4 * std::abs(sum[v] / area[v]) + 1e-5);
}

double rms_error(CurvatureMethod method, std::size_t n) {
    const glm::dvec3 axes(1.0, 0.8, 0.6);
    const auto points = test::random_sphere_points(n, 1);
    const auto curvature = curvature_of(test::ellipsoid(points, axes), method);
    double sum = 0.0;
    for (std::size_t v = 0; v < n; ++v) {
        const double exact = test::ellipsoid_mean_curvature(points[v] * axes, axes);
        sum += std::pow(curvature[v] / exact - 1.0, 2);
    }
    return std::sqrt(sum / static_cast<double>(n));
}

TEST(QuadricCurvature, IsAccurateOnUnevenTriangles) {
    EXPECT_LT(rms_error(CurvatureMethod::Quadric, 10'000), 0.01);
}

TEST(CotangentCurvature, IsFarOffOnUnevenTriangles) {
    EXPECT_GT(rms_error(CurvatureMethod::Cotangent, 2'000), 0.2);
}

TEST(MeanCurvatureErrors, NameTheLengths) {
    const TriMesh mesh = test::icosphere(0);
    const auto adjacency = meshing::build_adjacency(mesh);
    EXPECT_THAT(
        [&] { meshing::mean_curvature(mesh, adjacency, std::vector<glm::vec3>(3)); },
        testing::ThrowsMessage<InvalidInput>("the mesh has 12 vertices, its adjacency 12, the "
                                             "normals 3 and the curvature 12"));
}

}  // namespace
}  // namespace scree
