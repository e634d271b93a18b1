#include "vision/data/metrics.h"

#include "base/error.h"
#include "base/random.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"

#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace scree::vision {
namespace {

void fill(LabelMap& labels, int x0, int y0, int x1, int y1, std::uint16_t value) {
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            labels(x, y) = value;
}

LabelMap blocks(int n, int size) {
    LabelMap labels(n * (size + 2), size);
    for (int i = 0; i < n; ++i)
        fill(labels, i * (size + 2), 0, i * (size + 2) + size, size,
             static_cast<std::uint16_t>(7 * i + 3));
    return labels;
}

TEST(Metrics, AMapAgreesWithItself) {
    const LabelMap labels = blocks(5, 9);
    const LabelScore score = score_labels(labels, labels);
    EXPECT_EQ(score.n_truth, 5);
    EXPECT_EQ(score.true_positives, 5);
    for (const double one : {score.ap50, score.ap75, score.map, score.f1, score.iou, score.cover})
        EXPECT_DOUBLE_EQ(one, 1.0);
    EXPECT_EQ(score.d50_error, 0.0);
    EXPECT_EQ(score.d84_error, 0.0);
}

TEST(Metrics, ShiftedBlockHasTheClosedForm) {
    LabelMap truth(30, 20);
    LabelMap found(30, 20);
    fill(truth, 5, 5, 15, 15, 1);
    fill(found, 7, 5, 17, 15, 9);  // 80 of 120 pixels agree: IoU 2/3
    const LabelScore score = score_labels(found, truth);
    EXPECT_DOUBLE_EQ(score.iou, 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(score.cover, 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(score.ap50, 1.0);
    EXPECT_DOUBLE_EQ(score.ap75, 0.0);
    EXPECT_DOUBLE_EQ(score.map, 4.0 / 9.0);  // 0.50, 0.55, 0.60, 0.65
}

TEST(Metrics, ExactlyHalfIsNoMatch) {
    LabelMap truth(20, 4);
    LabelMap found(20, 4);
    fill(truth, 0, 0, 10, 4, 1);
    fill(found, 0, 0, 5, 4, 1);
    const LabelScore score = score_labels(found, truth);
    EXPECT_EQ(score.true_positives, 0);
    EXPECT_EQ(score.iou, 0.0);
    EXPECT_NEAR(score.d50_error, 1.0 - std::sqrt(0.5), 1e-12);
}

TEST(Metrics, MissedAndInventedRocksCountAgainstIt) {
    LabelMap truth = blocks(4, 8);
    LabelMap found = truth;
    fill(found, 0, 0, 8, 8, 0);    // one missed
    fill(truth, 10, 0, 18, 8, 0);  // one invented
    const LabelScore score = score_labels(found, truth);
    EXPECT_EQ(score.true_positives, 2);
    EXPECT_DOUBLE_EQ(score.ap50, 2.0 / 4.0);
    EXPECT_DOUBLE_EQ(score.f1, 4.0 / 6.0);
}

TEST(Metrics, EmptyMaps) {
    const LabelMap none(12, 10);
    const LabelScore both = score_labels(none, none);
    EXPECT_EQ(both.ap50, 0.0);
    EXPECT_EQ(both.cover, 0.0);
    EXPECT_EQ(both.d50_error, 1.0);
    EXPECT_EQ(score_labels(none, blocks(1, 10)).n_truth, 1.0);
}

TEST(Metrics, PercentileIsLinearBetweenRanks) {
    const std::vector<double> values = {1, 2, 4, 8, 16};
    EXPECT_DOUBLE_EQ(percentile(values, 50), 4);
    EXPECT_DOUBLE_EQ(percentile(values, 84), 8 + 0.36 * 8);
    EXPECT_DOUBLE_EQ(percentile(values, 0), 1);
    EXPECT_DOUBLE_EQ(percentile(values, 100), 16);
    EXPECT_DOUBLE_EQ(percentile(std::vector<double>{3}, 84), 3);
}

TEST(Metrics, MeanIsTakenFigureByFigure) {
    const LabelMap labels = blocks(2, 8);
    const std::vector<LabelScore> scores = {score_labels(labels, labels),
                                            score_labels(LabelMap(20, 8), labels)};
    EXPECT_DOUBLE_EQ(mean_score(scores).ap50, 0.5);
    EXPECT_DOUBLE_EQ(mean_score(scores).d84_error, 0.5);
    EXPECT_THROW(mean_score({}), InvalidInput);
}

TEST(Metrics, SizesMustAgree) {
    EXPECT_THAT([] { score_labels(LabelMap(3, 4), LabelMap(4, 3)); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("3 x 4 and 4 x 3")));
}

// ---- the scorer that lies beside the photographs

std::filesystem::path scorer() {
    return test::shared_data() / ".." / "tools" / "score_labels.py";
}

bool scorer_runs() {
    return std::filesystem::exists(scorer()) &&
           std::system("/usr/bin/python3 -c 'import cv2, numpy' > /dev/null 2>&1") == 0;
}

// The truth moved and eaten at by discs, so that every figure takes a value of its own.
LabelMap damaged(const LabelMap& truth, std::uint64_t seed) {
    Rng rng({.seed = seed});
    LabelMap found(truth.width(), truth.height());
    const int dx = static_cast<int>(rng.below(5));
    for (int y = 0; y < truth.height(); ++y)
        for (int x = 0; x < truth.width(); ++x)
            found(x, y) = truth(std::max(0, x - dx), std::max(0, y - 2));
    for (int i = 0; i < truth.width() * truth.height() / 9000; ++i) {
        const int cx = static_cast<int>(rng.below(static_cast<std::uint64_t>(truth.width())));
        const int cy = static_cast<int>(rng.below(static_cast<std::uint64_t>(truth.height())));
        const int r = 3 + static_cast<int>(rng.below(25));
        for (int y = std::max(0, cy - r); y < std::min(truth.height(), cy + r); ++y)
            for (int x = std::max(0, cx - r); x < std::min(truth.width(), cx + r); ++x)
                found(x, y) = static_cast<std::uint16_t>(i % 3 == 0 ? 0 : 30000 + i);
    }
    return found;
}

TEST(Metrics, SameFiguresAsTheSharedScorer) {
    SCREE_NEEDS_SHARED_DATA();
    if (!scorer_runs())
        GTEST_SKIP() << "score_labels.py or its python3-opencv is not there";
    const test::TempDir dir;
    for (const char* folder : {"outcrop", "sand"}) {
        const auto photo = test::labelled_photos(folder).front();
        const LabelMap truth = read_labels(photo.labels);
        const LabelMap found = damaged(truth, 5);
        write_labels(dir / "found.png", found);
        const std::string out = (dir / "score.json").string();
        const std::string command = "/usr/bin/python3 '" + scorer().string() + "' '" +
                                    (dir / "found.png").string() + "' '" + photo.labels.string() +
                                    "' --json > '" + out + "'";
        ASSERT_EQ(std::system(command.c_str()), 0);
        std::ifstream file(out);
        const auto row = nlohmann::json::parse(file)["pictures"].begin().value();
        const LabelScore score = score_labels(found, truth);
        const std::pair<const char*, double> figures[] = {{"truth", score.n_truth},
                                                          {"pred", score.n_found},
                                                          {"tp", score.true_positives},
                                                          {"AP50", score.ap50},
                                                          {"AP75", score.ap75},
                                                          {"mAP", score.map},
                                                          {"F1", score.f1},
                                                          {"IoU", score.iou},
                                                          {"cover", score.cover},
                                                          {"D50err", score.d50_error},
                                                          {"D84err", score.d84_error}};
        for (const auto& [name, value] : figures)
            EXPECT_NEAR(value, row[name].get<double>(), 1e-12) << folder << ' ' << name;
        EXPECT_GT(score.iou, 0.5);
        EXPECT_LT(score.iou, 0.95);
    }
}

}  // namespace
}  // namespace scree::vision
