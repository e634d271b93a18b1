#include "terrain/material/materials_json.h"

#include "base/error.h"
#include "tests/terrain/material/map_samples.h"

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

MaterialTable full_table() {
    MaterialTable table{0.05, "set/ids.png", "set/params.exr", test::three_materials()};
    table.materials[2].textures = {"set/textures/peb \"bles.png", "/abs/peb.exr", "other/n.png",
                                   0.7, 0.031};
    table.materials[2].gravel = true;
    table.materials[1].hat = {0.0, 0.1 + 0.2, 1.0};
    table.materials[0].colour = glm::u8vec3(255, 0, 17);
    table.materials[0].soil.compaction = 1.0 / 3.0;
    return table;
}

TEST(MaterialsJson, KeepsEverythingAndWritesTheSameBytesAgain) {
    const MaterialTable table = full_table();
    const std::string text = materials_to_json(table, "set");
    const MaterialTable again = materials_from_json(text, "m.json", "set");
    EXPECT_EQ(materials_to_json(again, "set"), text);
    EXPECT_EQ(again.materials.size(), 3U);
    EXPECT_EQ(again.materials[2].textures.albedo, table.materials[2].textures.albedo);
    EXPECT_EQ(again.materials[1], table.materials[1]);
    EXPECT_EQ(again.materials[0], table.materials[0]);
    EXPECT_EQ(again.cell_size, table.cell_size);
    EXPECT_EQ(again.ids, table.ids);
    EXPECT_THAT(text, HasSubstr("../other/n.png"));
}

TEST(MaterialsJson, FillsInWhatIsNotSaid) {
    const auto table = materials_from_json(
        R"({"format":"scree-materials","version":1,"materials":[{"id":5,"name":"b"},{"id":2,"name":"a"}]})",
        "m", "");
    ASSERT_EQ(table.materials.size(), 2U);
    EXPECT_EQ(table.materials[0].id, 2);
    EXPECT_EQ(table.materials[0].soil, Soil{});
    EXPECT_EQ(table.materials[1].hat, HatShape{});
    EXPECT_TRUE(table.ids.empty());
}

struct Wrong {
    const char* from;
    const char* to;
    const char* words;
};

class MaterialsJsonErrors : public testing::TestWithParam<Wrong> {};

TEST_P(MaterialsJsonErrors, NameFileAndPath) {
    std::string text = materials_to_json(full_table(), "set");
    const auto at = text.find(GetParam().from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::string(GetParam().from).size(), GetParam().to);
    EXPECT_THAT(
        [&] { materials_from_json(text, "m.json", "set"); },
        ThrowsMessage<InvalidInput>(AllOf(HasSubstr("m.json"), HasSubstr(GetParam().words))));
}

INSTANTIATE_TEST_SUITE_P(
    All, MaterialsJsonErrors,
    testing::Values(
        Wrong{"\"version\": 1", "\"version\": 2", "version is 2, must be in [1, 1]"},
        Wrong{"scree-materials", "scree-rocks", "format is \"scree-rocks\""},
        Wrong{"\"cell_size\"", "\"cellsize\"", "unknown member \"cellsize\""},
        Wrong{"\"mobility\": 0.5", "\"mobility\": -1", "materials[0].mobility is -1"},
        Wrong{"\"mobility\": 0.5", "\"mobility\": \"x\"",
              "materials[0].mobility is of type string"},
        Wrong{"\"mobility\": 0.5", "\"mobility\": 1e999", "no JSON"},
        Wrong{"\"name\": \"wet mud\"", "\"name\": 7", "materials[1].name is of type number"},
        Wrong{"\"name\": \"wet mud\"", "\"name\": \"a\\nb\"", "materials[1].name must be"},
        Wrong{"\"name\": \"wet mud\", ", "", "materials[1].name is missing"},
        Wrong{"\"id\": 3", "\"id\": 300", "materials[1].id is 300"},
        Wrong{"\"id\": 3", "\"id\": 2.5", "materials[1].id is of type number, must be a whole"},
        Wrong{"\"id\": 3", "\"id\": 7", "id 7 follows id 7"},
        Wrong{"\"id\": 3", "\"id\": 3, \"id\": 4", "member \"id\" twice"},
        Wrong{"\"gravel\": true", "\"gravel\": 1", "materials[2].gravel is of type number"},
        Wrong{"\"size_m\": 0.7", "\"size_m\": 0", "materials[2].textures.size_m is 0"},
        Wrong{"\"hat\": [0, ", "\"hat\": [", "materials[1].hat must have 3 entries"},
        Wrong{"\"hat\": [0, ", "\"hat\": [0.9, ", "it must be -1, -1, -1 or"},
        Wrong{"[255, 0, 17]", "[256, 0, 17]", "materials[0].colour[0] is 256"},
        Wrong{"\"materials\": [", "\"materials\": [ [[[[[[[[[[[[[[[[[[", "deeper than 16"},
        Wrong{" ]\n}", " ]", "no JSON at line"}));

TEST(MaterialsJson, RefusesOtherThings) {
    EXPECT_THROW(materials_from_json("", "m", ""), InvalidInput);
    EXPECT_THROW(materials_from_json("[]", "m", ""), InvalidInput);
    EXPECT_THROW(materials_from_json("{}", "m", ""), InvalidInput);
    EXPECT_THROW(materials_from_json("\xff\xfe", "m", ""), InvalidInput);
    EXPECT_THROW(read_materials("/no/such/materials.json"), IoError);
}

}  // namespace
}  // namespace scree::terrain
