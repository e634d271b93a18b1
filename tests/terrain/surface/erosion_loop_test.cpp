#include "terrain/surface/erosion_loop.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/curvature/mean_curvature.h"
#include "meshing/mesh/normals.h"
#include "terrain/fluid/position_fluid.h"
#include "terrain/fluid/scripted_fluid.h"
#include "terrain/fluid/triangle_grid.h"
#include "terrain/surface/erosion_checkpoint.h"
#include "terrain/surface/erosion_ground.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

using meshing::TriMesh;
using terrain::ErosionHooks;
using terrain::ErosionLoopOptions;
using terrain::ErosionRun;
using terrain::GroundOptions;
using terrain::GroundShape;
using terrain::ScriptedFluid;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr GroundOptions kCanyon = {.shape = GroundShape::Canyon,
                                   .length = 1.2,
                                   .width = 1.6,
                                   .edge = 0.06,
                                   .fall = 0.0,
                                   .bed_width = 0.5,
                                   .bed_depth = 0.5};

// A flat stream that reaches well into both walls, a little above the bed.
ScriptedFluid stream_through_canyon() {
    return ScriptedFluid({{.path = {{-0.6F, 0.1F, 0}, {0.6F, 0.1F, 0}},
                           .speed = 1.0,
                           .half_width = 0.5,
                           .half_height = 0.05,
                           .per_metre = 1200}},
                         {.radius = 0.03});
}

ErosionRun run_of(const TriMesh& mesh) {
    ErosionRun run;
    run.mesh = mesh;
    return run;
}

ErosionRun carve(int steps, const terrain::WetErosionOptions& wear = {},
                 const ErosionHooks& hooks = {}, ErosionLoopOptions loop = {}) {
    ErosionRun run = run_of(terrain::make_ground(kCanyon));
    ScriptedFluid fluid = stream_through_canyon();
    loop.steps = steps;
    terrain::run_erosion(run, fluid, loop, wear, {}, hooks);
    return run;
}

// Share of the open places beside the bed from which a ray straight up hits rock.
double covered_share(const TriMesh& mesh) {
    const terrain::TriangleGrid grid(mesh, 0.05F);
    int open = 0;
    int covered = 0;
    for (float x = -0.4F; x <= 0.4F; x += 0.05F)
        for (float z = -0.4F; z <= 0.4F; z += 0.01F)
            for (float y = 0.04F; y < 0.2F; y += 0.02F) {
                const glm::vec3 p(x, y, z);
                if (std::abs(z) < 0.22F || grid.buried(p))
                    continue;
                ++open;
                covered += grid.free_share(p, p + glm::vec3(0, 2, 0)) < 1.0F ? 1 : 0;
            }
    return open > 0 ? static_cast<double>(covered) / open : 0.0;
}

TEST(ErosionLoop, UndercutsACanyon) {
    const TriMesh before = terrain::make_ground(kCanyon);
    EXPECT_EQ(covered_share(before), 0.0);
    const ErosionRun run = carve(60);
    EXPECT_GT(covered_share(run.mesh), 0.2);
    EXPECT_EQ(run.report.steps, 60);
    EXPECT_TRUE(run.report.finished);
    EXPECT_GT(run.report.mean_affected, 100.0);
    EXPECT_GT(run.report.mean_touching, 100.0);
    // What lies higher than the water reaches keeps its bits.
    for (std::size_t i = 0; i < before.positions.size(); ++i)
        if (before.positions[i].y > 0.1F + 0.05F + 0.0625F + 0.08F) {
            ASSERT_EQ(run.mesh.positions[i], before.positions[i]);
        }
    const auto normals = meshing::vertex_normals(run.mesh, meshing::build_adjacency(run.mesh));
    EXPECT_TRUE(std::any_of(normals.begin(), normals.end(),
                            [](const glm::vec3& n) { return n.y < -0.2F; }));
}

// Mean magnitude of curvature of the vertices that began within the stream's walls.
double edge_sharpness(const TriMesh& mesh, const TriMesh& before) {
    const auto adjacency = meshing::build_adjacency(mesh);
    const auto curvature =
        meshing::mean_curvature(mesh, adjacency, meshing::vertex_normals(mesh, adjacency));
    double sum = 0.0;
    int n = 0;
    for (std::size_t i = 0; i < curvature.size(); ++i) {
        const glm::vec3 p = before.positions[i];
        if (std::abs(p.x) > 0.45F || std::abs(p.z) < 0.2F || p.y > 0.3F)
            continue;
        sum += static_cast<double>(std::abs(curvature[i]));
        ++n;
    }
    return sum / n;
}

