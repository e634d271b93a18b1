#include "meshing/rocks/rock_lod.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/mesh/bounds.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/rock_samples.h"

#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

vision::RockSet one_rock(const vision::Rock& rock) {
    vision::RockSet set = test::rock_set(0, 0);
    set.rocks = {rock};
    return set;
}

// Largest distance from a vertex of `from` to the surface of `to`.
double deviation(const TriMesh& from, const TriMesh& to) {
    double most = 0.0;
    for (const glm::vec3& p : from.positions) {
        TriMesh moved = to;
        for (glm::vec3& q : moved.positions)
            q -= p;
        most = std::max(most, static_cast<double>(inner_radius(moved)));
    }
    return most;
}

class RockLods : public testing::TestWithParam<unsigned> {};  // the parameter is a seed

TEST_P(RockLods, AreSolidsOfEverFewerTriangles) {
    vision::RockSet set = test::rock_set(8, GetParam());
    set.rocks.push_back(test::jagged_rock({400, 300}, 10, 60, GetParam()));
    for (const bool seam : {false, true}) {
        const auto rocks = build_rock_meshes(set, {.seam = seam});
        for (const auto& chain : build_lod_chains(rocks)) {
            ASSERT_FALSE(chain.empty());
            EXPECT_EQ(chain[0].error, 0.0);
            for (std::size_t k = 0; k < chain.size(); ++k) {
                test::expect_valid(chain[k].mesh);
                EXPECT_EQ(chain[k].mesh.normals.size(), chain[k].mesh.positions.size());
                EXPECT_EQ(chain[k].mesh.texcoords.size(), chain[k].mesh.positions.size());
                if (k > 0) {
                    EXPECT_LT(chain[k].mesh.triangles.size(), chain[k - 1].mesh.triangles.size());
                    EXPECT_GE(chain[k].error, chain[k - 1].error);
                    EXPECT_GT(chain[k].error, 0.0);
                }
            }
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, RockLods, testing::Range(0U, 6U));

TEST(RockLod, HalvesTheTriangles) {
    const auto rocks = build_rock_meshes(one_rock(test::lobed_rock({400, 300}, 80, 3)));
    const auto chain = build_lod_chain(rocks[0].mesh);
    ASSERT_EQ(chain.size(), 4U);
    EXPECT_EQ(chain[0].mesh.triangles.size(), 900U);
    EXPECT_NEAR(static_cast<double>(chain[1].mesh.triangles.size()), 450.0, 4.0);
    EXPECT_NEAR(static_cast<double>(chain[2].mesh.triangles.size()), 225.0, 4.0);
    EXPECT_NEAR(static_cast<double>(chain[3].mesh.triangles.size()), 112.0, 4.0);
}

TEST(RockLod, ErrorIsInMetres) {
    const auto rocks = build_rock_meshes(one_rock(test::lobed_rock({400, 300}, 80, 3)));
    TriMesh big = rocks[0].mesh;
    for (glm::vec3& p : big.positions)
        p *= 100.0F;
    const auto chain = build_lod_chain(rocks[0].mesh);
    const auto large = build_lod_chain(big);
    for (std::size_t k = 1; k < chain.size(); ++k) {
        EXPECT_NEAR(large[k].error, 100.0 * chain[k].error, 0.05 * large[k].error);
        const double measured = deviation(chain[0].mesh, chain[k].mesh);
        EXPECT_LT(measured, 4.0 * chain[k].error);  // the estimate is a mean over planes
        EXPECT_GT(measured, 0.25 * chain[k].error);
    }
}

TEST(RockLod, StopsAtTheErrorLimitAndAtTheFewestTriangles) {
    const auto rocks = build_rock_meshes(one_rock(test::lobed_rock({400, 300}, 80, 3)));
    const auto strict = build_lod_chain(rocks[0].mesh, {.levels = 16, .max_error = 0.002});
    EXPECT_LE(strict.back().error, 0.002 * 0.25);
    const auto small = build_lod_chain(rocks[0].mesh, {.levels = 16, .min_triangles = 100});
    EXPECT_GE(small.back().mesh.triangles.size(), 100U);
}

TEST(RockLod, TakesTheLiteralMeshToo) {
    const auto rocks = build_rock_meshes(one_rock(test::lobed_rock({400, 300}, 80, 3)),
                                         {.reading = Reading::Literal});
    for (const LodLevel& level : build_lod_chain(rocks[0].mesh))
        test::expect_valid(level.mesh);
}

TEST(RockLod, ThreadsDoNotMatter) {
    const auto rocks = build_rock_meshes(test::rock_set(40, 3));
    const auto many = build_lod_chains(rocks);
    const ThreadLimit one(1);
    const auto few = build_lod_chains(rocks);
    for (std::size_t i = 0; i < many.size(); ++i) {
        ASSERT_EQ(many[i].size(), few[i].size());
        for (std::size_t k = 0; k < many[i].size(); ++k)
            EXPECT_EQ(many[i][k].mesh.triangles, few[i][k].mesh.triangles);
    }
}

TEST(RockLodErrors, AreSentences) {
    EXPECT_THAT(
        [] { build_lod_chain({}); },
        testing::ThrowsMessage<InvalidInput>("a mesh without triangles has no levels of detail"));
    EXPECT_THAT([] { build_lod_chain({}, {.ratio = 1.0}); },
                testing::ThrowsMessage<InvalidOption>("ratio is 1, must be in [0.05, 0.95]"));
}

}  // namespace
}  // namespace scree::meshing
