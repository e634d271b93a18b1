#include "meshing/render/raster_view.h"
#include "meshing/rocks/rock_mesh.h"
#include "meshing/rocks/world_frame.h"
#include "testdata/synthetic_photo.h"
#include "vision/data/overlay.h"

#include <algorithm>

#include <benchmark/benchmark.h>
#include <glm/ext/matrix_transform.hpp>

namespace {

// The pictures of a run on a photograph 900 pixels wide with several hundred rocks.
struct Subject {
    scree::Photo photo;
    scree::vision::RockSet set;

    Subject() {
        auto made = scree::test::make_synthetic_photo(
            {.n_rocks = 600, .median_diameter = 24, .greatest_diameter = 70});
        photo = std::move(made.photo);
        set = {.image = "made.png",
               .width = photo.width(),
               .height = photo.height(),
               .metres_per_pixel = 0.001,
               .method = "truth",
               .rocks = {}};
        for (const auto& outline : made.outlines) {
            const float depth = *std::min_element(outline.radii.begin(), outline.radii.end());
            set.rocks.push_back({outline, depth, 0.0F});
        }
    }
};

const Subject& subject() {
    static const Subject one;
    return one;
}

void preview(benchmark::State& state) {
    const auto meshes = scree::meshing::build_rock_meshes(subject().set);
    const auto region = scree::meshing::region_of(subject().set);
    scree::meshing::ViewScene scene;
    scene.photo = &subject().photo;
    scene.ground_size = {region.width, region.depth};
    for (const auto& rock : meshes)
        scene.objects.push_back({&rock.mesh, glm::translate(glm::mat4(1.0F), rock.position)});
    for (auto _ : state)
        benchmark::DoNotOptimize(scree::meshing::draw_view(scene));
    state.counters["rocks"] = static_cast<double>(meshes.size());
}
BENCHMARK(preview)->Unit(benchmark::kMillisecond)->UseRealTime();

void overlay(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(scree::vision::draw_overlay(subject().photo, subject().set));
    state.counters["rocks"] = static_cast<double>(subject().set.rocks.size());
}
BENCHMARK(overlay)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
