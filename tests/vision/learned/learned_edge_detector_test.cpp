#include "vision/learned/learned_edge_detector.h"

#include "base/error.h"
#include "base/parallel.h"
#include "testdata/synthetic_photo.h"
#include "tests/support/tiny_network.h"
#include "vision/classical/classical_edge_detector.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

OutlineNetwork pointwise(float gain, float step) {
    return {test::onnx_bytes(test::pointwise_network(3, gain, step)), "pointwise"};
}

OutlineNetwork smoothing(int reach) {
    return {test::onnx_bytes(test::smoothing_network(reach, 2.0F)), "smoothing"};
}

const Photo& pebbles() {
    static const Photo photo =
        test::make_synthetic_photo({.width = 1000, .height = 280, .n_rocks = 200}).photo;
    return photo;
}

Photo part(const Photo& photo, int left, int top, int width, int height) {
    Photo out(width, height);
    for (int y = 0; y < height; ++y)
        std::copy_n(photo.row(top + y) + left, width, out.row(y));
    return out;
}

double greatest_difference(const FloatRaster& a, const FloatRaster& b, int dx, int dy, int inset) {
    double most = 0.0;
    for (int y = inset; y < b.height() - inset; ++y)
        for (int x = inset; x < b.width() - inset; ++x)
            most = std::max(most, std::abs(static_cast<double>(a(x + dx, y + dy) - b(x, y))));
    return most;
}

