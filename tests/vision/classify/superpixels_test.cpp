#include "vision/classify/superpixels.h"

#include "base/error.h"

#include <set>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

using Lab = Raster<glm::vec3>;

// Number of connected parts that the ids fall into.
int parts_of(const Raster<std::int32_t>& ids) {
    Mask seen(ids.width(), ids.height());
    int parts = 0;
    for (int y = 0; y < ids.height(); ++y)
        for (int x = 0; x < ids.width(); ++x) {
            if (seen(x, y) != 0)
                continue;
            ++parts;
            std::vector<glm::ivec2> open{{x, y}};
            seen(x, y) = 1;
            while (!open.empty()) {
                const glm::ivec2 at = open.back();
                open.pop_back();
                for (const glm::ivec2 step :
                     {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
                    const glm::ivec2 next = at + step;
                    if (ids.contains(next.x, next.y) && seen(next.x, next.y) == 0 &&
                        ids(next.x, next.y) == ids(x, y)) {
                        seen(next.x, next.y) = 1;
                        open.push_back(next);
                    }
                }
            }
        }
    return parts;
}

Lab checks(int width, int height) {
    Lab lab(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            lab(x, y) = {static_cast<float>((x * 7919 + y * 104729) % 61 + x / 19 % 2 * 30), 0, 0};
    return lab;
}

TEST(Superpixels, CoverThePictureWithConnectedPieces) {
    for (const int width : {5, 61, 130}) {
        const Superpixels pieces = superpixels(checks(width, 47), {.size_px = 9});
        std::set<std::int32_t> ids(pieces.ids.begin(), pieces.ids.end());
        EXPECT_EQ(static_cast<int>(ids.size()), pieces.count);
        EXPECT_EQ(*ids.begin(), 0);
        EXPECT_EQ(*ids.rbegin(), pieces.count - 1);
        EXPECT_EQ(parts_of(pieces.ids), pieces.count);
    }
}

TEST(Superpixels, KeepToAStrongEdge) {
    Lab lab(60, 60);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x)
            lab(x, y) = {x + y / 4 < 34 ? 20.0F : 80.0F, 0, 0};
    const Superpixels pieces = superpixels(lab, {.size_px = 10});
    std::vector<int> dark(static_cast<std::size_t>(pieces.count));
    std::vector<int> all(dark.size());
    for (std::size_t i = 0; i < lab.size(); ++i) {
        const auto id = static_cast<std::size_t>(pieces.ids.data()[i]);
        dark[id] += lab.data()[i].x < 50 ? 1 : 0;
        ++all[id];
    }
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_TRUE(dark[i] == 0 || dark[i] == all[i]) << dark[i] << " of " << all[i];
}

TEST(Superpixels, EvenColourGivesSquares) {
    const Superpixels pieces = superpixels(Lab(40, 30), {.size_px = 10});
    EXPECT_EQ(pieces.count, 12);
    EXPECT_EQ(superpixels({}, {}).count, 0);
}

TEST(Superpixels, LabOfKnownColours) {
    Photo photo(2, 1);
    photo(0, 0) = {255, 255, 255};
    photo(1, 0) = {255, 0, 0};
    const Raster<glm::vec3> lab = lab_of(photo);
    EXPECT_NEAR(lab(0, 0).x, 100, 0.1);
    EXPECT_NEAR(lab(1, 0).x, 53.2, 0.5);
    EXPECT_NEAR(lab(1, 0).y, 80.1, 0.7);
    EXPECT_NEAR(lab(1, 0).z, 67.2, 0.7);
}

TEST(SuperpixelsErrors, ThrowOnASizeOutOfRange) {
    EXPECT_THROW(superpixels(Lab(8, 8), {.size_px = 1}), InvalidOption);
}

}  // namespace
}  // namespace scree::vision