TEST(ErosionLoop, AWiderInfluenceLeavesSmootherBanks) {
    const TriMesh before = terrain::make_ground(kCanyon);
    const double narrow = edge_sharpness(carve(40, {.influence = 1.0}).mesh, before);
    const double wide = edge_sharpness(carve(40, {.influence = 3.0}).mesh, before);
    EXPECT_LT(wide, 0.9 * narrow);
}

TEST(ErosionLoop, RollsATangleBackAndKeepsTheDose) {
    // Anything that has moved farther than half a mean edge in ten steps counts as a tangle.
    std::vector<glm::vec3> last;
    ErosionHooks hooks;
    int looks = 0;
    hooks.count_crossings = [&](const TriMesh& mesh) -> std::size_t {
        ++looks;
        return looks == 3 ? 7 : static_cast<std::size_t>(mesh.positions.empty());
    };
    const ErosionRun plain = carve(20);
    const ErosionRun run = carve(20, {}, hooks, {.check_every = 5});
    EXPECT_EQ(run.report.restarts, 1);
    EXPECT_TRUE(run.report.finished);
    EXPECT_EQ(run.report.step_limit, 20.0);
    // Five steps of 1/10 were kept; the rest of the dose of 2 takes thirty of 1/20.
    EXPECT_EQ(run.report.steps, 35);
    EXPECT_NEAR(run.dose, 2.0, 1e-9);
    EXPECT_NEAR(run.report.volume, plain.report.volume,
                0.2 * (plain.report.volume_before - plain.report.volume));
}

TEST(ErosionLoop, EndsAtTheLastSoundStateIfItTanglesTooOften) {
    ErosionHooks hooks;
    int looks = 0;
    hooks.count_crossings = [&](const TriMesh&) -> std::size_t { return looks++ < 2 ? 0 : 1; };
    const ErosionRun run = carve(20, {}, hooks, {.check_every = 4, .max_restarts = 2});
    EXPECT_FALSE(run.report.finished);
    EXPECT_EQ(run.report.restarts, 2);
    EXPECT_EQ(run.report.steps, 4);
    EXPECT_EQ(run.report.intersections, 0U);
    EXPECT_EQ(run.mesh.positions, carve(4).mesh.positions);
}

TEST(ErosionLoop, TanglesThatWereThereAtTheStartAreLeft) {
    ErosionHooks hooks;
    hooks.count_crossings = [](const TriMesh&) -> std::size_t { return 3; };
    const ErosionRun run = carve(10, {}, hooks, {.check_every = 5});
    EXPECT_TRUE(run.report.finished);
    EXPECT_EQ(run.report.restarts, 0);
    EXPECT_EQ(run.report.intersections_before, 3U);
    EXPECT_EQ(run.report.intersections, 3U);
}

TEST(ErosionLoop, GoesOnFromACheckpointToTheSameBytes) {
    const auto settle = [](int threads, bool interrupted) {
        const ThreadLimit limit(threads);
        terrain::PositionFluidSetup water;
        water.options.radius = 0.05;
        water.domain = {glm::vec3(-0.6F, -0.5F, -1), glm::vec3(0.6F, 2, 1)};
        water.emitters.rains.push_back(
            {.centre = {0, 0.3F, 0}, .width = 0.8, .depth = 0.4, .rate = 500});
        ErosionRun run = run_of(terrain::make_ground(kCanyon));
        ErosionLoopOptions loop = {
            .steps = 12, .warm_up = 6, .scheme = terrain::ErosionScheme::Sediment};
        const terrain::SedimentOptions sediment = {.rate = 1e-3, .critical = 2.0};
        const auto go = [&] {
            terrain::PositionFluid fluid(water);
            terrain::run_erosion(run, fluid, loop, {}, sediment);
        };
        if (interrupted) {
            loop.steps = 5;
            go();
            run = terrain::decode_checkpoint(terrain::encode_checkpoint(run, "x"), "x", "here");
            loop.steps = 12;
        }
        go();
        EXPECT_NE(run.sediment.eroded, 0.0);
        return run;
    };
    const ErosionRun one = settle(1, false);
    EXPECT_EQ(one.report.steps, 12);
    for (const bool interrupted : {false, true}) {
        const ErosionRun other = settle(2, interrupted);
        EXPECT_TRUE(one.mesh.positions == other.mesh.positions);
        EXPECT_TRUE(one.fluid == other.fluid);
        EXPECT_TRUE(one.sediment.carried == other.sediment.carried);
        EXPECT_EQ(one.report.mean_affected, other.report.mean_affected);
    }
}

