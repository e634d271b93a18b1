#include "terrain/surface/sediment.h"

#include "base/error.h"
#include "base/random.h"
#include "tests/support/mesh_shapes.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

using meshing::Adjacency;
using meshing::TriMesh;
using terrain::FluidState;
using terrain::SedimentOptions;
using terrain::SedimentReport;
using terrain::SedimentState;
using testing::HasSubstr;
using testing::ThrowsMessage;

TriMesh bumpy_ball(int levels = 3) {
    TriMesh mesh = test::icosphere(levels);
    for (glm::vec3& p : mesh.positions)
        p *= 1.0F + 0.1F * std::sin(7.0F * p.x) * std::sin(8.0F * p.y) * std::sin(9.0F * p.z);
    return mesh;
}

// Particles that touch triangles at random, at speeds of 0 to 3 m/s; some come, some go.
FluidState rub(const TriMesh& mesh, std::uint64_t seed, std::uint64_t step) {
    Rng rng({seed, 11, step, 0});
    FluidState fluid;
    for (std::uint64_t id = 0; id < 200; ++id) {
        if (rng.below(10) == 0 || (id < 20 && step > 3))
            continue;
        const auto t = static_cast<std::uint32_t>(rng.below(mesh.triangles.size()));
        fluid.positions.push_back(mesh.positions[mesh.triangles[t].x]);
        fluid.velocities.emplace_back(rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2));
        fluid.ids.push_back(id);
        fluid.contacts.push_back({t, static_cast<float>(rng.uniform(0.0, 0.06))});
    }
    fluid.next_id = 200;
    return fluid;
}

class Sediment : public testing::TestWithParam<unsigned> {};

TEST_P(Sediment, TheLedgerClosesToRounding) {
    TriMesh mesh = bumpy_ball();
    const Adjacency adjacency = meshing::build_adjacency(mesh);
    const double start = meshing::signed_volume(mesh);
    SedimentState state;
    SedimentOptions options;
    options.rate = 2e-2;
    options.critical = 4.0;
    options.exponent = GetParam() % 2 == 0 ? 1.0 : 1.5;
    double deposited = 0.0;
    double before = start;
    for (std::uint64_t step = 0; step < 12; ++step) {
        const SedimentReport report = terrain::exchange_sediment(
            mesh, adjacency, rub(mesh, GetParam(), step), 0.02, options, state);
        const double now = meshing::signed_volume(mesh);
        EXPECT_NEAR(now - before, report.volume_change, 1e-13);
        EXPECT_NEAR(now + state.carried_sum() + state.pending_sum() + state.lost, start, 1e-12);
        before = now;
        deposited += report.deposited;
    }
    EXPECT_LT(before, start - 1e-3);
    EXPECT_GT(deposited, 0.0);
    EXPECT_GT(state.lost, 0.0);
    EXPECT_NEAR(state.eroded, state.deposited + state.carried_sum() + state.lost, 1e-12);
    for (const double carried : state.carried)
        EXPECT_GE(carried, 0.0);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Sediment, testing::Range(0U, 4U));

TEST(Sediment, RateChangesItsSignAtTheCriticalStress) {
    SedimentOptions o;
    o.rate = 2.0;
    o.critical = 3.0;
    o.shear_power = 0.5;  // tau = sqrt(theta)
    EXPECT_EQ(terrain::erosion_rate(9.0, o), 0.0);
    EXPECT_GT(terrain::erosion_rate(9.01, o), 0.0);
    EXPECT_LT(terrain::erosion_rate(8.99, o), 0.0);
    EXPECT_NEAR(terrain::erosion_rate(25.0, o), 4.0, 1e-12);  // linear for an exponent of 1
    EXPECT_NEAR(terrain::erosion_rate(49.0, o), 8.0, 1e-12);
    o.exponent = 2.0;
    EXPECT_NEAR(terrain::erosion_rate(25.0, o), 8.0, 1e-12);
    EXPECT_NEAR(terrain::erosion_rate(1.0, o), -8.0, 1e-12);
}

FluidState one_particle(std::uint32_t triangle, const glm::vec3& velocity, float distance = 0.05F) {
    FluidState fluid;
    fluid.positions = {glm::vec3(0.0F)};
    fluid.velocities = {velocity};
    fluid.ids = {0};
    fluid.contacts = {{triangle, distance}};
    fluid.next_id = 1;
    return fluid;
}

