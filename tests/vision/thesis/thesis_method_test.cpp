#include "vision/thesis/thesis_method.h"

#include "base/error.h"
#include "base/parallel.h"
#include "tests/vision/thesis/masks.h"
#include "vision/data/metrics.h"
#include "vision/thesis/baseline_detectors.h"
#include "vision/thesis/ray_outline_finder.h"
#include "vision/thesis/working_size.h"

#include <algorithm>
#include <map>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

ThesisOptions unscaled() {
    ThesisOptions options;
    options.working_width = 0;
    return options;
}

Mask mask_of(const EdgeField& field) {
    Mask mask(field.boundary.width(), field.boundary.height());
    std::transform(field.boundary.begin(), field.boundary.end(), mask.begin(),
                   [](float b) { return static_cast<std::uint8_t>(b >= 0.5F ? 1 : 0); });
    return mask;
}

std::vector<Outline> outlines_of(const ThesisResult& result) {
    std::vector<Outline> outlines;
    for (const Rock& rock : result.rocks)
        outlines.push_back(rock.outline);
    return outlines;
}

TEST(WorkingSize, WidthIs900AndTheAspectRatioStays) {
    EXPECT_EQ(working_size({1800, 1200}, 900), glm::ivec2(900, 600));
    EXPECT_EQ(working_size({512, 512}, 900), glm::ivec2(900, 900));
    EXPECT_EQ(working_size({4000, 3000}, 900), glm::ivec2(900, 675));
    EXPECT_EQ(working_size({1281, 961}, 0), glm::ivec2(1281, 961));
    EXPECT_EQ(working_size({10000, 1}, 900), glm::ivec2(900, 1));
    const glm::ivec2 tall = working_size({1, 10000}, 900);
    EXPECT_LE(1.0 * tall.x * tall.y, 1.01 * kGreatestWorkingPixels);
    EXPECT_EQ(scaled_photo(Photo(1800, 1200, glm::u8vec3(7)), {900, 600}),
              Photo(900, 600, glm::u8vec3(7)));
}

TEST(WorkingSize, MasksStayWholeAndOutlinesScale) {
    Mask circle(200, 200);
    test::draw_circle(circle, {100, 100}, 80);
    for (const glm::ivec2 size : {glm::ivec2(90, 90), glm::ivec2(450, 450)}) {
        const RayCaster caster(scaled_mask(circle, size));
        for (const glm::dvec2 d : ray_directions(360)) {
            const auto hit = caster.cast(glm::dvec2(size) / 2.0, d);
            ASSERT_TRUE(hit);
            EXPECT_NEAR(hit->distance, 80.0 * size.x / 200, 4.0);
        }
    }
    Outline disc;
    disc.centre = {10, 20};
    disc.radii.fill(4);
    EXPECT_NEAR(scaled_outline(disc, {2, 2}).radii[33], 8, 1e-6);
    const Outline wide = scaled_outline(disc, {3, 2});
    EXPECT_NEAR(wide.radii[0], 12, 1e-3);
    EXPECT_NEAR(wide.radii[90], 8, 1e-3);
    EXPECT_NEAR(wide.centre.x, 30, 1e-9);
}

// Per rock of the truth the best intersection over union with any found one.
std::vector<double> best_overlaps(const LabelMap& found, const LabelMap& truth) {
    std::map<std::pair<int, int>, double> both;
    std::map<int, double> n_found;
    std::map<int, double> n_truth;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        ++both[{truth.data()[i], found.data()[i]}];
        ++n_found[found.data()[i]];
        ++n_truth[truth.data()[i]];
    }
    std::map<int, double> best;
    for (const auto& [labels, shared] : both)
        if (labels.first != 0) {
            double& b = best[labels.first];
            const double either = n_truth[labels.first] + n_found[labels.second] - shared;
            b = std::max(b, labels.second == 0 ? 0.0 : shared / either);
        }
    std::vector<double> values;
    for (const auto& [label, value] : best)
        values.push_back(value);
    return values;
}

// RK-30, with every parameter at its default.
TEST(ThesisMethod, CountsWithin15PercentAndMedianIouOver08) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const auto made = test::make_synthetic_photo(test::packed_picture(seed));
        const auto outlines = outlines_of(find_thesis_rocks(made.photo, unscaled()));
        const auto n_truth = static_cast<double>(made.outlines.size());
        EXPECT_NEAR(static_cast<double>(outlines.size()), n_truth, 0.15 * n_truth) << seed;
        auto best = best_overlaps(paint_labels(outlines, made.photo.width(), made.photo.height()),
                                  made.labels);
        std::sort(best.begin(), best.end());
        EXPECT_GE(best[best.size() / 2], 0.8) << seed;
    }
}

