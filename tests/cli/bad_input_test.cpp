#include "base/whole_file.h"
#include "tests/cli/folder.h"
#include "tests/cli/scree.h"
#include "tests/support/odd_pictures.h"
#include "tests/support/temp_dir.h"
#include "vision/data/rocks_json.h"
#include "vision/image_io.h"

#include <gmock/gmock.h>

namespace scree {
namespace {

namespace fs = std::filesystem;
using test::files_below;
using test::ProgramRun;
using testing::HasSubstr;
using testing::IsEmpty;

class BadInput : public testing::Test {
protected:
    fs::path at(const std::string& name) const { return dir_ / name; }

    ProgramRun rocks(const fs::path& photo, const test::ProgramSetup& setup = {}) const {
        return test::scree({"rocks", photo, "-o", at("out"), "--quiet"}, setup);
    }

    // Refused with a sentence that names the file; nothing is left behind.
    void expect_refused(const fs::path& photo, const std::string& reason) const {
        const ProgramRun run = rocks(photo);
        EXPECT_EQ(run.status, 1) << photo;
        EXPECT_THAT(run.errors, testing::StartsWith("scree rocks: ")) << photo;
        EXPECT_THAT(run.errors, HasSubstr(photo.filename().string()));
        EXPECT_THAT(run.errors, HasSubstr(reason));
        EXPECT_THAT(run.output, IsEmpty());
        EXPECT_FALSE(fs::exists(at("out"))) << photo;
    }

    void expect_rocks(const fs::path& photo, std::size_t n_rocks) const {
        const ProgramRun run = rocks(photo);
        ASSERT_EQ(run.status, 0) << photo << ": " << run.errors;
        EXPECT_EQ(vision::read_rocks_json(at("out") / "rocks.json").rocks.size(), n_rocks) << photo;
        fs::remove_all(at("out"));
    }

