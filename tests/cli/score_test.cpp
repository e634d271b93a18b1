#include "tests/cli/scree.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"

#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace scree {
namespace {

using nlohmann::json;
using test::ProgramRun;
using testing::HasSubstr;

LabelMap squares(int shift) {
    LabelMap labels(60, 40);
    for (int y = 0; y < 40; ++y)
        for (int x = shift; x < 60; ++x)
            if ((x - shift) % 12 < 9 && y % 12 < 9)
                labels(x, y) = static_cast<std::uint16_t>(300 + 10 * (y / 12) + (x - shift) / 12);
    return labels;
}

TEST(Score, PrintsFiguresAndTheirMean) {
    const test::TempDir dir;
    vision::write_labels(dir / "a.png", squares(0));
    vision::write_labels(dir / "b.png", squares(1));
    const std::string a = dir / "a.png";
    const std::string b = dir / "b.png";
    const ProgramRun run = test::scree({"score", a, a, b, a, "--json"});
    ASSERT_EQ(run.status, 0) << run.errors;
    const json figures = json::parse(run.output);
    EXPECT_EQ(figures["pictures"].size(), 1U);  // the same truth twice: the last one stands
    EXPECT_GT(figures["mean"]["AP50"], 0.9);
    EXPECT_LT(figures["mean"]["IoU"], 1.0);
    const ProgramRun table = test::scree({"score", a, a});
    EXPECT_THAT(table.output, HasSubstr("picture"));
    EXPECT_THAT(table.output, HasSubstr("1.000"));
}

TEST(Score, RefusesWhatIsNoPairOfLabelMaps) {
    const test::TempDir dir;
    vision::write_labels(dir / "a.png", squares(0));
    vision::write_labels(dir / "small.png", LabelMap(3, 3));
    vision::write_png(dir / "photo.png", Photo(60, 40));
    const std::string a = dir / "a.png";
    EXPECT_EQ(test::scree({"score"}).status, 2);
    EXPECT_EQ(test::scree({"score", a}).status, 2);
    for (const char* name : {"small.png", "photo.png", "missing.png"}) {
        const ProgramRun run = test::scree({"score", dir / name, a});
        EXPECT_EQ(run.status, 1) << name;
        EXPECT_THAT(run.errors, HasSubstr("scree score: "));
        EXPECT_EQ(run.output, "");
    }
}

TEST(Score, AgreesWithTheSharedScorer) {
    SCREE_NEEDS_SHARED_DATA();
    const auto script = test::shared_data() / ".." / "tools" / "score_labels.py";
    if (!std::filesystem::exists(script) ||
        test::run_program("/usr/bin/python3", {"-c", "import cv2, numpy"}).status != 0)
        GTEST_SKIP() << "the shared scorer or its Python packages are missing";
    const test::TempDir dir;
    std::vector<std::string> maps;
    for (const auto& photo : test::labelled_photos("sand")) {
        LabelMap changed = vision::read_labels(photo.labels);
        for (int y = 0; y < changed.height(); ++y)  // shifted, merged and lost rocks
            for (int x = 0; x + 5 < changed.width(); ++x)
                changed(x, y) = changed(x + 5, y) % 7 == 0
                                    ? std::uint16_t{0}
                                    : static_cast<std::uint16_t>(changed(x + 5, y) / 2 * 2);
        maps.push_back(dir / (std::to_string(maps.size()) + ".png"));
        vision::write_labels(maps.back(), changed);
        maps.push_back(photo.labels);
    }
    std::vector<std::string> theirs = {script.string()};
    std::vector<std::string> ours = {"score"};
    for (auto* words : {&theirs, &ours}) {
        words->insert(words->end(), maps.begin(), maps.end());
        words->push_back("--json");
    }
    const json expected = json::parse(test::run_program("/usr/bin/python3", theirs).output);
    const json figures = json::parse(test::scree(ours).output);
    ASSERT_EQ(figures["pictures"].size(), expected["pictures"].size());
    for (const auto& [name, values] : expected["pictures"].items())
        for (const auto& [key, value] : values.items())
            EXPECT_NEAR(figures["pictures"][name][key].get<double>(), value.get<double>(), 1e-9)
                << name << " " << key;
    for (const auto& [key, value] : expected["mean"].items())
        EXPECT_NEAR(figures["mean"][key].get<double>(), value.get<double>(), 1e-9) << key;
}

}  // namespace
}  // namespace scree
