#include "apps/erosion_pictures.h"
#include "meshing/mesh/adjacency.h"
#include "meshing/mesh/bounds.h"
#include "meshing/mesh/normals.h"
#include "meshing/mesh/topology.h"
#include "meshing/render/raster_view.h"
#include "meshing/space/self_intersection.h"
#include "terrain/fluid/scripted_fluid.h"
#include "terrain/surface/erosion_ground.h"
#include "terrain/surface/erosion_loop.h"
#include "terrain/surface/weathering.h"
#include "tests/support/golden.h"
#include "tests/support/temp_dir.h"
#include "tests/support/worn_shapes.h"
#include "vision/image_io.h"

#include <algorithm>
#include <string>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

using meshing::TriMesh;

// How the scenes of the published figures look today. Where the last bit of a power or a sine
// differs between machines an edge may collapse a step later and a shadow end a pixel further.
constexpr test::Tolerance kLooksTheSame = {.fail = 0.03, .fail_percent = 1.5, .hard_fail = 0.6};

Photo clay(TriMesh mesh) {
    mesh.normals = meshing::vertex_normals(mesh, meshing::build_adjacency(mesh));
    meshing::ViewScene scene;
    const glm::vec3 up(0.0F, -meshing::bounding_box(mesh).min.y, 0.0F);  // it stands on the ground
    scene.objects.push_back({&mesh, glm::translate(glm::mat4(1.0F), up)});
    return meshing::draw_view(scene, {.width = 150, .elevation = 20}).clay;
}

// Pictures beside each other on white, each as high as the highest.
Photo row_of(const std::vector<Photo>& pictures) {
    int width = 0, height = 0;
    for (const Photo& picture : pictures) {
        width += picture.width();
        height = std::max(height, picture.height());
    }
    Photo row(width, height, glm::u8vec3(255));
    int left = 0;
    for (const Photo& picture : pictures) {
        for (int y = 0; y < picture.height(); ++y)
            std::copy_n(picture.row(y), picture.width(), row.row(y) + left);
        left += picture.width();
    }
    return row;
}

testing::AssertionResult matches(const std::vector<Photo>& pictures, const std::string& name) {
    const test::TempDir dir;
    vision::write_png(dir / name, row_of(pictures));
    return test::matches_golden(dir / name, name, kLooksTheSame);
}

void advance_to(terrain::Weathering& run, int step) {
    while (run.report().steps < step && !run.finished())
        run.advance();
    EXPECT_EQ(run.report().steps, step);
}

TEST(WornGolden, CubeBecomesASphere) {
    std::vector<Photo> pictures;
    terrain::Weathering run(test::cube(20), {.steps = 200, .small_faces = 0});
    for (const int step : {0, 30, 100, 200}) {
        advance_to(run, step);
        pictures.push_back(clay(run.mesh()));
    }
    EXPECT_TRUE(matches(pictures, "worn_cube.png"));
}

TEST(WornGolden, PowersSpareWhatIsFlat) {
    const TriMesh start = test::lumpy_sphere(3000, 0.3);
    std::vector<Photo> pictures = {clay(start)};
    for (const double power : {1.0, 2.0, 3.0}) {
        TriMesh mesh = start;
        terrain::weather(mesh, {.steps = 50, .power = power});
        pictures.push_back(clay(mesh));
    }
    EXPECT_TRUE(matches(pictures, "worn_powers.png"));
}

// Tested after every step, and no restart is allowed: it never tangles (`mesh-erosion.md` 5).
TEST(WornGolden, ProngsRecedeFor400Steps) {
    std::vector<Photo> pictures;
    terrain::Weathering run(test::pronged(1500),
                            {.steps = 400, .power = 5, .check_every = 1, .max_restarts = 0});
    for (const int step : {0, 30, 80, 400}) {
        advance_to(run, step);
        pictures.push_back(clay(run.mesh()));
    }
    EXPECT_FALSE(run.report().gave_up);
    EXPECT_EQ(run.report().n_intersections, 0U);
    EXPECT_TRUE(meshing::find_self_intersections(run.mesh(), run.adjacency()).pairs.empty());
    EXPECT_EQ(meshing::solid_defect(run.mesh()), "");
    EXPECT_TRUE(matches(pictures, "worn_prongs.png"));
}

// A ground before and after a stream that goes where it is told, seen along its bed.
std::vector<Photo> washed(const terrain::GroundOptions& ground, int steps, double influence) {
    const TriMesh before = terrain::make_ground(ground);
    std::vector<glm::vec3> path;
    for (int k = 0; k <= 20; ++k)
        path.push_back(terrain::bed_at(ground, ground.length * (k / 20.0 - 0.5)) +
                       glm::vec3(0, 0.1F, 0));
    terrain::ScriptedFluid fluid(
        {{.path = path, .speed = 1.0, .half_width = 0.42, .half_height = 0.05, .per_metre = 1200}},
        {.radius = 0.03});
    terrain::ErosionRun run;
    run.mesh = before;
    terrain::run_erosion(run, fluid, {.steps = steps}, {.influence = influence}, {});
    const terrain::ErosionOutput view = {.width = 220, .azimuth = 75, .elevation = 25};
    return {apps::picture_of_ground(before, -0.2F, view),
            apps::picture_of_ground(run.mesh, -0.2F, view)};
}

TEST(WornGolden, CanyonIsUndercut) {
    EXPECT_TRUE(matches(washed({.shape = terrain::GroundShape::Canyon,
                                .length = 1.2,
                                .width = 1.6,
                                .edge = 0.05,
                                .fall = 0.0,
                                .bed_width = 0.5,
                                .bed_depth = 0.5},
                               80, 1.0),
                        "worn_canyon.png"));
}

TEST(WornGolden, BendRetreatsAndAFloodRoundsIt) {
    const terrain::GroundOptions ground = {.shape = terrain::GroundShape::Bend,
                                           .length = 3.0,
                                           .width = 2.4,
                                           .edge = 0.07,
                                           .fall = 0.1,
                                           .bed_width = 0.5,
                                           .bed_depth = 0.4,
                                           .bank_width = 0.1,
                                           .swing = 0.45};
    std::vector<Photo> pictures = washed(ground, 60, 1.0);
    pictures.push_back(washed(ground, 60, 3.0)[1]);
    EXPECT_TRUE(matches(pictures, "worn_bend.png"));
}

}  // namespace
}  // namespace scree
