#include "meshing/bake/ambient_occlusion.h"
#include "meshing/bake/height_bake.h"
#include "meshing/bake/mesh_height_bake.h"
#include "meshing/bake/normal_map.h"
#include "meshing/gltf/gltf_write.h"
#include "tests/support/placed_rocks.h"
#include "tests/support/sample_scenes.h"

#include <benchmark/benchmark.h>
#include <glm/gtc/matrix_transform.hpp>

namespace {

using namespace scree;

// A picture `width` pixels wide, 4:3, about as full of rocks as gravel is.
vision::RockSet gravel(int width) {
    const int height = width * 3 / 4;
    return test::scattered_rocks(width, height, 900, width / 120.0, width / 30.0, 1);
}

int width_of(const benchmark::State& state) {
    return static_cast<int>(state.range(0));
}

void count_pixels(benchmark::State& state) {
    state.SetItemsProcessed(state.iterations() * state.range(0) * (state.range(0) * 3 / 4));
}

void displacement(benchmark::State& state) {
    const auto rocks = gravel(width_of(state));
    for (auto _ : state)
        benchmark::DoNotOptimize(meshing::bake_displacement(rocks));
    count_pixels(state);
}

void mesh_displacement(benchmark::State& state) {
    const auto rocks = gravel(width_of(state));
    std::vector<meshing::TriMesh> meshes;
    for (const auto& rock : rocks.rocks)
        meshes.push_back(test::rock_surface(rock, rocks, 16, 32));
    std::vector<meshing::PlacedMesh> placed;
    for (std::size_t i = 0; i < meshes.size(); ++i)
        placed.push_back(
            {&meshes[i], glm::translate(glm::dmat4(1.0), test::rock_place(rocks.rocks[i], rocks))});
    for (auto _ : state)
        benchmark::DoNotOptimize(meshing::bake_mesh_heights(
            placed, {rocks.width, rocks.height, rocks.metres_per_pixel}));
    count_pixels(state);
}

void normals(benchmark::State& state) {
    const auto heights = meshing::bake_displacement(gravel(width_of(state)));
    for (auto _ : state)
        benchmark::DoNotOptimize(meshing::normal_map(heights));
    count_pixels(state);
}

void occlusion(benchmark::State& state) {
    const auto heights = meshing::bake_displacement(gravel(width_of(state)));
    for (auto _ : state)
        benchmark::DoNotOptimize(meshing::ambient_occlusion(heights));
    count_pixels(state);
}

// 900 rocks of 16 rings and 32 segments; the argument is whether they are quantised.
void rocks_glb(benchmark::State& state) {
    const auto set = gravel(900);
    meshing::GltfScene scene;
    for (const auto& rock : set.rocks) {
        meshing::GltfNode node;
        node.mesh = static_cast<int>(scene.meshes.size());
        node.transform.translation = test::rock_place(rock, set);
        scene.meshes.push_back({"rock", test::rock_surface(rock, set, 16, 32)});
        scene.nodes.push_back(node);
    }
    scene.texture = test::sample_texture();
    std::size_t n_bytes = 0;
    for (auto _ : state)
        n_bytes = meshing::encode_glb(scene, {.quantise = state.range(0) != 0}).size();
    state.counters["bytes"] = static_cast<double>(n_bytes);
}

// 20 rocks of 2,562 vertices, 2,000 stones, with a texture.
void patch_glb(benchmark::State& state) {
    const meshing::GltfScene scene = test::patch_scene(20, 2000);
    std::size_t n_bytes = 0;
    for (auto _ : state)
        n_bytes = meshing::encode_glb(scene, {.quantise = state.range(0) != 0}).size();
    state.counters["bytes"] = static_cast<double>(n_bytes);
}

void sizes(benchmark::internal::Benchmark* b) {
    b->Arg(900)->Arg(2000)->Arg(4000)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(displacement)->Apply(sizes);
BENCHMARK(mesh_displacement)->Apply(sizes);
BENCHMARK(normals)->Apply(sizes);
BENCHMARK(occlusion)->Apply(sizes);
BENCHMARK(rocks_glb)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(patch_glb)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
