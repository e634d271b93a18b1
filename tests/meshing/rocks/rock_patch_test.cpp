#include "meshing/rocks/rock_patch.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/rocks/silhouette.h"
#include "tests/support/rock_samples.h"

#include <cmath>
#include <map>

#include <glm/ext/quaternion_common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

std::vector<RockMesh> gravel(int n, std::uint64_t seed) {
    return build_rock_meshes(test::rock_set(n, seed), {.max_segments = 16});
}

struct Lying {
    Silhouette shape;
    glm::dvec2 position;
};

std::vector<Lying> lying_stones(const RockPatch& patch, const std::vector<RockMesh>& rocks) {
    std::vector<Lying> stones;
    for (const PatchInstance& i : patch.instances) {
        const double yaw =
            2.0 * std::atan2(static_cast<double>(i.rotation.y), static_cast<double>(i.rotation.w));
        stones.push_back({placed(silhouette_of(rocks[patch.prototypes[i.prototype]].mesh),
                                 static_cast<double>(i.scale.x), yaw),
                          {i.translation.x, i.translation.z}});
    }
    return stones;
}

// Pairs that overlap if the patch is tiled. A hair is taken off, for positions are floats.
int overlaps(const RockPatch& patch, const std::vector<RockMesh>& rocks) {
    std::vector<Lying> stones = lying_stones(patch, rocks);
    for (Lying& stone : stones)
        stone.shape = placed(stone.shape, 0.9999, 0.0);
    int n = 0;
    for (std::size_t i = 0; i < stones.size(); ++i)
        for (std::size_t j = i + 1; j < stones.size(); ++j) {
            glm::dvec2 way = stones[j].position - stones[i].position;
            way -= patch.size * glm::round(way / patch.size);
            n += overlap(stones[i].shape, stones[j].shape, glm::vec2(way)) ? 1 : 0;
        }
    return n;
}

std::map<std::uint32_t, int> multiset(const RockPatch& patch) {
    std::map<std::uint32_t, int> counts;
    for (const PatchInstance& i : patch.instances)
        ++counts[static_cast<std::uint32_t>(patch.prototypes[i.prototype])];
    return counts;
}

class RockPatches : public testing::TestWithParam<unsigned> {};  // the parameter is a seed

