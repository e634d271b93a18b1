#include "meshing/space/self_intersection.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "meshing/space/triangle_pair.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/sphere_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::TrianglePair;
using meshing::TriMesh;

std::vector<TrianglePair> found_in(const TriMesh& mesh) {
    const auto result = meshing::find_self_intersections(mesh, meshing::build_adjacency(mesh));
    EXPECT_TRUE(result.complete);
    return result.pairs;
}

// Every pair of triangles, one by one.
std::vector<TrianglePair> all_pairs(const TriMesh& mesh) {
    std::vector<TrianglePair> found;
    const auto points = [&](const std::array<std::uint32_t, 3>& v) {
        return meshing::TrianglePoints{mesh.positions[v[0]], mesh.positions[v[1]],
                                       mesh.positions[v[2]]};
    };
    for (std::uint32_t j = 0; j < mesh.triangles.size(); ++j)
        for (std::uint32_t i = 0; i < j; ++i) {
            std::array<std::uint32_t, 3> a = {mesh.triangles[i].x, mesh.triangles[i].y,
                                              mesh.triangles[i].z};
            std::array<std::uint32_t, 3> b = {mesh.triangles[j].x, mesh.triangles[j].y,
                                              mesh.triangles[j].z};
            const auto shared_first = [](const auto& other) {
                return [&other](std::uint32_t v) {
                    return std::find(other.begin(), other.end(), v) != other.end();
                };
            };
            const auto original = a;
            const auto n = std::stable_partition(a.begin(), a.end(), shared_first(b)) - a.begin();
            std::stable_partition(b.begin(), b.end(), shared_first(original));
            if (n == 2)
                b[0] = a[0], b[1] = a[1];
            const bool meet = n == 0   ? meshing::triangles_meet(points(a), points(b))
                              : n == 1 ? meshing::triangles_at_a_vertex_meet(points(a), points(b))
                              : n == 2 ? meshing::triangles_at_an_edge_fold(points(a), points(b))
                                       : true;
            if (meet)
                found.push_back({i, j});
        }
    std::sort(found.begin(), found.end());
    return found;
}

TEST(SelfIntersection, FindsNothingInCleanMeshes) {
    for (const TriMesh& mesh :
         {test::icosphere(3), test::torus(2, 0.7, 30, 17), test::cube(6), test::sheet(9),
          test::tube(1, 2, 20, 5), test::lumpy_sphere(1500, 0.2),
          test::ellipsoid(test::random_sphere_points(900, 2), {1, 0.8, 0.6})})
        EXPECT_THAT(found_in(mesh), testing::IsEmpty());
}

class Crumpled : public testing::TestWithParam<unsigned> {};

