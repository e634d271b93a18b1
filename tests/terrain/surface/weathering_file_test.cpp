#include "terrain/surface/weathering_file.h"

#include "base/error.h"
#include "tests/support/mesh_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree {
namespace {

using testing::ThrowsMessage;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(WeatheringFile, ReadsBackWhatItWrote) {
    terrain::WeatheringState state;
    state.mesh = test::icosphere(1);
    state.mesh.texcoords.assign(state.mesh.positions.size(), {0.25F, 0.5F});
    state.steps = 17;
    state.dose = 1.7;
    state.step_limit = 20;
    state.restarts = 1;
    state.frozen_factor = 0.5F;
    const auto again = terrain::decode_state(bytes_of(terrain::encode_state(state, 5)), 5, "file");
    EXPECT_EQ(again.mesh.positions, state.mesh.positions);
    EXPECT_EQ(again.mesh.texcoords, state.mesh.texcoords);
    EXPECT_EQ(again.mesh.triangles, state.mesh.triangles);
    EXPECT_EQ(again.steps, 17);
    EXPECT_EQ(again.dose, 1.7);
    EXPECT_EQ(again.step_limit, 20);
    EXPECT_EQ(again.restarts, 1);
    EXPECT_EQ(again.frozen_factor, 0.5F);
}

TEST(WeatheringFile, KnowsItsRun) {
    const meshing::TriMesh mesh = test::icosphere(1);
    meshing::TriMesh other = mesh;
    other.positions[3].x += 0.1F;
    const auto key = terrain::run_key(mesh, {});
    EXPECT_EQ(key, terrain::run_key(mesh, {}));
    EXPECT_NE(key, terrain::run_key(other, {}));
    EXPECT_NE(key, terrain::run_key(mesh, {.power = 2}));
    EXPECT_NE(key, terrain::run_key(mesh, {.rim = meshing::RimPolicy::Free}));
}

TEST(WeatheringFileErrors, SayWhatIsWrong) {
    terrain::WeatheringState state;
    state.mesh = test::icosphere(0);
    state.step_limit = 10;
    const std::string good = terrain::encode_state(state, 5);
    EXPECT_THAT([&] { terrain::decode_state(bytes_of(good), 6, "run.state"); },
                ThrowsMessage<InvalidInput>(
                    "cannot resume from run.state: it belongs to another mesh or other options; "
                    "remove it to start from the beginning"));
    EXPECT_THAT(
        [&] { terrain::decode_state(bytes_of("something else entirely"), 5, "x"); },
        ThrowsMessage<InvalidInput>("cannot resume from x: it is no checkpoint of scree weather"));
    for (std::size_t n = 0; n < good.size(); n += 7)
        EXPECT_THROW(terrain::decode_state(bytes_of(good.substr(0, n)), 5, "x"), InvalidInput);
    for (std::size_t i = 0; i < good.size(); i += 11) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ 0x40);
        EXPECT_THROW(terrain::decode_state(bytes_of(bad), 5, "x"), InvalidInput) << "byte " << i;
    }
}

}  // namespace
}  // namespace scree