TEST_P(RockPatches, HoldEveryRockOnceWithoutOverlap) {
    const auto rocks = gravel(150, GetParam());
    const RockPatch patch = rearrange_rocks(rocks, 2, {.seed = GetParam()});
    EXPECT_EQ(overlaps(patch, rocks), 0);
    ASSERT_EQ(patch.instances.size(), 300U);
    for (const auto& [rock, count] : multiset(patch))
        EXPECT_EQ(count, 2) << "rock " << rock;
    EXPECT_EQ(patch.report.left_out, 0U);
    EXPECT_GE(patch.report.coverage, patch.report.coverage_by_darts);
    for (const PatchInstance& i : patch.instances) {
        EXPECT_NEAR(glm::length(i.rotation), 1.0, 1e-6);
        EXPECT_LE(std::abs(static_cast<double>(i.translation.x)), 0.5 * patch.size.x + 1e-6);
        EXPECT_LE(std::abs(static_cast<double>(i.translation.z)), 0.5 * patch.size.y + 1e-6);
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, RockPatches, testing::Range(0U, 5U));

TEST(RockPatch, ClosingGapsCoversMoreGround) {
    for (const unsigned seed : {1U, 2U, 3U}) {
        const auto rocks = gravel(200, seed);
        const RockPatch darts = rearrange_rocks(rocks, 1, {.sweeps = 0, .seed = seed});
        const RockPatch closed = rearrange_rocks(rocks, 1, {.seed = seed});
        EXPECT_EQ(darts.report.coverage, darts.report.coverage_by_darts);
        EXPECT_EQ(closed.report.coverage_by_darts, darts.report.coverage_by_darts);
        EXPECT_GT(closed.report.coverage, 1.2 * darts.report.coverage) << "seed " << seed;
        EXPECT_LT(closed.size.x, darts.size.x) << "seed " << seed;
    }
}

TEST(RockPatch, KeepsAGivenSizeAndCountsWhatFoundNoRoom) {
    const auto rocks = gravel(400, 3);
    const RockPatch free = rearrange_rocks(rocks);
    const RockPatch tight = rearrange_rocks(rocks, 1, {.width = 0.9 * free.size.x});
    EXPECT_EQ(tight.size, glm::dvec2(0.9 * free.size.x));
    EXPECT_GT(tight.report.left_out, 0U);
    EXPECT_LT(tight.report.left_out, 300U);
    EXPECT_EQ(tight.report.left_out + tight.instances.size(), 400U);
    EXPECT_EQ(overlaps(tight, rocks), 0);
    const RockPatch wide = rearrange_rocks(rocks, 1, {.width = 3.0, .depth = 2.0});
    EXPECT_EQ(wide.size, glm::dvec2(3.0, 2.0));
    EXPECT_EQ(wide.report.left_out, 0U);
    const RockPatch close = rearrange_rocks(rocks, 1, {.depth = 1.05 * free.size.x});
    EXPECT_EQ(close.size, glm::dvec2(1.05 * free.size.x));
    EXPECT_EQ(close.report.left_out, 0U);
}

// Highest stone over each place of a grid, the patch repeated beyond its borders.
std::vector<double> height_picture(const RockPatch& patch, const std::vector<RockMesh>& rocks,
                                   int side) {
    std::vector<double> heights(static_cast<std::size_t>(side * side), 0.0);
    for (const PatchInstance& i : patch.instances) {
        const RockMesh& rock = rocks[patch.prototypes[i.prototype]];
        const double radius = static_cast<double>(rock.bounding_radius * i.scale.x);
        const double x = (static_cast<double>(i.translation.x) / patch.size.x + 0.5) * side;
        const double z = (static_cast<double>(i.translation.z) / patch.size.y + 0.5) * side;
        const double reach = radius / patch.size.x * side;
        const auto steps = static_cast<int>(std::ceil(reach));
        for (int dz = -steps; dz <= steps; ++dz)
            for (int dx = -steps; dx <= steps; ++dx) {
                const double inside = 1.0 - (dx * dx + dz * dz) / (reach * reach);
                if (inside <= 0.0)
                    continue;
                const int column = ((static_cast<int>(x) + dx) % side + side) % side;
                const int row = ((static_cast<int>(z) + dz) % side + side) % side;
                double& height = heights[static_cast<std::size_t>(row * side + column)];
                height = std::max(height, radius * std::sqrt(inside));
            }
    }
    return heights;
}

// Greatest correlation of the picture with itself shifted by whole patches, columns and rows.
double repetition(const std::vector<double>& picture, int side, int patches) {
    const std::size_t n = picture.size();
    double mean = 0.0;
    for (const double h : picture)
        mean += h / static_cast<double>(n);
    const auto correlation = [&](int dx, int dy) {
        double product = 0.0;
        double square = 0.0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const double a = picture[static_cast<std::size_t>(y * side + x)] - mean;
                const double b =
                    picture[static_cast<std::size_t>((y + dy) % side * side + (x + dx) % side)] -
                    mean;
                product += a * b;
                square += a * a;
            }
        return product / square;
    };
    double greatest = 0.0;
    for (int i = 0; i < patches; ++i)
        for (int j = 0; j < patches; ++j)
            if (i + j > 0)
                greatest = std::max(greatest, correlation(i * side / patches, j * side / patches));
    return greatest;
}

TEST(RockPatch, RepeatsFarLessThanIdenticalPatches) {
    const auto rocks = build_rock_meshes(test::rock_set(60, 8, 600, 600), {.max_segments = 8});
    const RockPatch plain = repeat_rocks(rocks, {0.6, 0.6}, 4, 4);
    const RockPatch arranged = rearrange_rocks(rocks, 16);
    constexpr int kSide = 256;
    const double before = repetition(height_picture(plain, rocks, kSide), kSide, 4);
    const double after = repetition(height_picture(arranged, rocks, kSide), kSide, 4);
    EXPECT_GT(before, 0.99);
    EXPECT_LT(after, 0.2);
}

TEST(RockPatch, OtherSeedsGiveOtherPatches) {
    const auto rocks = gravel(50, 3);
    const RockPatch first = rearrange_rocks(rocks, 1, {.seed = 1});
    EXPECT_NE(first.instances[0].translation,
              rearrange_rocks(rocks, 1, {.seed = 2}).instances[0].translation);
    EXPECT_EQ(first.instances[0].translation,
              rearrange_rocks(rocks, 1, {.seed = 1}).instances[0].translation);
}

