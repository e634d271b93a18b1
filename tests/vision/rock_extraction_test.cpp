#include "vision/rock_extraction.h"

#include "base/error.h"
#include "base/parallel.h"
#include "testdata/synthetic_photo.h"
#include "vision/data/metrics.h"

#include <atomic>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

const test::SyntheticPhoto& pebbles() {
    static const test::SyntheticPhoto made = test::make_synthetic_photo({.width = 900,
                                                                         .height = 180,
                                                                         .least_diameter = 24,
                                                                         .greatest_diameter = 80,
                                                                         .gap = 6,
                                                                         .seed = 5});
    return made;
}

class ByMethod : public testing::TestWithParam<Method> {};

TEST_P(ByMethod, GivesRocksStagesAndItsName) {
    const auto result = extract_rocks(pebbles().photo, {.method = GetParam(), .keep_stages = true});
    EXPECT_FALSE(result.rocks.rocks.empty());
    EXPECT_EQ(result.rocks.width, 900);
    EXPECT_EQ(result.rocks.height, 180);
    EXPECT_GE(result.stages.size(), 2U);
    for (const auto& [name, picture] : result.stages)
        EXPECT_FALSE(picture.empty()) << name;
    EXPECT_EQ(result.rocks.method, names_of(GetParam())[static_cast<std::size_t>(GetParam())]);
}

TEST_P(ByMethod, GivesNoRockSmallerThanAsked) {
    const auto result = extract_rocks(pebbles().photo, {.method = GetParam(), .min_size = 35});
    ASSERT_FALSE(result.rocks.rocks.empty());
    for (const Rock& rock : result.rocks.rocks)
        EXPECT_GE(equivalent_diameter(rock.outline), 35.0);
}

TEST_P(ByMethod, FindsNothingOnABlankPicture) {
    for (const int value : {0, 128, 255}) {
        const Photo blank(200, 150, glm::u8vec3(static_cast<std::uint8_t>(value)));
        EXPECT_TRUE(extract_rocks(blank, {.method = GetParam()}).rocks.rocks.empty()) << value;
    }
}

TEST(RockExtraction, DoesNotDependOnTheThreadCount) {
    const auto centres = [](int n_threads) {
        const ThreadLimit limit(n_threads);
        std::vector<glm::dvec2> all;
        for (const Rock& rock : extract_rocks(pebbles().photo).rocks.rocks)
            all.push_back(rock.outline.centre);
        return all;
    };
    EXPECT_EQ(centres(1), centres(4));
}

INSTANTIATE_TEST_SUITE_P(Methods, ByMethod,
                         testing::Values(Method::Classical, Method::Thesis, Method::Learned),
                         [](const auto& method) {
                             return std::string(
                                 names_of(method.param)[static_cast<std::size_t>(method.param)]);
                         });

TEST(RockExtraction, FindsMostOfTheRocksOfASyntheticPhotograph) {
    std::vector<Outline> outlines;
    for (const Rock& rock : extract_rocks(pebbles().photo).rocks.rocks)
        outlines.push_back(rock.outline);
    const LabelScore score = score_labels(paint_labels(outlines, 900, 180), pebbles().labels);
    EXPECT_GT(score.f1, 0.8);
    EXPECT_GT(score.iou, 0.85);
}

TEST(RockExtraction, UnrefinedRocksHaveTheirLeastRadiusAsDepth) {
    const auto result = extract_rocks(pebbles().photo, {.refine = false});
    EXPECT_TRUE(result.stages.empty());
    for (const Rock& rock : result.rocks.rocks) {
        EXPECT_EQ(rock.depth,
                  *std::min_element(rock.outline.radii.begin(), rock.outline.radii.end()));
        EXPECT_EQ(rock.uncertainty, 0.0F);
    }
}

TEST(RockExtraction, ReadingChangesWhatTheThesisMethodFinds) {
    const auto n_rocks = [](Reading reading) {
        return extract_rocks(pebbles().photo, {.method = Method::Thesis, .reading = reading})
            .rocks.rocks.size();
    };
    EXPECT_NE(n_rocks(Reading::Sound), n_rocks(Reading::Literal));
}

TEST(RockExtraction, RefusesAnEmptyPhotographAndStopsWhenAsked) {
    EXPECT_THROW(extract_rocks(Photo{}), InvalidInput);
    EXPECT_THROW(extract_rocks(pebbles().photo, {.min_size = 1}), InvalidOption);
    class Stop : public Progress {
        void report(std::string_view, double) override {}
        bool cancelled() const override { return true; }
    } stop;
    EXPECT_THROW(extract_rocks(pebbles().photo, {}, &stop), Cancelled);
}

// Asks for a stop a little after a stage has begun, as a person does.
class StopsWithin : public Progress {
public:
    explicit StopsWithin(std::string_view stage) : stage_(stage) {}
    void report(std::string_view stage, double) override { begun_ = begun_ || stage == stage_; }
    bool cancelled() const override { return begun_ && ++n_asked_ > 3; }

private:
    std::string_view stage_;
    std::atomic<bool> begun_{false};
    mutable std::atomic<int> n_asked_{0};
};

TEST(RockExtraction, StopsWithinOutlinesAndWithinTheirRefinement) {
    for (const char* stage : {"finding outlines", "refining outlines"}) {
        StopsWithin progress(stage);
        EXPECT_THAT(
            [&] { extract_rocks(pebbles().photo, {.method = Method::Classical}, &progress); },
            testing::ThrowsMessage<Cancelled>(testing::HasSubstr(stage)));
    }
}

}  // namespace
}  // namespace scree::vision