// The printed reading runs too; what it finds is no use, which is why it is not the default.
TEST(ThesisMethod, LiteralReadingFindsAlmostNothing) {
    auto picture = test::packed_picture(1);
    picture.width = 160;
    picture.height = 120;
    const auto made = test::make_synthetic_photo(picture);
    ThesisOptions literal = thesis_options(Reading::Literal);
    literal.working_width = 0;
    const auto found = outlines_of(find_thesis_rocks(made.photo, literal));
    const auto score = score_labels(paint_labels(found, 160, 120), made.labels);
    EXPECT_LT(score.ap50, 0.3);
}

// RK-08: textured pebbles in good and in poor contrast. The mask takes its thresholds from the
// picture; a Canny, or a watershed on Canny's cells, with one threshold for both either marks
// the texture of the one or loses borders of the other.
TEST(ThesisMethod, MaskServesBothContrastsWhereNoCannyOrWatershedDoes) {
    std::vector<test::SyntheticPhoto> made;
    for (const double contrast : {1.0, 0.4}) {
        auto picture = test::packed_picture(1);
        picture.texture = 0.5;
        picture.speckle = 0.35;
        picture.contrast = contrast;
        made.push_back(test::make_synthetic_photo(picture));
    }
    ThesisOptions options = unscaled();
    options.bright_share = 0.15;
    const ThesisEdgeDetector thesis(options);
    const auto quality = [&](const EdgeDetector& detector, std::size_t i) {
        return test::mask_quality(mask_of(detector.detect(made[i].photo)), made[i].labels);
    };
    const auto falls_behind = [&](const EdgeDetector& detector) {
        bool behind = false;
        for (std::size_t i = 0; i < made.size(); ++i) {
            const auto ours = quality(thesis, i);
            const auto theirs = quality(detector, i);
            behind = behind || theirs.recall < ours.recall - 0.01 ||
                     theirs.interior > ours.interior + 0.02;
        }
        return behind;
    };
    for (std::size_t i = 0; i < made.size(); ++i) {
        EXPECT_GT(quality(thesis, i).recall, 0.95);
        EXPECT_LT(quality(thesis, i).interior, 0.05);
    }
    for (const double high : {60.0, 120.0, 180.0, 240.0}) {
        const BaselineOptions baseline{.working_width = 0, .high = high};
        EXPECT_TRUE(falls_behind(CannyDetector(baseline))) << high;
        EXPECT_TRUE(falls_behind(WatershedDetector(baseline))) << high;
    }
}

// RK-28: detector and finder are exchangeable; neither knows the other.
class HalvesFinder final : public OutlineFinder {
public:
    std::vector<Outline> find(const Photo& photo, const EdgeField& field,
                              Progress*) const override {
        double sum = 0;
        for (const float b : field.boundary)
            sum += b;
        Outline disc;
        disc.centre = {photo.width() / 2.0, photo.height() / 2.0};
        disc.radii.fill(static_cast<float>(1 + sum / static_cast<double>(photo.size())));
        return {disc};
    }
};

class DrawnDetector final : public EdgeDetector {
public:
    EdgeField detect(const Photo& photo, Progress*) const override {
        Mask mask(photo.width(), photo.height());
        test::draw_circle(mask, {photo.width() / 2.0, photo.height() / 2.0}, 20);
        EdgeField field;
        field.boundary = FloatRaster(photo.width(), photo.height());
        std::copy(mask.begin(), mask.end(), field.boundary.begin());
        return field;
    }
};

std::vector<Outline> run(const EdgeDetector& detector, const OutlineFinder& finder,
                         const Photo& photo) {
    return finder.find(photo, detector.detect(photo));
}

TEST(Interchange, AnyDetectorFeedsAnyFinder) {
    const auto made = test::make_synthetic_photo(test::packed_picture(5));
    const BaselineOptions native{.working_width = 0};
    const RayOutlineFinder rays(unscaled());
    EXPECT_GT(run(ThesisEdgeDetector(unscaled()), rays, made.photo).size(), 20U);
    EXPECT_GT(run(CannyDetector(native), rays, made.photo).size(), 5U);
    EXPECT_GT(run(WatershedDetector(native), rays, made.photo).size(), 5U);
    EXPECT_EQ(run(ThesisEdgeDetector(unscaled()), HalvesFinder(), made.photo).size(), 1U);
    const auto drawn = run(DrawnDetector(), rays, Photo(120, 100));
    ASSERT_FALSE(drawn.empty());
    EXPECT_NEAR(equivalent_diameter(drawn.front()), 40, 2);
}

