#include "vision/classical/classical_edge_detector.h"

#include "base/error.h"
#include "base/parallel.h"
#include "testdata/synthetic_photo.h"

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

TEST(ClassicalEdgeDetector, FillsAllChannelsWithShares) {
    for (const auto& [w, h] : {std::pair{1, 1}, {3, 90}, {70, 45}}) {
        const EdgeField field = ClassicalEdgeDetector().detect(Photo(w, h, {120, 110, 90}));
        for (const auto* channel : {&field.boundary, &field.inside, &field.distance}) {
            EXPECT_EQ(channel->width(), w);
            EXPECT_EQ(channel->height(), h);
            for (const float v : *channel) {
                ASSERT_GE(v, 0.0F);
                ASSERT_LE(v, 1.0F);
            }
        }
    }
}

TEST(ClassicalEdgeDetector, SameBytesForAnyThreadCount) {
    const auto made = test::make_synthetic_photo({.width = 300, .height = 240, .n_rocks = 80});
    EdgeField one, four;
    {
        const ThreadLimit limit(1);
        one = ClassicalEdgeDetector().detect(made.photo);
    }
    {
        const ThreadLimit limit(4);
        four = ClassicalEdgeDetector().detect(made.photo);
    }
    EXPECT_EQ(one.boundary, four.boundary);
    EXPECT_EQ(one.inside, four.inside);
    EXPECT_EQ(one.distance, four.distance);
}

TEST(ClassicalEdgeDetector, BordersOutweighInteriors) {
    const auto made = test::make_synthetic_photo({.width = 400, .height = 300, .n_rocks = 60});
    const EdgeField field = ClassicalEdgeDetector().detect(made.photo);
    double on = 0, n_on = 0, deep = 0, n_deep = 0;
    for (const auto& rock : made.outlines) {
        for (int k = 0; k < kRadii; k += 4) {
            const glm::dvec2 p = border_point(rock, k), q = 0.5 * (p + rock.centre);
            for (const auto& [at, sum, n] : {std::tuple{p, &on, &n_on}, {q, &deep, &n_deep}}) {
                const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
                if (!field.boundary.contains(x, y))
                    continue;
                *sum += field.boundary(x, y);
                *n += 1;
            }
        }
    }
    EXPECT_GT(on / n_on, 2 * deep / n_deep);
}

TEST(ClassicalEdgeDetector, EmptyPhotographIsRefused) {
    EXPECT_THAT([] { ClassicalEdgeDetector().detect(Photo()); },
                testing::ThrowsMessage<InvalidInput>("the photograph has no pixels"));
}

}  // namespace
}  // namespace scree::vision
