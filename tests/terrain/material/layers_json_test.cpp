#include "terrain/material/layers_json.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "terrain/material/map_files.h"
#include "tests/support/temp_dir.h"
#include "tests/terrain/material/map_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kDegree = std::numbers::pi / 180.0;

LayerStack stack_of(const std::string& members, const std::filesystem::path& folder = {}) {
    return layers_from_json(R"({"format": "scree-layers", "version": 1, )" + members + "}",
                            "l.json", test::three_materials(), folder);
}

TEST(LayersJson, ReadsThicknessMaterialsMapsAndDepth) {
    const LayerStack stack = stack_of(
        R"("surface_depth_m": 0.2, "layers": [{"thickness_m": 0.1}, {"thickness_m": 0.3},
           {"thickness_m": 0.4, "material": )" +
            std::to_string(test::three_materials()[1].id) +
            R"(}, {"thickness_m": 1, "map": "deep"}])",
        "/ground");
    ASSERT_EQ(stack.layers.size(), 4U);
    EXPECT_EQ(stack.surface_depth_m, 0.2);
    EXPECT_EQ(stack.layers[1].thickness_m, 0.3);
    EXPECT_FALSE(stack.layers[1].material);
    EXPECT_EQ(stack.layers[2].material, test::three_materials()[1].id);
    EXPECT_EQ(stack.layers[3].map, "/ground/deep");
    EXPECT_EQ(stack_of(R"("layers": [{"thickness_m": 0.1}])").surface_depth_m, 0.1);
}

// Row DM-08: the parameters of a place are those of what lies within the surface's depth.
TEST(LayersJson, LayersAreOfTheMapOfAMaterialOrOfAMapOfTheirOwn) {
    const test::TempDir dir;
    const DescriptionMap map = test::random_map(6, 5, 7, false);
    const DescriptionMap deep = test::random_map(6, 5, 8, false);
    write_description_map(deep, dir / "deep");
    const int given = map.materials[2].id;
    const LayerStack stack{
        {{0.1, {}, {}}, {0.2, given, {}}, {0.4, {}, dir / "deep"}, {0.8, {}, {}}}, 0.3};
    const MaterialLayers layers = make_layers(map, stack);
    for (std::size_t i = 0; i < map.ids.size(); ++i)
        for (std::size_t m = 0; m < 3; ++m) {
            const int id = map.materials[m].id;
            EXPECT_EQ(layers.amounts[0][m].data()[i], map.ids.data()[i] == id ? 0.1 : 0.0);
            EXPECT_EQ(layers.amounts[1][m].data()[i], m == 2 ? 0.2 : 0.0);
            EXPECT_EQ(layers.amounts[2][m].data()[i], deep.ids.data()[i] == id ? 0.4 : 0.0);
            EXPECT_EQ(layers.amounts[3][m].data()[i], map.ids.data()[i] == id ? 0.8 : 0.0);
        }
    const DescriptionMap seen = surface_map(layers, stack.surface_depth_m);
    for (std::size_t i = 0; i < map.ids.size(); ++i) {
        const auto top = static_cast<std::size_t>(
            std::find_if(map.materials.begin(), map.materials.end(),
                         [&](const Material& m) { return m.id == map.ids.data()[i]; }) -
            map.materials.begin());
        const double mixed = (std::tan(map.materials[top].soil.repose_deg * kDegree) +
                              2.0 * std::tan(map.materials[2].soil.repose_deg * kDegree)) /
                             3.0;
        EXPECT_NEAR(std::tan(seen.repose.data()[i]), mixed, 1e-5);
    }
}

TEST(LayersJsonErrors, NameFileAndPath) {
    const auto expect = [](const std::string& members, const char* where, const char* reason) {
        EXPECT_THAT([&] { stack_of(members); },
                    ThrowsMessage<InvalidInput>(testing::AllOf(
                        HasSubstr(std::string("l.json: ") + where), HasSubstr(reason))));
    };
    expect(R"("layers": [])", "layers", "at least one");
    expect(R"("layers": [{"thickness_m": 0}])", "layers[0].thickness_m", "is 0");
    expect(R"("layers": [{"thickness_m": 1, "depth": 2}])", "layers[0]", "depth");
    expect(R"("layers": [{"thickness_m": 1, "material": 0}])", "layers[0]", "the map itself");
    expect(R"("layers": [{"thickness_m": 1}, {"thickness_m": 1, "material": "ice"}])",
           "layers[1].material", "ice");
    expect(R"("layers": [{"thickness_m": 1}], "surface_depth_m": -1)", "surface_depth_m", "is -1");
    const test::TempDir dir;
    write_description_map(test::random_map(3, 3, 1, false), dir / "small");
    const DescriptionMap map = test::random_map(6, 5, 7, false);
    EXPECT_THAT(
        [&] {
            make_layers(map, {{{0.1, {}, {}}, {0.1, {}, dir / "small"}}, 0.1});
        },
        ThrowsMessage<InvalidInput>(HasSubstr("has 3 x 3 cells, the uppermost 6 x 5")));
    EXPECT_THAT(
        [&] {
            make_layers(map, {{{0.1, {}, {}}, {0.1, 99, {}}}, 0.1});
        },
        ThrowsMessage<InvalidInput>(HasSubstr("layer 1 is to be of id 99")));
    EXPECT_THROW(make_layers(map, {{{0.1, {}, {}}, {0.1, {}, dir / "none"}}, 0.1}), IoError);
}

}  // namespace
}  // namespace scree::terrain
