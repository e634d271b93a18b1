#include "vision/refine/refine_outlines.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "testdata/synthetic_photo.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct Scene {
    test::SyntheticPhoto truth;
    EdgeField field;
};

// Strength of the photograph's grey gradient, and where the rocks are, both through a small blur:
// about what a plain detector would say.
EdgeField gradient_field(const test::SyntheticPhoto& scene) {
    const Photo& photo = scene.photo;
    cv::Mat grey(photo.height(), photo.width(), CV_32FC1);
    for (int y = 0; y < photo.height(); ++y)
        for (int x = 0; x < photo.width(); ++x) {
            const glm::u8vec3 c = photo(x, y);
            grey.at<float>(y, x) = static_cast<float>(c.r + c.g + c.b) / 765.0F;
        }
    cv::GaussianBlur(grey, grey, {}, 0.7);
    cv::Mat gx, gy, size;
    cv::Scharr(grey, gx, CV_32F, 1, 0, 1.0 / 16);
    cv::Scharr(grey, gy, CV_32F, 0, 1, 1.0 / 16);
    cv::magnitude(gx, gy, size);
    EdgeField field;
    field.boundary = FloatRaster(photo.width(), photo.height());
    for (int y = 0; y < photo.height(); ++y)
        for (int x = 0; x < photo.width(); ++x)
            field.boundary(x, y) = std::min(1.0F, 8.0F * size.at<float>(y, x));
    return field;
}

// Plain light rocks on dark ground: the edge is where the outline is, so errors can be measured.
Scene plain_scene(std::uint64_t seed) {
    Scene scene;
    scene.truth = test::make_synthetic_photo({.width = 500,
                                              .height = 400,
                                              .n_rocks = 60,
                                              .least_diameter = 16,
                                              .shadow = 1.0,
                                              .texture = 0.0,
                                              .seed = seed});
    scene.field = gradient_field(scene.truth);
    return scene;
}

// Centre moved and radii bent by a few smooth waves of about `size` pixels.
std::vector<Outline> bent(std::vector<Outline> outlines, double size, std::uint64_t seed) {
    Rng rng({.seed = seed});
    for (Outline& outline : outlines) {
        const double least = *std::min_element(outline.radii.begin(), outline.radii.end());
        const double amplitude = std::min(size, 0.12 * least);
        outline.centre +=
            glm::dvec2(0.5 * amplitude * rng.normal(), 0.5 * amplitude * rng.normal());
        for (int wave = 0; wave < 6; ++wave) {
            const double height = 0.4 * amplitude * rng.normal();
            const double phase = rng.uniform(0, 2 * std::numbers::pi);
            for (int k = 0; k < kRadii; ++k)
                outline.radii[static_cast<std::size_t>(k)] += static_cast<float>(
                    height * std::cos(wave * k * std::numbers::pi / 180 + phase));
        }
        for (float& radius : outline.radii)
            radius = std::max(radius, 1.0F);
    }
    return outlines;
}