TEST(Interchange, PairOfClassesFindsWhatTheWholeMethodFinds) {
    const auto made = test::make_synthetic_photo(test::packed_picture(6));
    const auto pair = run(ThesisEdgeDetector(unscaled()), RayOutlineFinder(unscaled()), made.photo);
    const auto whole = outlines_of(find_thesis_rocks(made.photo, unscaled()));
    ASSERT_EQ(pair.size(), whole.size());
    for (std::size_t i = 0; i < pair.size(); ++i)
        EXPECT_EQ(pair[i].radii, whole[i].radii);
    EXPECT_TRUE(std::is_sorted(pair.begin(), pair.end(), [](const Outline& a, const Outline& b) {
        return a.confidence > b.confidence;
    }));
}

TEST(ThesisMethod, OutlinesComeBackInThePhotographsPixels) {
    auto picture = test::packed_picture(7);
    const auto made = test::make_synthetic_photo(picture);
    ThesisOptions half;
    half.working_width = 2 * picture.width;
    const auto found = outlines_of(find_thesis_rocks(made.photo, half));
    const LabelMap labels = paint_labels(found, picture.width, picture.height);
    EXPECT_GT(score_labels(labels, made.labels).ap50, 0.2);
    for (const Outline& outline : found)
        EXPECT_TRUE(outline.centre.x < picture.width && outline.centre.y < picture.height);
}

// RK-33.
TEST(ThesisMethod, BlankPicturesHaveNoRocks) {
    for (const Reading reading : {Reading::Sound, Reading::Literal})
        for (const int grey : {0, 128, 255}) {
            ThesisOptions options = thesis_options(reading);
            options.working_width = 200;
            const Photo blank(200, 150, glm::u8vec3(static_cast<std::uint8_t>(grey)));
            EXPECT_TRUE(find_thesis_rocks(blank, options).rocks.empty());
        }
    const Photo tiny(1, 1);
    ThesisOptions options;
    options.working_width = 0;
    EXPECT_TRUE(find_thesis_rocks(tiny, options).rocks.empty());
    EXPECT_THROW(find_thesis_rocks(Photo{}, {}), InvalidInput);
    EXPECT_THROW(ThesisEdgeDetector().detect(Photo{}), InvalidInput);
    EXPECT_THROW(RayOutlineFinder().find(tiny, {}), InvalidInput);
}

TEST(ThesisMethod, RocksAtTheRimAreMarked) {
    const auto made = test::make_synthetic_photo(test::packed_picture(8));
    int n_marked = 0;
    for (const Rock& rock : find_thesis_rocks(made.photo, unscaled()).rocks) {
        bool outside = false;
        for (int k = 0; k < kRadii; ++k) {
            const glm::dvec2 p = border_point(rock.outline, k);
            outside = outside || p.x < 0 || p.y < 0 || p.x > made.photo.width() ||
                      p.y > made.photo.height();
        }
        EXPECT_TRUE(!outside || rock.outline.touches_border);
        n_marked += rock.outline.touches_border ? 1 : 0;
    }
    EXPECT_GT(n_marked, 3);
}

TEST(ThesisMethod, SameRocksOnOneThread) {
    const auto made = test::make_synthetic_photo(test::packed_picture(9));
    const auto all = outlines_of(find_thesis_rocks(made.photo, unscaled()));
    const ThreadLimit one(1);
    const auto serial = outlines_of(find_thesis_rocks(made.photo, unscaled()));
    ASSERT_EQ(all.size(), serial.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].centre, serial[i].centre);
        EXPECT_EQ(all[i].radii, serial[i].radii);
    }
}

TEST(ThesisMethod, EveryStageHasItsPicture) {
    const auto made = test::make_synthetic_photo(test::packed_picture(1));
    const auto stages = thesis_stages(made.photo, unscaled());
    std::vector<std::string> names;
    for (const auto& [name, picture] : stages) {
        names.push_back(name);
        EXPECT_EQ(picture.width(), made.photo.width());
        EXPECT_NE(picture, Photo(picture.width(), picture.height())) << name << " is black";
    }
    EXPECT_THAT(names, testing::ElementsAre("grey", "median", "accumulation", "thresholded",
                                            "linked", "samples", "contours"));
}

}  // namespace
}  // namespace scree::vision
