#include "testdata/synthetic_photo.h"
#include "tests/vision/learned/found_labels.h"
#include "vision/data/metrics.h"

#include <functional>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

const test::SyntheticPhoto& heap() {
    static const test::SyntheticPhoto made = test::make_synthetic_photo({.width = 384,
                                                                         .height = 256,
                                                                         .least_diameter = 18,
                                                                         .greatest_diameter = 60,
                                                                         .gap = 3,
                                                                         .speckle = 0.1,
                                                                         .seed = 11});
    return made;
}

// Every pixel of the result comes from where `source` says.
template <class Pixel>
Raster<Pixel> moved(const Raster<Pixel>& from, int width, int height,
                    const std::function<glm::ivec2(int, int)>& source) {
    Raster<Pixel> to(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::ivec2 at = source(x, y);
            to(x, y) = from(at.x, at.y);
        }
    return to;
}

// Nine rocks in ten are found in both, with nine tenths of their areas in common.
void expect_same_rocks(const LabelMap& found, const LabelMap& expected) {
    const LabelScore score = score_labels(found, expected);
    EXPECT_GT(score.n_truth, 30);
    EXPECT_GT(score.f1, 0.9);
    EXPECT_GT(score.iou, 0.9);
}

TEST(TurnedPicture, AQuarterTurnGivesTheSameRocks) {
    const Photo& photo = heap().photo;
    const auto source = [&](int x, int y) { return glm::ivec2(y, photo.height() - 1 - x); };
    const Photo turned = moved<glm::u8vec3>(photo, photo.height(), photo.width(), source);
    expect_same_rocks(
        found_labels(turned),
        moved<std::uint16_t>(found_labels(photo), photo.height(), photo.width(), source));
}

TEST(TurnedPicture, TheMirrorImageGivesTheSameRocks) {
    const Photo& photo = heap().photo;
    const auto source = [&](int x, int y) { return glm::ivec2(photo.width() - 1 - x, y); };
    const Photo mirrored = moved<glm::u8vec3>(photo, photo.width(), photo.height(), source);
    expect_same_rocks(
        found_labels(mirrored),
        moved<std::uint16_t>(found_labels(photo), photo.width(), photo.height(), source));
}

TEST(TurnedPicture, TwiceTheSizeGivesTheSameRocks) {
    const Photo& photo = heap().photo;
    const auto source = [](int x, int y) { return glm::ivec2(x / 2, y / 2); };
    const Photo large = moved<glm::u8vec3>(photo, 2 * photo.width(), 2 * photo.height(), source);
    const LabelScore score = score_labels(
        found_labels(large),
        moved<std::uint16_t>(found_labels(photo), large.width(), large.height(), source));
    EXPECT_GT(score.f1, 0.85);  // rocks near the least size come and go
    EXPECT_GT(score.iou, 0.85);
}

TEST(TurnedPicture, TheRocksAreThere) {
    const LabelScore score = score_labels(found_labels(heap().photo), heap().labels);
    EXPECT_GT(score.f1, 0.85);
    EXPECT_GT(score.iou, 0.85);
}

}  // namespace
}  // namespace scree::vision
