#include "meshing/curvature/mean_curvature.h"
#include "meshing/mesh/normals.h"
#include "terrain/fluid/position_fluid.h"
#include "terrain/surface/erosion_ground.h"
#include "terrain/surface/erosion_loop.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

using meshing::TriMesh;
using terrain::ErosionRun;
using terrain::GroundOptions;
using terrain::GroundShape;

// A river of real water in a bed that swings to each side.
struct River {
    GroundOptions ground;
    TriMesh before;
    ErosionRun run;

    explicit River(double swing, double influence = 1.0) {
        ground = {.shape = GroundShape::Bend,
                  .length = 3.0,
                  .width = 2.2,
                  .edge = 0.1,
                  .fall = 0.15,
                  .bed_width = 0.4,
                  .bed_depth = 0.4,
                  .bank_width = 0.15,
                  .swing = swing};
        const glm::vec3 head = terrain::bed_at(ground, -1.4);
        const glm::vec3 way = terrain::bed_at(ground, -1.3) - head;
        terrain::PositionFluidSetup water;
        water.options.radius = 0.045;
        water.domain = {{-1.6F, -0.5F, -1.1F}, {1.49F, 2, 1.1F}};
        water.emitters.sources.push_back(
            {.centre = {-1.4F, 0.62F, head.z},
             .velocity = 1.78F * glm::normalize(glm::vec3(way.x, 0, way.z)),
             .radius = 0.14});
        terrain::PositionFluid fluid(water);
        before = terrain::make_ground(ground);
        run.mesh = before;
        terrain::run_erosion(run, fluid, {.steps = 50, .warm_up = 50}, {.influence = influence},
                             {});
        EXPECT_GT(run.report.mean_particles, 100.0);
    }

    // Calls body(vertex, whether it is on an outer bank) for the vertices of the banks in the
    // bends. Of a straight river each side is the outer bank of one half.
    template <class Body>
    void for_each_on_a_bank(Body&& body) const {
        for (std::size_t i = 0; i < before.positions.size(); ++i) {
            const glm::vec3 p = before.positions[i];
            const glm::vec3 bed = terrain::bed_at(ground, static_cast<double>(p.x));
            const float up = p.y - bed.y;
            if (std::abs(p.x) >= 0.4F && std::abs(p.x) <= 1.1F && up >= 0.02F && up <= 0.35F)
                body(i, (p.z - bed.z) * p.x > 0.0F);
        }
    }

    // Mean way of the outer or the inner banks, metres.
    double retreat(bool outer) const {
        double sum = 0.0;
        int n = 0;
        for_each_on_a_bank([&](std::size_t i, bool is_outer) {
            if (is_outer != outer)
                return;
            sum += static_cast<double>(glm::distance(run.mesh.positions[i], before.positions[i]));
            ++n;
        });
        EXPECT_GT(n, 20);
        return sum / n;
    }

    // Mean magnitude of the curvature of the outer banks, one over metres.
    double sharpness() const {
        const auto adjacency = meshing::build_adjacency(run.mesh);
        const auto curvature = meshing::mean_curvature(
            run.mesh, adjacency, meshing::vertex_normals(run.mesh, adjacency));
        double sum = 0.0;
        int n = 0;
        for_each_on_a_bank([&](std::size_t i, bool outer) {
            sum += outer ? static_cast<double>(std::abs(curvature[i])) : 0.0;
            n += outer ? 1 : 0;
        });
        return sum / n;
    }
};

// `mesh-erosion.md` 7.6, rows of the river: undercut and flood.
TEST(ErosionRiver, WearsTheOuterBanksOfItsBendsAndAFloodRoundsThem) {
    const River bend(0.45);
    const River straight(0.0);
    EXPECT_GT(bend.retreat(true), 1.5 * bend.retreat(false));
    EXPECT_GT(bend.retreat(true), 2.0 * straight.retreat(true));
    EXPECT_GT(bend.retreat(true), 2.0 * straight.retreat(false));
    EXPECT_NEAR(straight.retreat(true) / straight.retreat(false), 1.0, 0.3);

    const auto adjacency = meshing::build_adjacency(bend.run.mesh);
    const auto normals = meshing::vertex_normals(bend.run.mesh, adjacency);
    EXPECT_TRUE(
        std::any_of(normals.begin(), normals.end(), [](const glm::vec3& n) { return n.y < 0.0F; }));

    const River flood(0.45, 3.0);
    EXPECT_LT(flood.sharpness(), 0.9 * bend.sharpness());
}

}  // namespace
}  // namespace scree
