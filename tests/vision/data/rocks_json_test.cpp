#include "vision/data/rocks_json.h"

#include "base/error.h"
#include "base/random.h"
#include "base/whole_file.h"
#include "tests/support/temp_dir.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

RockSet random_set(std::size_t n_rocks, std::uint64_t seed) {
    RockSet set{.image = "gravel \"west\" \xC3\xA4.png",
                .width = 900,
                .height = 600,
                .metres_per_pixel = 0.00039,
                .method = "classical",
                .rocks = {}};
    Rng rng({.seed = seed});
    for (std::size_t i = 0; i < n_rocks; ++i) {
        Rock rock;
        rock.outline.centre = {rng.uniform(-5, 905), rng.uniform(-5, 605)};
        for (float& radius : rock.outline.radii)
            radius = static_cast<float>(std::exp(rng.uniform(-12, 12)));
        rock.outline.confidence = static_cast<float>(rng.uniform());
        rock.outline.touches_border = rng.below(2) == 1;
        rock.depth = static_cast<float>(rng.uniform(0.1, 50));
        rock.uncertainty = static_cast<float>(rng.uniform());
        set.rocks.push_back(rock);
    }
    return set;
}

std::string one_rock() {
    return rocks_to_json(random_set(1, 1));
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

void expect_refused(const std::string& text, const std::string& message) {
    EXPECT_THAT([&] { rocks_from_json(text, "r.json"); },
                ThrowsMessage<InvalidInput>(AllOf(HasSubstr("r.json"), HasSubstr(message))));
}

class RocksJson : public testing::TestWithParam<std::uint64_t> {};  // a seed

TEST_P(RocksJson, LoadAndSaveChangeNoByteAndNoValue) {
    const RockSet set = random_set(20, GetParam());
    const std::string text = rocks_to_json(set);
    const RockSet loaded = rocks_from_json(text, "r.json");
    EXPECT_EQ(rocks_to_json(loaded), text);
    ASSERT_EQ(loaded.rocks.size(), set.rocks.size());
    EXPECT_EQ(loaded.image, set.image);
    EXPECT_EQ(loaded.metres_per_pixel, set.metres_per_pixel);
    for (std::size_t i = 0; i < set.rocks.size(); ++i) {
        EXPECT_EQ(loaded.rocks[i].outline.radii, set.rocks[i].outline.radii);
        EXPECT_EQ(loaded.rocks[i].outline.centre, set.rocks[i].outline.centre);
        EXPECT_EQ(loaded.rocks[i].outline.touches_border, set.rocks[i].outline.touches_border);
        EXPECT_EQ(loaded.rocks[i].depth, set.rocks[i].depth);
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, RocksJson, testing::Range<std::uint64_t>(0, 8));

TEST(RocksJsonFile, GoesThroughAFile) {
    const test::TempDir dir;
    const RockSet set = random_set(3, 9);
    write_rocks_json(dir / "rocks.json", set);
    EXPECT_EQ(read_whole_file(dir / "rocks.json", 1 << 20), rocks_to_json(set));
    EXPECT_EQ(rocks_to_json(read_rocks_json(dir / "rocks.json")), rocks_to_json(set));
    EXPECT_THROW(read_rocks_json(dir / "none.json"), IoError);
}

TEST(RocksJsonFile, OneLineARock) {
    const std::string five = rocks_to_json(random_set(5, 2));
    const std::string six = rocks_to_json(random_set(6, 2));
    EXPECT_EQ(std::count(six.begin(), six.end(), '\n') - std::count(five.begin(), five.end(), '\n'),
              1);
}

TEST(RocksJsonFile, AnySpacingAndOrderIsRead) {
    const std::string text = changed(one_rock(), "\"version\":1,\n", "");
    const std::string moved = changed(text, "\n]\n}", "\n] ,\t\"version\" : 1.0e0 }");
    EXPECT_EQ(rocks_to_json(rocks_from_json(moved, "r.json")), one_rock());
}

TEST(RocksJsonFile, UnknownScaleIsNull) {
    RockSet set = random_set(1, 1);
    set.metres_per_pixel = 0.0;
    const std::string text = rocks_to_json(set);
    EXPECT_THAT(text, HasSubstr("\"metres_per_pixel\":null"));
    EXPECT_EQ(rocks_from_json(text, "r.json").metres_per_pixel, 0.0);
}

TEST(RocksJsonFile, NameThatIsNoUtf8StillRoundTrips) {
    RockSet set = random_set(1, 1);
    set.image = "bad\xFFname.png";
    const std::string text = rocks_to_json(set);
    EXPECT_EQ(rocks_to_json(rocks_from_json(text, "r.json")), text);
}

TEST(RocksJsonFile, LikenessMakesItVersionTwo) {
    RockSet set = random_set(2, 4);
    EXPECT_FALSE(rocks_from_json(rocks_to_json(set), "r.json").likeness.has_value());
    set.likeness = 0.625;
    const std::string text = rocks_to_json(set);
    EXPECT_THAT(text, HasSubstr("\"version\":2"));
    EXPECT_EQ(rocks_from_json(text, "r.json").likeness, 0.625);
    EXPECT_EQ(rocks_to_json(rocks_from_json(text, "r.json")), text);
    expect_refused(changed(text, "\"version\":2", "\"version\":1"),
                   "likeness is no member of format scree-rocks version 1");
    expect_refused(changed(text, "\"likeness\":0.625,\n", ""), "has no member 'likeness'");
    expect_refused(changed(text, "0.625", "1.5"), "likeness is 1.5");
    expect_refused(changed(text, "0.625", "null"), "likeness must be a number");
    set.likeness = -0.1;
    EXPECT_THROW(rocks_to_json(set), InvalidInput);
}

TEST(RocksJsonErrors, NameTheMember) {
    const std::string good = one_rock();
    expect_refused("", "is no JSON");
    expect_refused("[]", "is a list and should not be");
    expect_refused("{}", "has no member 'format'");
    expect_refused("7", "must be an object");
    expect_refused(good + "x", "is no JSON");
    expect_refused(good.substr(0, good.size() / 2), "is no JSON");
    expect_refused(changed(good, "scree-rocks", "other"), "format is 'other'");
    expect_refused(changed(good, "\"version\":1", "\"version\":3"), "version is 3");
    expect_refused(changed(good, "\"depth\"", "\"deep\""), "rocks[0].deep is no member");
    expect_refused(changed(good, "\"depth\":", "\"depth\":1,\"depth\":"),
                   "rocks[0].depth is given");
    expect_refused(changed(good, "\"touches_border\":", "\"touches_border\":1,\"x\":"),
                   "rocks[0].touches_border must be true or false");
    expect_refused(changed(good, "\"radii\":[", "\"radii\":[1,"), "has 361 numbers");
    expect_refused(changed(good, "\"radii\":[", "\"radii\":[[1],"), "rocks[0].radii[0]");
    expect_refused(changed(good, "\"radii\":[", "\"radii\":[3,-1,"), "362 numbers");
    expect_refused(changed(good, "\"width\":900", "\"width\":900.5"), "width is 900.5");
    expect_refused(changed(good, "\"width\":900", "\"width\":0"), "width is 0");
    expect_refused(changed(good, "\"width\":900", "\"width\":2000000000"), "the limit is");
    expect_refused(changed(good, "\"image\":\"", "\"image\":\"../"), "without its folder");
    expect_refused(changed(good, "\"image\":\"", "\"image\":\"\\u0001"), "control character");
    expect_refused(changed(good, "\"metres_per_pixel\":", "\"metres_per_pixel\":-"),
                   "metres_per_pixel is -");
}

TEST(RocksJsonErrors, BadNumbersNameTheirPlace) {
    RockSet set = random_set(2, 1);
    set.rocks[1].outline.radii[17] = -1.0F;
    EXPECT_THAT([&] { rocks_to_json(set); },
                ThrowsMessage<InvalidInput>(HasSubstr("rocks[1].radii[17] is -1")));
    set = random_set(2, 1);
    set.rocks[0].outline.centre.y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT([&] { rocks_to_json(set); },
                ThrowsMessage<InvalidInput>(HasSubstr("rocks[0].centre[1]")));
    const std::string good = one_rock();
    const auto start = good.find("\"depth\":") + 8;
    const auto end = good.find(',', start);
    for (const char* bad : {"1e300", "-1", "0", "null", "\"3\"", "NaN", "true", "-1e-300"})
        EXPECT_THROW(rocks_from_json(good.substr(0, start) + bad + good.substr(end), "r.json"),
                     InvalidInput)
            << bad;
    EXPECT_NO_THROW(rocks_from_json(good.substr(0, start) + "7" + good.substr(end), "r.json"));
}

TEST(RocksJsonErrors, HostileShapesEndAtOnce) {
    expect_refused(std::string(1 << 20, '['), "is a list");
    std::string deep;
    for (int i = 0; i < 100000; ++i)
        deep += "{\"rocks\":";
    expect_refused(deep, "is an object and should not be");
    std::string many = changed(one_rock(), "\"rocks\":[\n", "\"rocks\":[");
    many = changed(many, "{\"centre\"", "{},{\"centre\"");
    expect_refused(many, "rocks[0] has no member 'centre'");
    EXPECT_THROW(rocks_from_json(one_rock(), "r.json", {.max_bytes = 100}), InvalidInput);
    RockSet set = random_set(1, 1);
    set.rocks.resize(65536, set.rocks[0]);
    EXPECT_THROW(rocks_to_json(set), InvalidInput);
}

TEST(RocksJsonErrors, AnyCutOfTheTextIsRefused) {
    const std::string good = one_rock();
    for (std::size_t n = 0; n + 2 < good.size(); n += 7)
        EXPECT_THROW(rocks_from_json(good.substr(0, n), "r.json"), InvalidInput) << n;
}

}  // namespace
}  // namespace scree::vision