    test::TempDir dir_;
};

TEST_F(BadInput, WhatIsNoPictureIsRefused) {
    write_whole_file(at("empty.png"), std::string_view());
    write_whole_file(at("words.jpg"), std::string_view("these are words"));
    fs::create_directories(at("folder.png"));
    expect_refused(at("missing.png"), "no such file");
    expect_refused(at("empty.png"), "empty");
    expect_refused(at("words.jpg"), "cannot read");
    expect_refused(at("folder.png"), "folder");
}

TEST_F(BadInput, TruncatedPicturesAreRefused) {
    test::write_test_photo(at("whole.png"), 120, 90);
    const std::string png = read_whole_file(at("whole.png"), 1 << 24);
    const auto jpeg = vision::encode_jpeg(vision::read_photo(at("whole.png")).pixels, 90);
    for (const double part : {0.02, 0.5, 0.9}) {
        const auto n = static_cast<std::size_t>(part * static_cast<double>(png.size()));
        write_whole_file(at("cut.png"), std::string_view(png).substr(0, n));
        expect_refused(at("cut.png"), "cannot read");
    }
    write_whole_file(at("cut.jpg"), std::span(jpeg).first(40));
    expect_refused(at("cut.jpg"), "cannot read");
}

TEST_F(BadInput, HugeClaimsCostNothing) {
    write_whole_file(at("huge.png"), std::string_view(test::huge_png(20000, 15000)));
    expect_refused(at("huge.png"), "20000 x 15000");
    write_whole_file(at("absurd.png"), std::string_view(test::huge_png(2000000000, 2000000000)));
    expect_refused(at("absurd.png"), "");
    test::write_test_photo(at("small.png"), 120, 90);
    const ProgramRun run =
        test::scree({"rocks", at("small.png"), "-o", at("out"), "--max-megapixels", "0.01"});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.errors, HasSubstr("120 x 90"));
}

TEST_F(BadInput, BlankPicturesHaveNoRocks) {
    const auto blank = [&](const char* name, int width, int height, std::uint8_t grey) {
        vision::write_png(at(name), Photo(width, height, glm::u8vec3(grey)));
        expect_rocks(at(name), 0);
    };
    blank("black.png", 200, 150, 0);
    blank("white.png", 200, 150, 255);
    blank("one.png", 1, 1, 77);
    blank("tall.png", 1, 10000, 128);
    blank("wide.png", 10000, 1, 128);
}

TEST_F(BadInput, EveryFormOfPictureGivesTheSameRocks) {
    test::write_test_photo(at("plain.png"), 240, 160);
    const Photo photo = vision::read_photo(at("plain.png")).pixels;
    const ProgramRun run = rocks(at("plain.png"));
    ASSERT_EQ(run.status, 0) << run.errors;
    const std::size_t n = vision::read_rocks_json(at("out") / "rocks.json").rocks.size();
    fs::remove_all(at("out"));
    ASSERT_GT(n, 5U);
    test::write_in_form(at("sixteen.png"), photo, test::Form::Sixteen);
    test::write_in_form(at("alpha.png"), photo, test::Form::Alpha);
    test::write_in_form(at("sixteen.tif"), photo, test::Form::Sixteen);
    for (const char* name : {"sixteen.png", "alpha.png", "sixteen.tif"})
        expect_rocks(at(name), n);
}

TEST_F(BadInput, GreyPaletteCmykAndAnimatedPicturesWork) {
    test::write_test_photo(at("plain.png"), 240, 160);
    const Photo photo = vision::read_photo(at("plain.png")).pixels;
    Raster<std::uint8_t> green(photo.width(), photo.height());
    std::vector<glm::u8vec3> palette;
    for (int i = 0; i < 256; ++i)
        palette.emplace_back(i);
    for (std::size_t i = 0; i < photo.size(); ++i)
        green.data()[i] = photo.data()[i].y;
    write_whole_file(at("palette.png"), std::string_view(test::palette_png(green, palette)));
    test::write_in_form(at("grey.png"), photo, test::Form::Grey);
    test::write_in_form(at("cmyk.tif"), photo, test::Form::Cmyk);
    test::write_in_form(at("animated.gif"), photo, test::Form::Animated);
    for (const char* name : {"palette.png", "grey.png", "cmyk.tif", "animated.gif"}) {
        const ProgramRun run = rocks(at(name));
        ASSERT_EQ(run.status, 0) << name << ": " << run.errors;
        EXPECT_GT(vision::read_rocks_json(at("out") / "rocks.json").rocks.size(), 5U) << name;
        fs::remove_all(at("out"));
    }
}

TEST_F(BadInput, AnOutputThatCannotBeWrittenIsSaidAtOnce) {
    test::write_test_photo(at("photo.png"), 120, 90);
    write_whole_file(at("file"), std::string_view("in the way"));
    const ProgramRun below = test::scree({"rocks", at("photo.png"), "-o", at("file") / "out"});
    EXPECT_EQ(below.status, 1);
    EXPECT_THAT(below.errors, HasSubstr("cannot make folder"));
    EXPECT_THAT(below.errors, testing::Not(HasSubstr("finding")));
    EXPECT_EQ(read_whole_file(at("file"), 100), "in the way");
    fs::create_directories(at("taken") / "overlay.png");
    const ProgramRun taken = test::scree({"rocks", at("photo.png"), "-o", at("taken")});
    EXPECT_EQ(taken.status, 1);
    EXPECT_THAT(taken.errors, HasSubstr("overlay.png"));
    EXPECT_THAT(files_below(at("taken")), IsEmpty());
}

TEST_F(BadInput, AFullDiskLeavesNothing) {
    test::write_test_photo(at("photo.png"), 240, 160);
    for (const long bytes : {0L, 2000L, 30000L}) {
        const ProgramRun run = rocks(at("photo.png"), {.folder = {}, .largest_file = bytes});
        EXPECT_EQ(run.status, 1) << bytes;
        EXPECT_THAT(run.errors, HasSubstr("cannot write")) << bytes;
        EXPECT_THAT(run.errors, testing::Not(HasSubstr(".scree-"))) << bytes;
        EXPECT_FALSE(fs::exists(at("out"))) << bytes;
    }
    const ProgramRun full = test::run_program(
        "/bin/sh", {"-c", std::string(SCREE_PROGRAM) + " --help > /dev/full; echo status $?"});
    EXPECT_THAT(full.output, HasSubstr("status 1"));
}

TEST_F(BadInput, CtrlCLeavesNothingHalfWritten) {
    test::write_test_photo(at("photo.png"), 900, 600);
    for (const int delay : {150, 400, 700, 1000}) {
        const ProgramRun run = rocks(at("photo.png"), {.folder = {}, .interrupt_after_ms = delay});
        for (const auto& [name, bytes] : files_below(at("out")))
            EXPECT_THAT(name, testing::Not(HasSubstr(".scree-"))) << delay;
        if (run.status == 0) {  // it was faster
            EXPECT_EQ(files_below(at("out")).count("preview.png"), 1U);
        } else {
            EXPECT_EQ(run.status, 130) << delay << run.errors;
            EXPECT_FALSE(fs::exists(at("out"))) << delay;
        }
        fs::remove_all(at("out"));
    }
}

TEST_F(BadInput, BrokenFilesOfRocksAreRefused) {
    write_whole_file(at("bad.json"), std::string_view("{\"format\": \"scree-rocks\""));
    write_whole_file(at("other.json"), std::string_view("[1, 2, 3]"));
    for (const char* name : {"bad.json", "other.json", "missing.json"}) {
        for (const char* command : {"mesh", "scatter"}) {
            const ProgramRun run = test::scree({command, at(name), "-o", at("out")});
            EXPECT_EQ(run.status, 1) << name;
            EXPECT_THAT(run.errors, HasSubstr(name));
            EXPECT_FALSE(fs::exists(at("out")));
        }
    }
}

TEST_F(BadInput, ValuesOutOfRangeCostNoWork) {
    const ProgramRun range =
        test::scree({"rocks", at("missing.png"), "-o", at("out"), "--max-segments", "2"});
    EXPECT_EQ(range.status, 2);
    EXPECT_THAT(range.errors, HasSubstr("max-segments is 2, must be in [3, 720]"));
    const ProgramRun word =
        test::scree({"rocks", at("missing.png"), "-o", at("out"), "--method", "magic"});
    EXPECT_EQ(word.status, 2);
    EXPECT_THAT(word.errors,
                HasSubstr("--method needs classical or thesis or learned, got 'magic'"));
    const ProgramRun number =
        test::scree({"rocks", at("missing.png"), "-o", at("out"), "--width-m", "wide"});
    EXPECT_EQ(number.status, 2);
    EXPECT_THAT(number.errors, HasSubstr("--width-m needs a number, got 'wide'"));
    const ProgramRun nan =
        test::scree({"rocks", at("missing.png"), "-o", at("out"), "--width-m", "nan"});
    EXPECT_EQ(nan.status, 2);
    const ProgramRun missing = test::scree({"rocks", at("missing.png")});
    EXPECT_EQ(missing.status, 2);
    EXPECT_THAT(missing.errors, HasSubstr("-o DIR is missing"));
}

}  // namespace
}  // namespace scree
