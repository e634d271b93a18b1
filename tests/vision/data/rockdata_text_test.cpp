#include "vision/data/rockdata_text.h"

#include "base/error.h"
#include "base/random.h"
#include "tests/support/temp_dir.h"

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

RockSet random_set(std::size_t n_rocks, std::uint64_t seed) {
    RockSet set;
    set.image = "two words.png";
    set.width = 640;
    set.height = 480;
    set.method = "thesis L=256 a=0.65";
    Rng rng({.seed = seed});
    for (std::size_t i = 0; i < n_rocks; ++i) {
        Rock rock;
        rock.outline.centre = {rng.uniform(0, 640), rng.uniform(0, 480)};
        for (float& radius : rock.outline.radii)
            radius = static_cast<float>(rng.uniform(0.01, 90));
        rock.outline.touches_border = rng.below(2) == 1;
        rock.depth = static_cast<float>(rng.uniform(0.1, 50));
        set.rocks.push_back(rock);
    }
    return set;
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

class RockText : public testing::TestWithParam<std::uint64_t> {};  // a seed

TEST_P(RockText, SaveLoadSaveGivesEqualBytes) {
    const RockSet set = random_set(5, GetParam());
    const std::string text = rocks_to_text(set);
    const RockSet loaded = rocks_from_text(text, "r.txt");
    EXPECT_EQ(rocks_to_text(loaded), text);
    EXPECT_EQ(loaded.image, set.image);
    EXPECT_EQ(loaded.method, set.method);
    ASSERT_EQ(loaded.rocks.size(), set.rocks.size());
    for (std::size_t i = 0; i < set.rocks.size(); ++i) {
        EXPECT_EQ(loaded.rocks[i].outline.radii, set.rocks[i].outline.radii);
        EXPECT_EQ(loaded.rocks[i].depth, set.rocks[i].depth);
        EXPECT_NEAR(loaded.rocks[i].outline.centre.x, set.rocks[i].outline.centre.x, 1e-6);
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, RockText, testing::Range<std::uint64_t>(0, 8));

TEST(RockTextFile, GoesThroughAFileAndOtherLineEnds) {
    const test::TempDir dir;
    const RockSet set = random_set(2, 3);
    write_rocks_text(dir / "r.txt", set);
    EXPECT_EQ(rocks_to_text(read_rocks_text(dir / "r.txt")), rocks_to_text(set));
    std::string dos = rocks_to_text(set);
    for (std::size_t at = 0; (at = dos.find('\n', at)) != std::string::npos; at += 2)
        dos.replace(at, 1, "\r\n");
    EXPECT_EQ(rocks_to_text(rocks_from_text(dos, "r.txt")), rocks_to_text(set));
}

TEST(RockTextErrors, CarryFileAndLine) {
    const std::string good = rocks_to_text(random_set(2, 1));
    const std::pair<std::string, std::string> cases[] = {
        {"", "r.txt:0: the file ends"},
        {changed(good, "rockdata 1", "rockdata 2"), "r.txt:1: found '2', expected '1'"},
        {changed(good, "640 480", "640"), "r.txt:2: "},
        {changed(good, "640 480", "640 -3"), "r.txt:2: the picture is 640 x -3"},
        {changed(good, "count 2", "count 3"), "the file ends, expected 'rock'"},
        {changed(good, "count 2", "count 1"), "text follows"},
        {changed(good, "count 2", "count 70000"), "r.txt:4: count is 70000"},
        {changed(good, "rock 0", "rock 1"), "r.txt:5: found rock 1"},
        {changed(good, "flags ", "flags x"), "r.txt:5: found flags 'x"},
        {changed(good, "radii 360", "radii 359"), "r.txt:6: a rock has 360 radii"},
        {changed(good, "radii 360\n", "radii 360\n-1 "), "r.txt:7: a radius is -1"},
        {changed(good, "radii 360\n", "radii 360\nnan "), "r.txt:7: a radius is nan"},
        {changed(good, "radii 360\n", "radii 360\n1,5 "), "r.txt:7: found '1,5'"},
        {changed(good, "radii 360\n", "radii 360\n1 "), "r.txt:7: found more than 360 radii"},
        {changed(good, "centre ", "centre 1e99 "), "r.txt:5: the centre lies at 1e+99"},
    };
    for (const auto& [text, message] : cases)
        EXPECT_THAT([&] { rocks_from_text(text, "r.txt"); },
                    ThrowsMessage<InvalidInput>(HasSubstr(message)));
}

TEST(RockTextErrors, AnyCutOfTheTextIsRefused) {
    const std::string good = rocks_to_text(random_set(1, 1));
    for (std::size_t n = 0; n + 2 < good.size(); n += 3)
        EXPECT_THROW(rocks_from_text(good.substr(0, n), "r.txt"), InvalidInput) << n;
}

}  // namespace
}  // namespace scree::vision
