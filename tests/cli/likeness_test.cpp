#include "testdata/other_pictures.h"
#include "testdata/synthetic_photo.h"
#include "tests/cli/folder.h"
#include "tests/cli/scree.h"
#include "tests/support/temp_dir.h"
#include "vision/data/rocks_json.h"
#include "vision/image_io.h"

#include <filesystem>

#include <gmock/gmock.h>

namespace scree {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kWarning = "does not look like gravel";

// Likeness that the command writes for a picture; the warning must say the same.
double likeness_of(const std::filesystem::path& photo, const std::filesystem::path& out) {
    const auto run = test::scree({"rocks", photo, "-o", out, "--method", "classical"});
    EXPECT_EQ(run.status, 0) << run.errors;
    const double likeness = vision::read_rocks_json(out / "rocks.json").likeness.value_or(-1.0);
    EXPECT_EQ(run.errors.find(kWarning) != std::string::npos, likeness < 0.5) << run.errors;
    return likeness;
}

TEST(Likeness, DrawnPicturesOfOtherThingsAreWarnedAbout) {
    const test::TempDir dir;
    using test::Subject;
    for (const Subject subject :
         {Subject::Black, Subject::White, Subject::Noise, Subject::Gradient, Subject::Bricks,
          Subject::Text, Subject::Face, Subject::Stripes}) {
        const auto name = test::kSubjectNames[static_cast<std::size_t>(subject)];
        const auto photo = dir / (std::string(name) + ".png");
        vision::write_png(photo, test::draw_subject(subject, 320, 256));
        EXPECT_LT(likeness_of(photo, dir / std::string(name)), 0.5) << name;
    }
}

TEST(Likeness, GravelIsNotAndQuietSaysNothing) {
    const test::TempDir dir;
    const auto gravel = dir / "gravel.png";
    vision::write_png(gravel, test::make_synthetic_photo({.width = 360, .height = 300}).photo);
    EXPECT_GE(likeness_of(gravel, dir / "gravel"), 0.5);
    const auto wall = dir / "wall.png";
    vision::write_png(wall, test::draw_subject(test::Subject::Bricks, 320, 256));
    const auto quiet = test::scree({"rocks", wall, "-o", dir / "wall", "--quiet"});
    EXPECT_THAT(quiet.errors, IsEmpty());
    const auto json = test::scree({"rocks", wall, "-o", dir / "wall", "--json"});
    EXPECT_THAT(json.output, HasSubstr("likeness_to_gravel"));
}

// Photographs of Debian's python3-skimage, where it is installed.
TEST(Likeness, PhotographsOfOtherThingsAreWarnedAbout) {
    const std::filesystem::path folder = "/usr/lib/python3/dist-packages/skimage/data";
    if (!std::filesystem::exists(folder / "brick.png"))
        GTEST_SKIP() << "SKIPPED: Debian's python3-skimage is not installed, so no photographs of "
                        "other things are at hand";
    const test::TempDir dir;
    for (const char* name : {"brick.png", "coffee.png", "text.png", "page.png", "moon.png"}) {
        if (!std::filesystem::exists(folder / name))
            continue;
        EXPECT_LT(likeness_of(folder / name, dir / name), 0.5) << name;
    }
    EXPECT_GE(likeness_of(folder / "gravel.png", dir / "gravel"), 0.5);
}

}  // namespace
}  // namespace scree