TEST(Sediment, TakesTheVolumeOfTheLawWhateverTheResolution) {
    SedimentOptions o;
    o.rate = 1e-2;
    o.critical = 0.0;
    o.shear_power = 1.0;
    o.step_limit = 1.0;
    // theta = 2 / 0.05 = 40, so 0.4 m/s over pi r^2 for a millisecond.
    const double expected = 0.4 * 3.14159265358979 * 0.05 * 0.05 * 1e-3;
    for (const std::uint32_t n : {6U, 12U}) {
        TriMesh mesh = test::sheet(n, 1.2F / static_cast<float>(n));
        const Adjacency adjacency = meshing::build_adjacency(mesh);
        const double before = meshing::signed_volume(mesh);
        SedimentState state;
        const std::uint32_t middle = n * n;  // of 2 n^2 triangles
        const auto report = terrain::exchange_sediment(
            mesh, adjacency, one_particle(middle + n / 2, {2, 0, 0}), 1e-3, o, state);
        EXPECT_NEAR(report.eroded, expected, 1e-3 * expected);
        EXPECT_NEAR(meshing::signed_volume(mesh) - before, -expected, 0.01 * expected);
        EXPECT_LT(std::abs(state.pending_sum()), 0.01 * expected);
    }
}

TEST(Sediment, FullVelocityFeelsAJetTangentialDoesNot) {
    TriMesh mesh = test::sheet(6, 0.1F);
    const Adjacency adjacency = meshing::build_adjacency(mesh);
    SedimentOptions o;
    o.critical = 0.0;
    SedimentState state;
    const FluidState jet = one_particle(30, {0, -3, 0});
    EXPECT_LT(terrain::exchange_sediment(mesh, adjacency, jet, 0.01, o, state).eroded, 1e-12);
    o.shear = terrain::ShearVelocity::Full;
    EXPECT_GT(terrain::exchange_sediment(mesh, adjacency, jet, 0.01, o, state).eroded, 1e-9);
}

TEST(Sediment, LaysDownWhatItCarriesAndNoMore) {
    TriMesh mesh = test::sheet(6, 0.1F);
    const Adjacency adjacency = meshing::build_adjacency(mesh);
    const TriMesh before = mesh;
    SedimentOptions o;
    o.rate = 10.0;
    o.critical = 50.0;
    SedimentState state;
    state.ids = {0};
    state.carried = {1e-6};
    const auto report =
        terrain::exchange_sediment(mesh, adjacency, one_particle(30, {0, 0, 0}), 1.0, o, state);
    EXPECT_EQ(report.deposited, 1e-6);
    EXPECT_EQ(state.carried[0], 0.0);
    EXPECT_GT(meshing::signed_volume(mesh), meshing::signed_volume(before));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_GE(mesh.positions[i].y, before.positions[i].y);
}

TEST(Sediment, CapacityAndStepLimitHold) {
    TriMesh mesh = test::sheet(6, 0.1F);
    const TriMesh before = mesh;
    const Adjacency adjacency = meshing::build_adjacency(mesh);
    SedimentOptions o;
    o.rate = 10.0;
    o.critical = 0.0;
    o.capacity = 0.5;
    SedimentState state;
    const FluidState fast = one_particle(30, {5, 0, 0});
    for (int i = 0; i < 3; ++i)
        terrain::exchange_sediment(mesh, adjacency, fast, 1.0, o, state);
    EXPECT_NEAR(state.carried[0], 0.5 * 4.0 / 3.0 * 3.14159265 * 0.05 * 0.05 * 0.05, 1e-9);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_LE(glm::distance(mesh.positions[i], before.positions[i]), 3 * 0.0121F);
    EXPECT_NE(state.pending_sum(), 0.0);  // too much for three steps: it waits
}

TEST(Sediment, RimsGiveNothing) {
    TriMesh mesh = test::sheet(1, 1.0F);
    const TriMesh before = mesh;
    const Adjacency adjacency = meshing::build_adjacency(mesh);
    SedimentState state;
    const auto report =
        terrain::exchange_sediment(mesh, adjacency, one_particle(0, {5, 0, 0}), 1.0, {}, state);
    EXPECT_EQ(report.n_exchanges, 0U);
    EXPECT_EQ(mesh.positions, before.positions);
}

TEST(Sediment, RefusesContactsOfAnotherMesh) {
    TriMesh mesh = test::sheet(2, 1.0F);
    const Adjacency adjacency = meshing::build_adjacency(mesh);
    SedimentState state;
    EXPECT_THAT(
        [&] { terrain::exchange_sediment(mesh, adjacency, one_particle(99, {}), 1.0, {}, state); },
        ThrowsMessage<InvalidInput>(HasSubstr("touches triangle 99 of a mesh that has 8")));
    EXPECT_THROW(terrain::exchange_sediment(mesh, adjacency, one_particle(0, {}), -1.0, {}, state),
                 InvalidInput);
}

}  // namespace
}  // namespace scree