// Root mean square distance between two outlines, along rays from the first one's centre.
double distance(const Outline& truth, const Outline& outline) {
    double sum = 0.0;
    for (int k = 0; k < kRadii; ++k) {
        const glm::dvec2 arm = border_point(outline, k) - truth.centre;
        const double error = std::hypot(arm.x, arm.y) - radius_at(truth, std::atan2(arm.y, arm.x));
        sum += error * error;
    }
    return std::sqrt(sum / kRadii);
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

class Refine : public testing::TestWithParam<std::uint64_t> {};  // a seed

TEST_P(Refine, FindsTheBorderToAFractionOfAPixel) {
    const Scene scene = plain_scene(GetParam());
    const auto start = bent(scene.truth.outlines, 4.0, GetParam());
    const auto refined = refine_outlines(scene.truth.photo, scene.field, start);
    std::vector<double> before, after;
    double variance = 0.0, expected = 0.0;
    for (std::size_t i = 0; i < start.size(); ++i) {
        if (start[i].touches_border)
            continue;
        before.push_back(distance(scene.truth.outlines[i], start[i]));
        after.push_back(distance(scene.truth.outlines[i], refined.rocks[i].outline));
        variance += after.back() * after.back();
        expected += std::pow(refined.rocks[i].uncertainty, 2);
    }
    EXPECT_GT(median(before), 1.2);
    EXPECT_LT(median(after), 0.75);
    RecordProperty("before", std::to_string(median(before)));
    RecordProperty("after", std::to_string(median(after)));
    const double calibration = std::sqrt(variance / expected);
    EXPECT_GT(calibration, 0.5) << median(after);
    EXPECT_LT(calibration, 2.0) << median(after);
}

TEST_P(Refine, NeverGivesABrokenOutline) {
    const Scene scene = plain_scene(GetParam());
    EdgeField noise = scene.field;
    Rng rng({.seed = GetParam()});
    for (float& value : noise.boundary)
        value = static_cast<float>(rng.uniform());
    const auto start = bent(scene.truth.outlines, 6.0, GetParam());
    const auto refined = refine_outlines(scene.truth.photo, noise, start);
    for (std::size_t i = 0; i < start.size(); ++i) {
        const Rock& rock = refined.rocks[i];
        for (const float radius : rock.outline.radii)
            ASSERT_TRUE(radius > 0.0F && radius < 1000.0F);
        EXPECT_TRUE(start[i].touches_border ||
                    distance(start[i], rock.outline) < 10.5);  // one and a half windows
        EXPECT_EQ(rock.depth,
                  *std::min_element(rock.outline.radii.begin(), rock.outline.radii.end()));
        EXPECT_EQ(rock.outline.touches_border, start[i].touches_border);
        EXPECT_EQ(rock.outline.confidence, start[i].confidence);
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, Refine, testing::Range<std::uint64_t>(1, 5));

TEST(RefineOutlines, SameForAnyNumberOfThreads) {
    const Scene scene = plain_scene(3);
    const auto start = bent(scene.truth.outlines, 4.0, 1);
    const auto run = [&](int n_threads) {
        const ThreadLimit limit(n_threads);
        return refine_outlines(scene.truth.photo, scene.field, start);
    };
    const auto one = run(1);
    const auto two = run(2);
    for (std::size_t i = 0; i < start.size(); ++i) {
        EXPECT_EQ(one.rocks[i].outline.radii, two.rocks[i].outline.radii);
        EXPECT_EQ(one.rocks[i].uncertainty, two.rocks[i].uncertainty);
    }
    EXPECT_EQ(one.report.refined, two.report.refined);
}

TEST(RefineOutlines, RocksAtTheBorderEndThere) {
    const Scene scene = plain_scene(2);
    const auto refined =
        refine_outlines(scene.truth.photo, scene.field, bent(scene.truth.outlines, 3.0, 1));
    int n_cut = 0;
    for (const Rock& rock : refined.rocks) {
        if (!rock.outline.touches_border)
            continue;
        ++n_cut;
        if (rock.outline.centre.x < 0 || rock.outline.centre.y < 0 || rock.outline.centre.x > 500 ||
            rock.outline.centre.y > 400)
            continue;  // kept as it was
        for (int k = 0; k < kRadii; ++k) {
            const glm::dvec2 p = border_point(rock.outline, k);
            EXPECT_TRUE(p.x > -6 && p.y > -6 && p.x < 506 && p.y < 406) << p.x << ' ' << p.y;
        }
    }
    EXPECT_GT(n_cut, 3);
}

TEST(RefineOutlines, NothingToDoAndTinyPictures) {
    EdgeField field;
    field.boundary = FloatRaster(1, 1, 0.5F);
    EXPECT_TRUE(refine_outlines(Photo(1, 1), field, {}).rocks.empty());
    Outline dot;
    dot.centre = {0.5, 0.5};
    dot.radii.fill(0.5F);
    EXPECT_EQ(refine_outlines(Photo(1, 1), field, {dot}).rocks.size(), 1U);
}

TEST(RefineOutlines, FlatFieldChangesLittle) {
    const Scene scene = plain_scene(1);
    EdgeField flat;
    flat.boundary = FloatRaster(500, 400, 0.0F);
    const auto refined = refine_outlines(scene.truth.photo, flat, scene.truth.outlines);
    for (std::size_t i = 0; i < refined.rocks.size(); ++i) {
        const bool cut = scene.truth.outlines[i].touches_border;
        EXPECT_TRUE(cut || distance(scene.truth.outlines[i], refined.rocks[i].outline) < 1.5);
    }
}

TEST(RefineErrors, NameWhatIsWrong) {
    EdgeField field;
    EXPECT_THAT([&] { refine_outlines(Photo(4, 3), field, {}); },
                ThrowsMessage<InvalidInput>(HasSubstr("boundary channel is 0 x 0")));
    field.boundary = FloatRaster(4, 3);
    field.inside = FloatRaster(3, 4);
    EXPECT_THAT([&] { refine_outlines(Photo(4, 3), field, {}); },
                ThrowsMessage<InvalidInput>(HasSubstr("inside channel is 3 x 4")));
    field.inside = {};
    Outline bad;
    bad.radii.fill(1.0F);
    bad.radii[9] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT([&] { refine_outlines(Photo(4, 3), field, {bad}); },
                ThrowsMessage<InvalidInput>(HasSubstr("outline 0")));
    EXPECT_THAT([&] { refine_outlines(Photo(4, 3), field, {}, {.window = 2.0}); },
                ThrowsMessage<InvalidOption>(HasSubstr("window is 2")));
}

}  // namespace
}  // namespace scree::vision
