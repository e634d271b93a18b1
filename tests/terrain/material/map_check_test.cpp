#include "terrain/material/map_check.h"

#include "base/error.h"
#include "tests/terrain/material/map_samples.h"

#include <limits>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

template <class Change>
void expect_refused(Change change, const std::string& words) {
    DescriptionMap map = test::random_map(5, 4, 1);
    change(map);
    EXPECT_THAT([&] { check_map(map, "here"); }, ThrowsMessage<InvalidInput>(HasSubstr(words)));
}

TEST(MapCheck, AcceptsMapsWithAndWithoutPlanes) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        EXPECT_NO_THROW(check_map(test::random_map(5, 4, seed), "here"));
        EXPECT_NO_THROW(check_map(test::random_map(5, 4, seed, false), "here"));
    }
}

TEST(MapCheck, NamesTheCellAndTheId) {
    expect_refused([](auto& m) { m.ids(3, 2) = 9; }, "here: cell (3, 2) has the id 9");
    expect_refused([](auto& m) { m.ids(3, 2) = 3, m.mobility(3, 2) = -1.0F; },
                   "cell (3, 2) of id 3 has a mobility of -1");
    expect_refused([](auto& m) { m.repose(1, 1) = 1.5707964F; }, "cell (1, 1)");
    expect_refused([](auto& m) { m.diffusion(0, 3) = std::numeric_limits<float>::quiet_NaN(); },
                   "diffusion of nan");
    expect_refused([](auto& m) { m.mobility(0, 0) = std::numeric_limits<float>::infinity(); },
                   "mobility of inf");
}

TEST(MapCheck, NamesSizes) {
    expect_refused([](auto& m) { m.repose = FloatRaster(5, 5); }, "repose has 5 x 5 cells");
    expect_refused([](auto& m) { m.ids = {}; }, "0 x 0 cells");
    expect_refused([](auto& m) { m.cell_size = 0.0; }, "cell size of 0 m");
    expect_refused([](auto& m) { m.cell_size = std::numeric_limits<double>::quiet_NaN(); },
                   "cell size of nan");
    EXPECT_THAT([] { check_map_size(6e4, 6e4, "it"); },
                ThrowsMessage<InvalidInput>(HasSubstr("it has 60000 x 60000 cells, the limit is")));
}

TEST(MapCheck, NamesTheMaterial) {
    expect_refused([](auto& m) { m.materials.clear(); }, "0 materials");
    expect_refused([](auto& m) { m.materials[1].id = 0; }, "id 0 follows id 0");
    expect_refused([](auto& m) { m.materials[2].id = 256; }, "ids are 0 to 255");
    expect_refused([](auto& m) { m.materials[1].name = "sand"; }, "name 'sand' of another");
    expect_refused([](auto& m) { m.materials[1].name = "a\nb"; }, "needs a name");
    expect_refused([](auto& m) { m.materials[1].soil.repose_deg = 90; },
                   "id 3: repose is 90, must be in [0, 89] deg");
    expect_refused([](auto& m) { m.materials[2].gravel = true; }, "id 7 is gravel and has no");
    expect_refused([](auto& m) { m.materials[2].textures.size_m = 0; }, "size 0 m");
    expect_refused([](auto& m) { m.materials[0].hat = {0.5, 0.4, 0.6}; }, "hat 0.5, 0.4, 0.6");
}

TEST(MapCheck, NeighbouringIdsHaveDifferentColours) {
    for (int id = 0; id < 255; ++id) {
        const glm::ivec3 a = material_colour(
            {.id = id, .name = "", .soil = {}, .textures = {}, .hat = {}, .colour = {}});
        const glm::ivec3 b = material_colour(
            {.id = id + 1, .name = "", .soil = {}, .textures = {}, .hat = {}, .colour = {}});
        EXPECT_GT(std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z), 40) << id;
    }
    EXPECT_EQ(material_colour({.id = 1,
                               .name = "",
                               .soil = {},
                               .textures = {},
                               .hat = {},
                               .colour = glm::u8vec3(1, 2, 3)}),
              glm::u8vec3(1, 2, 3));
}

}  // namespace
}  // namespace scree::terrain