TEST(RockPatch, GridOfIdenticalPatchesPutsEveryRockWhereThePhotographHasIt) {
    const auto rocks = gravel(492, 5);
    const RockPatch patch = repeat_rocks(rocks, {0.9, 0.6}, 10, 10);
    ASSERT_EQ(patch.instances.size(), 49200U);
    EXPECT_DOUBLE_EQ(patch.size.x, 9.0);
    EXPECT_DOUBLE_EQ(patch.size.y, 6.0);
    for (std::size_t i = 0; i < patch.instances.size(); i += 97) {
        const PatchInstance& instance = patch.instances[i];
        ASSERT_EQ(instance.prototype, i / 100);
        const double column = static_cast<double>(i % 10);
        const double row = static_cast<double>(i % 100 / 10);
        const glm::vec3 home = rocks[instance.prototype].position;
        EXPECT_NEAR(static_cast<double>(instance.translation.x - home.x), (column - 4.5) * 0.9,
                    1e-5);
        EXPECT_NEAR(static_cast<double>(instance.translation.z - home.z), (row - 4.5) * 0.6, 1e-5);
        EXPECT_EQ(instance.scale, glm::vec3(1.0F));
        EXPECT_EQ(instance.rotation, glm::quat(1, 0, 0, 0));
    }
}

TEST(RockPatch, ScatterDrawsTheSizesOfTheRockSet) {
    const auto rocks = gravel(300, 6);
    const RockPatch patch = scatter_rocks(rocks, 2000, {.prototypes = 20});
    EXPECT_EQ(patch.prototypes.size(), 20U);
    ASSERT_EQ(patch.instances.size(), 2000U);
    EXPECT_EQ(overlaps(patch, rocks), 0);
    std::vector<float> drawn;
    for (const PatchInstance& i : patch.instances)
        drawn.push_back(rocks[patch.prototypes[i.prototype]].bounding_radius * i.scale.x);
    std::vector<float> wanted;
    for (const RockMesh& rock : rocks)
        wanted.push_back(rock.bounding_radius);
    std::sort(drawn.begin(), drawn.end());
    std::sort(wanted.begin(), wanted.end());
    for (const double q : {0.16, 0.5, 0.84}) {
        const auto at = [&](const std::vector<float>& sizes) {
            return static_cast<double>(
                sizes[static_cast<std::size_t>(q * static_cast<double>(sizes.size()))]);
        };
        EXPECT_NEAR(at(drawn) / at(wanted), 1.0, 0.08) << "quantile " << q;
    }
}

TEST(RockPatch, RestingRocksStandOnTheGround) {
    const auto rocks = build_rock_meshes(test::rock_set(30, 6), {.base = RockBase::Resting});
    for (const PatchInstance& i : scatter_rocks(rocks, 50).instances) {
        const RockMesh& rock =
            rocks[static_cast<std::size_t>(scatter_rocks(rocks, 50).prototypes[i.prototype])];
        EXPECT_NEAR(i.translation.y + i.scale.y * rock.box_min.y, 0.0, 1e-6);
    }
}

TEST(RockPatch, ThreadsDoNotMatter) {
    const auto rocks = gravel(60, 3);
    const RockPatch many = scatter_rocks(rocks, 200);
    const ThreadLimit one(1);
    const RockPatch few = scatter_rocks(rocks, 200);
    ASSERT_EQ(many.instances.size(), few.instances.size());
    for (std::size_t i = 0; i < many.instances.size(); ++i) {
        EXPECT_EQ(many.instances[i].translation, few.instances[i].translation);
        EXPECT_EQ(many.instances[i].rotation, few.instances[i].rotation);
    }
}

TEST(RockPatch, OneRockAndNone) {
    const auto rocks = gravel(1, 3);
    EXPECT_EQ(rearrange_rocks(rocks).instances.size(), 1U);
    EXPECT_TRUE(rearrange_rocks({}).instances.empty());
    EXPECT_TRUE(repeat_rocks({}, {1, 1}, 3, 3).instances.empty());
}

TEST(RockPatchErrors, NameTheValue) {
    const auto rocks = gravel(3, 3);
    EXPECT_THAT([&] { rearrange_rocks(rocks, 0); },
                testing::ThrowsMessage<InvalidOption>("copies is 0, must be at least 1"));
    EXPECT_THAT([&] { scatter_rocks(rocks, 0); },
                testing::ThrowsMessage<InvalidOption>("count is 0, must be in [1, 1000000]"));
    EXPECT_THAT([&] { scatter_rocks({}, 5); },
                testing::ThrowsMessage<InvalidInput>("there are no rocks to scatter"));
    EXPECT_THROW(rearrange_rocks(rocks, 1000000), InvalidInput);
    EXPECT_THAT(
        [&] { rearrange_rocks(rocks, 1, {.width = 0.001}); },
        testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("needs a patch of at least")));
    EXPECT_THROW(repeat_rocks(rocks, {0, 1}, 1, 1), InvalidOption);
    EXPECT_THROW(repeat_rocks(rocks, {1, 1}, 100000, 100000), InvalidOption);
}

}  // namespace
}  // namespace scree::meshing
