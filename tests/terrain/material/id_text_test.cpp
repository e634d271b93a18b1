#include "terrain/material/id_text.h"

#include "base/error.h"
#include "tests/terrain/material/map_samples.h"

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

IdFile sample() {
    IdFile file{1.25, 0.1 + 0.2, 0.05, test::three_materials()};
    for (Material& material : file.materials)
        material.soil = {};  // the file has none
    file.materials[0].name = "-";
    file.materials[1].name = "wet \"mud\" # 2 \\";
    file.materials[1].textures.albedo = "set/my mud.png";
    file.materials[1].textures.normal = "set/-";
    file.materials[1].gravel = true;
    file.materials[2].hat = {0.0, 7.0 / 255.0, 1.0};
    return file;
}

TEST(IdText, KeepsEverythingAndWritesTheSameBytesAgain) {
    const std::string text = ids_to_text(sample(), "set");
    const IdFile again = ids_from_text(text, "ids.txt", "set");
    EXPECT_EQ(again, sample());
    EXPECT_EQ(ids_to_text(again, "set"), text);
}

TEST(IdText, TakesAnySpacingAndComments) {
    const IdFile file = ids_from_text(
        "#hello\r\n\n  version\t1 # one\r\n7 b - - - 0 - - -\n"
        "2\ta a.png - - 1 0 0.5 1",
        "t", "dir");
    ASSERT_EQ(file.materials.size(), 2U);
    EXPECT_EQ(file.materials[0].name, "a");
    EXPECT_EQ(file.materials[0].textures.albedo, "dir/a.png");
    EXPECT_TRUE(file.materials[0].gravel);
    EXPECT_EQ(file.materials[0].hat, (HatShape{0.0, 0.5, 1.0}));
    EXPECT_EQ(file.materials[1].hat, HatShape{});
    EXPECT_EQ(file.mobility_max, 1.0);
    EXPECT_EQ(file.cell_size, 0.0);
}

struct Wrong {
    const char* text;
    const char* words;
};

class IdTextErrors : public testing::TestWithParam<Wrong> {};

TEST_P(IdTextErrors, NameTheLine) {
    EXPECT_THAT([] { ids_from_text(GetParam().text, "t", ""); },
                ThrowsMessage<InvalidInput>(HasSubstr(GetParam().words)));
}

INSTANTIATE_TEST_SUITE_P(
    All, IdTextErrors,
    testing::Values(
        Wrong{"", "t has 0 materials"},
        Wrong{"0 a - - - 0 - - -", "t:1: the line 'version 1' must stand"},
        Wrong{"version 2\n", "t:1: '2' should be a whole number in [1, 1]"},
        Wrong{"version 1\nversion 1\n", "t:2: 'version' is given twice"},
        Wrong{"version\n", "t:1: 'version' needs one number"},
        Wrong{"version 1\nmobility_max 0\n", "t:2: '0' should be a number in"},
        Wrong{"version 1\ndiffusion_max nan\n", "t:2: 'nan' should be a number"},
        Wrong{"version 1\n0 a - - - 0 - - -\ncell_size 1\n", "t:3: 'cell_size' must stand before"},
        Wrong{"version 1\n\n0 a - - - 0 - -\n", "t:3: 8 words, 9 are needed"},
        Wrong{"version 1\n0 a - - - 0 - - - -\n", "t:2: more than 9 words"},
        Wrong{"version 1\n256 a - - - 0 - - -\n",
              "t:2: '256' should be a whole number in [0, 255]"},
        Wrong{"version 1\nx a - - - 0 - - -\n", "t:2: 'x' should be a whole number"},
        Wrong{"version 1\n0 a - - - 2 - - -\n", "t:2: '2' should be a whole number in [0, 1]"},
        Wrong{"version 1\n0 a - - - 1 - - -\n", "t:2: the material of id 0 is gravel"},
        Wrong{"version 1\n0 a - - - 0 0.5 0.4 1\n", "t:2: the material of id 0 has the hat"},
        Wrong{"version 1\n0 a - - - 0 0 0 1.5\n", "t:2: '1.5' should be a number in [0, 1]"},
        Wrong{"version 1\n0 a - - - 0 - - -\n0 b - - - 0 - - -\n", "t:3: the id or the name"},
        Wrong{"version 1\n0 a - - - 0 - - -\n1 a - - - 0 - - -\n", "t:3: the id or the name"},
        Wrong{"version 1\n0 \"a - - - 0 - - -\n", "t:2: a quoted word has no end"},
        Wrong{"version 1\n0 a\x01z - - - 0 - - -\n", "t:2: the material of id 0 needs a name"}));

TEST(IdText, RefusesLargeFilesAndMaxima) {
    EXPECT_THAT([] { ids_from_text(std::string(kMaxIdFileBytes + 1, ' '), "t", ""); },
                ThrowsMessage<InvalidInput>(HasSubstr("the limit is")));
    IdFile file = sample();
    file.mobility_max = 0.0;
    EXPECT_THROW(ids_to_text(file, ""), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