TEST(ErosionLoop, RefusesBadOptions) {
    EXPECT_THAT(
        [] { carve(1, {}, {}, {.scheme = terrain::ErosionScheme::Sediment, .small_faces = true}); },
        ThrowsMessage<InvalidOption>(HasSubstr("kept by vertex")));
    EXPECT_THROW(carve(1, {}, {}, {.frame_seconds = 0.0}), InvalidOption);
    EXPECT_THROW(carve(1, {.step_limit = 0.5}), InvalidOption);
}

TEST(ErosionLoop, WeathersBetweenItsSteps) {
    const TriMesh before = terrain::make_ground(kCanyon);
    const ErosionRun run = carve(10, {}, {}, {.weathering = 1.0});
    // The canyon's dry upper edge is rounded, which water alone would not have done.
    double lowered = 0.0;
    for (std::size_t i = 0; i < before.positions.size(); ++i)
        if (before.positions[i].y > 0.45F)
            lowered += static_cast<double>(before.positions[i].y - run.mesh.positions[i].y);
    EXPECT_GT(lowered, 0.1);
}

TEST(ErosionLoop, RoughensItsMeshOnce) {
    const TriMesh before = terrain::make_ground(kCanyon);
    const ErosionRun run = carve(4, {}, {}, {.cosmetic_noise = 0.1});
    const double most = 0.1 * meshing::mean_edge_length(before, meshing::build_adjacency(before));
    std::size_t n_moved = 0;
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        const glm::vec3 p = before.positions[i];
        if (p.y < 0.4F)
            continue;  // may be wet
        n_moved += run.mesh.positions[i] == p ? 0 : 1;
        EXPECT_LE(glm::distance(run.mesh.positions[i], p), 1.001 * most);
    }
    EXPECT_GT(n_moved, 50U);
}

TEST(ErosionLoop, CollapsesSmallFaces) {
    // One vertex of the bed lies a hair's breadth from its neighbour.
    ErosionRun run = run_of(terrain::make_ground(kCanyon));
    const glm::uvec3 face = run.mesh.triangles[run.mesh.triangles.size() / 2 + 21];
    run.mesh.positions[face.x] =
        glm::mix(run.mesh.positions[face.x], run.mesh.positions[face.y], 0.96F);
    const std::size_t n_before = run.mesh.triangles.size();
    ScriptedFluid fluid = stream_through_canyon();
    terrain::run_erosion(run, fluid, {.steps = 3, .check_every = 1, .small_faces = true}, {}, {});
    EXPECT_GE(run.report.n_collapsed, 1U);
    EXPECT_LT(run.mesh.triangles.size(), n_before);
    EXPECT_TRUE(run.report.finished);
    EXPECT_EQ(run.report.intersections, 0U);
}

TEST(ErosionLoop, CallsItsHooksAndStopsWhenAsked) {
    class Stop : public Progress {
    public:
        void report(std::string_view, double) override { ++calls; }
        bool cancelled() const override { return calls > 4; }
        int calls = 0;
    } stop;
    int steps = 0;
    ErosionHooks hooks;
    hooks.after_step = [&](const ErosionRun& run) { EXPECT_EQ(run.report.steps, ++steps); };
    carve(3, {}, hooks);
    EXPECT_EQ(steps, 3);
    ErosionHooks stopping;
    stopping.progress = &stop;
    EXPECT_THROW(carve(50, {}, stopping), Cancelled);
}

TEST(Checkpoint, RefusesDamageAndOtherScenes) {
    const ErosionRun run = carve(2);
    const auto bytes = terrain::encode_checkpoint(run, "scene");
    EXPECT_THAT([&] { terrain::decode_checkpoint(bytes, "other", "c.bin"); },
                ThrowsMessage<InvalidInput>(HasSubstr("c.bin belongs to another scene")));
    for (const std::size_t length :
         {std::size_t{0}, std::size_t{20}, bytes.size() / 2, bytes.size() - 1}) {
        const std::vector<std::uint8_t> cut(bytes.begin(),
                                            bytes.begin() + static_cast<std::ptrdiff_t>(length));
        EXPECT_THROW(terrain::decode_checkpoint(cut, "scene", "c.bin"), InvalidInput);
    }
    for (std::size_t at = 0; at < bytes.size(); at += bytes.size() / 50) {
        auto bent = bytes;
        bent[at] ^= 0x40U;
        EXPECT_THROW(terrain::decode_checkpoint(bent, "scene", "c.bin"), InvalidInput);
    }
}

}  // namespace
}  // namespace scree
