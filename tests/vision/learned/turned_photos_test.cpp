// A real photograph turned, mirrored or doubled shows the same rocks: how nearly the learned method
// finds them again.
#include "tests/support/shared_data.h"
#include "vision/data/metrics.h"
#include "vision/image_io.h"
#include "vision/learned/level_picture.h"
#include "vision/rock_extraction.h"

#include <algorithm>
#include <functional>
#include <string>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

// What may differ between the rocks of a photograph and those of the moved one.
struct Tolerance {
    double f1;   // least share of rocks found in both
    double iou;  // least mean overlap of these
};

// In outcrops most rocks are doubtful, and which of them are kept depends on little. Twice as large
// a picture shows another scale of texture.
struct Case {
    const char* folder;
    Tolerance moved, doubled;
};
constexpr Case kCases[] = {{"gravel", {0.9, 0.9}, {0.75, 0.85}},
                           {"outcrop", {0.7, 0.84}, {0.55, 0.82}},
                           {"sand", {0.93, 0.93}, {0.88, 0.9}}};

using Source = std::function<glm::ivec2(int, int)>;

// Every pixel of the result comes from where `source` says.
template <class Pixel>
Raster<Pixel> moved(const Raster<Pixel>& from, int width, int height, const Source& source) {
    Raster<Pixel> to(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::ivec2 at = source(x, y);
            to(x, y) = from(at.x, at.y);
        }
    return to;
}

LabelMap found_in(const Photo& photo, double min_size = ExtractionOptions{}.min_size) {
    const RockExtraction extraction =
        extract_rocks(photo, {.method = Method::Learned, .min_size = min_size});
    std::vector<Outline> outlines;
    for (const Rock& rock : extraction.rocks.rocks)
        outlines.push_back(rock.outline);
    return paint_labels(outlines, photo.width(), photo.height());
}

class TurnedPhotos : public testing::TestWithParam<Case> {
protected:
    void SetUp() override {
        SCREE_NEEDS_SHARED_DATA();
        const auto photos = test::labelled_photos(GetParam().folder);
        ASSERT_FALSE(photos.empty());
        const Photo whole = read_photo(photos.front().photo).pixels;
        const int width = std::min(whole.width(), 480), height = std::min(whole.height(), 352);
        const glm::ivec2 corner((whole.width() - width) / 2, (whole.height() - height) / 2);
        photo_ = moved<glm::u8vec3>(whole, width, height,
                                    [&](int x, int y) { return corner + glm::ivec2(x, y); });
        found_ = found_in(photo_);
    }

    void expect_the_same(const LabelMap& found, int width, int height, const Source& source,
                         const Tolerance& tolerance) const {
        const LabelScore score =
            score_labels(found, moved<std::uint16_t>(found_, width, height, source));
        RecordProperty("f1", std::to_string(score.f1));
        RecordProperty("iou", std::to_string(score.iou));
        EXPECT_GE(score.n_truth, 8);
        EXPECT_GT(score.f1, tolerance.f1);
        EXPECT_GT(score.iou, tolerance.iou);
    }

    Photo photo_;
    LabelMap found_;
};

TEST_P(TurnedPhotos, AQuarterTurnGivesTheSameRocks) {
    const int width = photo_.height(), height = photo_.width();
    const Source source = [&](int x, int y) { return glm::ivec2(y, photo_.height() - 1 - x); };
    expect_the_same(found_in(moved<glm::u8vec3>(photo_, width, height, source)), width, height,
                    source, GetParam().moved);
}

TEST_P(TurnedPhotos, TheMirrorImageGivesTheSameRocks) {
    const int width = photo_.width(), height = photo_.height();
    const Source source = [&](int x, int y) { return glm::ivec2(width - 1 - x, y); };
    expect_the_same(found_in(moved<glm::u8vec3>(photo_, width, height, source)), width, height,
                    source, GetParam().moved);
}

TEST_P(TurnedPhotos, TwiceTheSizeGivesTheSameRocks) {
    const Photo large = doubled(photo_);
    const Source source = [](int x, int y) { return glm::ivec2(x / 2, y / 2); };
    expect_the_same(found_in(large, 2.0 * ExtractionOptions{}.min_size), large.width(),
                    large.height(), source, GetParam().doubled);
}
INSTANTIATE_TEST_SUITE_P(Folders, TurnedPhotos, testing::ValuesIn(kCases),
                         [](const auto& folder) { return std::string(folder.param.folder); });

}  // namespace
}  // namespace scree::vision