TEST_P(Crumpled, EqualsALookAtEveryPair) {
    Rng rng({.seed = GetParam()});
    const float amount = 0.02F * static_cast<float>(GetParam());
    for (TriMesh mesh :
         {test::icosphere(2), test::sheet(8, 0.2F), test::torus(1, 0.4, 16, 8), test::cube(4)}) {
        for (glm::vec3& p : mesh.positions)
            p += amount * glm::vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
        const auto expected = all_pairs(mesh);
        EXPECT_EQ(found_in(mesh), expected);
        if (GetParam() >= 12) {
            EXPECT_FALSE(expected.empty());
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Amounts, Crumpled, testing::Range(0U, 16U, 3U));

TEST(SelfIntersection, EqualsALookAtEveryPairOnALattice) {  // touching and coplanar pairs
    Rng rng({.seed = 3});
    TriMesh mesh;
    for (int i = 0; i < 60; ++i)
        mesh.positions.emplace_back(std::floor(rng.uniform() * 5), std::floor(rng.uniform() * 5),
                                    std::floor(rng.uniform() * 3));
    while (mesh.triangles.size() < 120) {
        const glm::uvec3 t(rng.below(60), rng.below(60), rng.below(60));
        if (t.x != t.y && t.y != t.z && t.z != t.x)
            mesh.triangles.push_back(t);
    }
    const auto expected = all_pairs(mesh);
    EXPECT_GT(expected.size(), 100U);
    EXPECT_EQ(found_in(mesh), expected);
}

TEST(SelfIntersection, FindsAFoldedFace) {
    TriMesh mesh = test::sheet(6);
    mesh.positions[24] += glm::vec3(1.6F, 0, 0);  // past its neighbours, in the plane
    EXPECT_EQ(found_in(mesh), all_pairs(mesh));
    EXPECT_THAT(found_in(mesh), testing::Not(testing::IsEmpty()));
}

TEST(SelfIntersection, FindsAFanThatGoesAroundTwice) {
    TriMesh mesh;
    mesh.positions = {{0, 0.2F, 0}};
    constexpr std::uint32_t n = 10;
    for (std::uint32_t i = 0; i < n; ++i) {
        const float a = 4.0F * 3.14159265F * static_cast<float>(i) / n;
        mesh.positions.emplace_back(std::cos(a), 0.001F * static_cast<float>(i), -std::sin(a));
        mesh.triangles.emplace_back(0, 1 + i, 1 + (i + 1) % n);
    }
    EXPECT_EQ(found_in(mesh), all_pairs(mesh));
    EXPECT_THAT(found_in(mesh), testing::Not(testing::IsEmpty()));
}

TEST(SelfIntersection, FindsTwoBodiesInEachOther) {
    TriMesh mesh = test::icosphere(2);
    const TriMesh other = test::icosphere(2);
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : other.positions)
        mesh.positions.push_back(p + glm::vec3(1.3F, 0.2F, 0.1F));
    for (const glm::uvec3& t : other.triangles)
        mesh.triangles.push_back(t + n);
    const auto pairs = found_in(mesh);
    EXPECT_EQ(pairs, all_pairs(mesh));
    EXPECT_GT(pairs.size(), 20U);
}

TEST(SelfIntersection, StopsAtItsLimit) {
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (int i = 0; i < 3000; ++i) {  // a stack of copies: millions of pairs
        mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        const auto n = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.triangles.emplace_back(n - 3, n - 2, n - 1);
    }
    const auto result = meshing::find_self_intersections(mesh, meshing::build_adjacency(mesh), 50);
    EXPECT_FALSE(result.complete);
    EXPECT_GE(result.pairs.size(), 50U);
    EXPECT_LT(result.pairs.size(), 200'000U);
}

TEST(SelfIntersection, SaysWhenAStarIsTooLarge) {
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}};
    constexpr std::uint32_t n = 5000;
    for (std::uint32_t i = 0; i < n; ++i) {  // twice around
        const float a = 2 * 6.2831853F * static_cast<float>(i) / n;
        mesh.positions.emplace_back(std::cos(a), 1e-4F * static_cast<float>(i), -std::sin(a));
        mesh.triangles.emplace_back(0, 1 + i, 1 + (i + 1) % n);
    }
    EXPECT_FALSE(meshing::find_self_intersections(mesh, meshing::build_adjacency(mesh)).complete);
}

TEST(SelfIntersection, KeepsItsOrderWhenTrianglesGo) {
    TriMesh mesh = test::lumpy_sphere(800, 0.9);
    meshing::SelfIntersectionFinder finder;
    finder.find(mesh, meshing::build_adjacency(mesh));
    std::vector<std::uint32_t> kept;
    TriMesh fewer = mesh;
    fewer.triangles.clear();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (t % 7 != 3) {
            kept.push_back(t);
            fewer.triangles.push_back(mesh.triangles[t]);
        }
    finder.compact(kept);
    const auto adjacency = meshing::build_adjacency(fewer);
    EXPECT_EQ(finder.find(fewer, adjacency).pairs,
              meshing::find_self_intersections(fewer, adjacency).pairs);
}

TEST(SelfIntersection, IsTheSameForAnyNumberOfThreads) {
    const TriMesh mesh = test::lumpy_sphere(6000, 2.0);
    const auto all = found_in(mesh);
    EXPECT_FALSE(all.empty());
    const ThreadLimit one(1);
    EXPECT_EQ(all, found_in(mesh));
}

TEST(SelfIntersectionErrors, NameTheSizes) {
    const auto adjacency = meshing::build_adjacency(test::icosphere(1));
    EXPECT_THAT([&] { meshing::find_self_intersections(test::icosphere(0), adjacency); },
                testing::ThrowsMessage<InvalidInput>(
                    "the mesh has 12 vertices and 20 triangles, its adjacency 42 and 80"));
}

}  // namespace
}  // namespace scree
