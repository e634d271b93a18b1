#include "meshing/rocks/silhouette.h"

#include "base/error.h"
#include "meshing/rocks/rock_mesh.h"
#include "tests/support/rock_samples.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

constexpr double kPi = std::numbers::pi;

Silhouette star(std::uint64_t seed, double least, double most) {
    Rng rng({.seed = seed, .stream = 3});
    Silhouette shape;
    for (std::size_t k = 0; k < kSilhouetteCorners; ++k) {
        const double a = 2.0 * kPi * static_cast<double>(k) / kSilhouetteCorners;
        const double r = rng.uniform(least, most);
        shape.corners[k] = r * glm::dvec2(std::cos(a), std::sin(a));
        shape.radius = std::max(shape.radius, static_cast<float>(r));
    }
    return shape;
}

// Inside test by the sign of the sector's edge; corners stand at whole steps.
bool inside(const Silhouette& shape, glm::vec2 p) {
    const double at = std::atan2(p.y, p.x) / (2.0 * kPi) * kSilhouetteCorners;
    const auto k = static_cast<std::size_t>(at < 0 ? at + kSilhouetteCorners : at);
    const glm::vec2 a = shape.corners[k % kSilhouetteCorners];
    const glm::vec2 b = shape.corners[(k + 1) % kSilhouetteCorners];
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0.0F;
}

bool overlap_by_sampling(const Silhouette& a, const Silhouette& b, glm::vec2 offset) {
    constexpr int kSide = 200;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const glm::vec2 p =
                a.radius *
                (glm::vec2(static_cast<float>(i), static_cast<float>(j)) / 100.0F - 1.0F);
            if (inside(a, p) && inside(b, p - offset))
                return true;
        }
    return false;
}

TEST(Silhouette, HoldsTheRockSeenFromAbove) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        vision::RockSet set = test::rock_set(3, seed);
        set.rocks.push_back(test::jagged_rock({100, 100}, 5, 50, seed));
        for (const RockMesh& rock : build_rock_meshes(set)) {
            const Silhouette shape = silhouette_of(rock.mesh);
            for (const glm::uvec3& t : rock.mesh.triangles)
                for (int k = 0; k < 3; ++k)
                    for (const float share : {0.0F, 0.3F, 0.6F}) {
                        const glm::vec3 p = glm::mix(rock.mesh.positions[t[k]],
                                                     rock.mesh.positions[t[(k + 1) % 3]], share);
                        EXPECT_TRUE((p.x == 0.0F && p.z == 0.0F) ||
                                    inside(shape, 0.99999F * glm::vec2(p.x, p.z)));
                    }
        }
    }
}

TEST(Silhouette, IsTightOnADisc) {
    vision::RockSet set = test::rock_set(0, 0);
    set.rocks = {test::rock_of(test::outline_of({450, 300}, [](double) { return 100.0; }))};
    const auto rock = build_rock_meshes(set, {.max_segments = 128})[0];
    const double area = area_of(silhouette_of(rock.mesh));
    EXPECT_NEAR(area, kPi * 0.01, 0.01 * kPi * 0.01);
    EXPECT_GE(silhouette_of(rock.mesh).radius, 0.1F);
}

TEST(Silhouette, TurnsAsAnInstanceDoes) {
    Silhouette shape = star(1, 1, 2);
    shape.corners[0] = {3, 0};
    const Silhouette turned = placed(shape, 2.0, 0.5 * kPi);  // +x turns to -z
    EXPECT_NEAR(turned.corners[0].x, 0.0, 1e-6);
    EXPECT_NEAR(turned.corners[0].y, -6.0, 1e-6);
    EXPECT_NEAR(area_of(turned), 4.0 * area_of(shape), 1e-4 * area_of(turned));
    EXPECT_EQ(turned.radius, 2.0F * shape.radius);
}

TEST(Silhouette, OverlapAgreesWithSampling) {
    int overlapping = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        Rng rng({.seed = seed, .stream = 4});
        const Silhouette a = star(2 * seed, 0.3, 1.0);
        const Silhouette b = placed(star(2 * seed + 1, 0.3, 1.0), rng.uniform(0.2, 1.0), 0.0);
        const glm::vec2 offset(rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5));
        const bool sampled = overlap_by_sampling(a, b, offset);
        // Sampling misses slivers but invents nothing.
        EXPECT_TRUE(!sampled || overlap(a, b, offset)) << "seed " << seed;
        EXPECT_TRUE(!overlap(a, b, offset) || sampled ||
                    overlap_by_sampling(a, placed(b, 1.25, 0.0), offset))
            << "seed " << seed;
        overlapping += sampled ? 1 : 0;
    }
    EXPECT_GT(overlapping, 30);
    EXPECT_LT(overlapping, 120);
}

TEST(Silhouette, OneInsideTheOtherOverlaps) {
    const Silhouette large = star(1, 2, 3);
    const Silhouette small = placed(star(2, 2, 3), 0.1, 0.4);
    EXPECT_TRUE(overlap(large, small, {0.5F, 0.5F}));
    EXPECT_TRUE(overlap(small, large, {-0.5F, -0.5F}));
    EXPECT_FALSE(overlap(large, small, {6.0F, 0.0F}));
}

TEST(SilhouetteErrors, AreSentences) {
    EXPECT_THAT([] { silhouette_of({}); },
                testing::ThrowsMessage<InvalidInput>(
                    "the mesh covers no ground about its origin; its silhouette is empty"));
}

}  // namespace
}  // namespace scree::meshing