TEST(LearnedEdgeDetector, FillsAllChannelsOfAnySizeLikeTheOtherFamily) {
    const LearnedEdgeDetector learned;
    const ClassicalEdgeDetector classical;
    for (const EdgeDetector* detector : {static_cast<const EdgeDetector*>(&learned),
                                         static_cast<const EdgeDetector*>(&classical)}) {
        for (const auto& [w, h] : {std::pair{1, 1}, {3, 90}, {70, 45}, {33, 200}}) {
            const EdgeField field = detector->detect(Photo(w, h, {120, 110, 90}));
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
}

// A flat picture has light 0 everywhere: the field is the logistic function of the biases.
TEST(LearnedEdgeDetector, AFlatPictureGivesTheBiases) {
    const LearnedEdgeDetector detector({}, pointwise(3.0F, 0.5F));
    const EdgeField field = detector.detect(Photo(300, 200, glm::u8vec3(90)));
    const FloatRaster* channels[] = {&field.boundary, &field.inside, &field.distance};
    for (int k = 0; k < 3; ++k)
        for (const float value : *channels[k])
            ASSERT_NEAR(value, 1.0 / (1.0 + std::exp(-0.5 * k)), 2e-5);
}

// Two halves of grey 60 and 180, seen at the finest scale alone: far from the line between them
// the light is even, so the input is 0 there; at the line, where half of the window is dark, mean
// and spread are 120 and 60 of 255.
TEST(LearnedEdgeDetector, NormalisesByTheLightAround) {
    Photo photo(1024, 96, glm::u8vec3(60));
    for (int y = 0; y < photo.height(); ++y)
        std::fill(photo.row(y) + 512, photo.row(y) + 1024, glm::u8vec3(180));
    const EdgeField field = LearnedEdgeDetector({.levels = 1}, pointwise(1.0F, 0.0F)).detect(photo);
    const double expected = 60.0 / 255.0 / (60.0 / 255.0 + 0.04);
    EXPECT_NEAR(field.boundary(512, 48), 1.0 / (1.0 + std::exp(-expected)), 0.01);
    EXPECT_NEAR(field.boundary(511, 48), 1.0 / (1.0 + std::exp(expected)), 0.01);
    EXPECT_NEAR(field.boundary(4, 48), 0.5, 1e-3);
    EXPECT_NEAR(field.boundary(1020, 48), 0.5, 1e-3);
}

TEST(LearnedEdgeDetector, TilesGiveWhatTheWholePictureGives) {
    for (const int reach : {0, 4}) {  // half of the margin is 24
        const OutlineNetwork network = reach > 0 ? smoothing(reach) : pointwise(2.0F, 0.0F);
        const LearnedOptions whole{.adapt = false, .tile = 2048},
            tiled{.adapt = false, .tile = 768};
        const EdgeField a = LearnedEdgeDetector(whole, network).detect(pebbles());
        const EdgeField b = LearnedEdgeDetector(tiled, network).detect(pebbles());
        EXPECT_LT(greatest_difference(a.boundary, b.boundary, 0, 0, 0), 1e-5);
        EXPECT_LT(greatest_difference(a.distance, b.distance, 0, 0, 0), 1e-5);
    }
}

TEST(LearnedEdgeDetector, APartGivesTheSameBeyondTheReach) {
    const LearnedOptions options{.levels = 1, .closest = 0, .tile = 768};
    const LearnedEdgeDetector detector(options, smoothing(4));
    const EdgeField all = detector.detect(pebbles());
    const EdgeField some = detector.detect(part(pebbles(), 320, 0, 640, 280));
    for (int y = 0; y < 280; ++y)
        for (int x = 270; x < 370; ++x)
            ASSERT_NEAR(all.boundary(320 + x, y), some.boundary(x, y), 1e-5) << x << ' ' << y;
}

TEST(LearnedEdgeDetector, SameBytesForAnyThreadCount) {
    for (const Photo& photo :
         {pebbles(), part(pebbles(), 0, 0, 200, 150)}) {  // one looked at closer
        EdgeField one, two;
        {
            const ThreadLimit limit(1);
            one = LearnedEdgeDetector({.doubt = 0, .tile = 768}).detect(photo);
        }
        {
            const ThreadLimit limit(2);
            two = LearnedEdgeDetector({.doubt = 0, .tile = 768}).detect(photo);
        }
        EXPECT_EQ(one.boundary, two.boundary);
        EXPECT_EQ(one.inside, two.inside);
        EXPECT_EQ(one.distance, two.distance);
    }
}

class Listener : public Progress {
public:
    explicit Listener(int stop_after) : stop_after_(stop_after) {}
    void report(std::string_view, double fraction) override {
        EXPECT_GE(fraction, last_);
        EXPECT_LE(fraction, 1.0);
        last_ = fraction;
        ++n_reports;
    }
    bool cancelled() const override { return n_reports >= stop_after_; }
    int n_reports = 0;

private:
    int stop_after_;
    double last_ = 0.0;
};

TEST(LearnedEdgeDetector, TellsAndHeedsAtEveryTile) {
    const LearnedEdgeDetector detector({.adapt = false, .tile = 768}, pointwise(1.0F, 0.0F));
    Listener patient(1000);
    detector.detect(pebbles(), &patient);
    EXPECT_EQ(patient.n_reports, 4);  // 1/4, 1/2, and two tiles of the finest scale
    Listener hasty(2);
    EXPECT_THROW(detector.detect(pebbles(), &hasty), Cancelled);
    EXPECT_EQ(hasty.n_reports, 2);
}

TEST(LearnedEdgeDetector, MayLookAtTheDoubledPicture) {
    const FusionModel fusion{.reads_doubled = true, .n_levels = 1};
    const Photo photo = part(pebbles(), 0, 0, 470, 280);
    const EdgeField plain =
        LearnedEdgeDetector({}, pointwise(1.0F, 0.5F), {.n_levels = 1}).detect(photo);
    const EdgeField doubled =
        LearnedEdgeDetector({.adapt = false}, pointwise(1.0F, 0.5F), fusion).detect(photo);
    double sum = 0.0;
    for (std::size_t i = 0; i < photo.size(); ++i)
        sum += std::abs(plain.inside.data()[i] - doubled.inside.data()[i]);
    EXPECT_LT(sum / static_cast<double>(photo.size()), 0.05);
    EXPECT_NE(plain.inside, doubled.inside);
}

TEST(LearnedEdgeDetector, LooksCloserOnlyAtSmallPicturesThatLeaveItOpen) {
    const FusionModel plain{.n_levels = 2}, closer{.reads_doubled = true, .n_levels = 3};
    const Photo photo = part(pebbles(), 0, 0, 470, 280);
    const auto inside = [&](float step, const FusionModel& fusion, double closest) {
        return LearnedEdgeDetector({.closest = closest}, pointwise(1.0F, step), fusion)
            .detect(photo)
            .inside;
    };
    const auto difference = [](const FloatRaster& a, const FloatRaster& b) {
        return greatest_difference(a, b, 0, 0, 0);
    };
    EXPECT_GT(difference(inside(0.0F, plain, 1.0), inside(0.0F, closer, 1.0)), 1e-3);
    EXPECT_EQ(inside(0.0F, plain, 0.5), inside(0.0F, closer, 0.5));  // 0.53 when doubled
    EXPECT_LT(difference(inside(7.0F, plain, 1.0), inside(7.0F, closer, 1.0)), 1e-6);
}

TEST(LearnedEdgeDetector, BadInputIsRefused) {
    EXPECT_THAT([] { LearnedEdgeDetector().detect(Photo()); },
                testing::ThrowsMessage<InvalidInput>("the photograph has no pixels"));
    EXPECT_THROW(LearnedEdgeDetector({.levels = 0}), InvalidOption);
    EXPECT_THROW(LearnedEdgeDetector({.full = 200, .none = 100}), InvalidOption);
    EXPECT_THROW(LearnedEdgeDetector({}, pointwise(3e38F, 0.0F)).detect(pebbles()), InvalidInput);
}

}  // namespace
}  // namespace scree::vision
