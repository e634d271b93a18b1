// One scene at 1, 3, 5 and 8 iterations a frame, beside each other: how far soil has come after the
// same time. Makes docs/images/iterations.jpg.
//
//   build/release/apps/examples/iterations testdata/scenes/iterations.json
//   docs/images/iterations.jpg

#include "base/whole_file.h"
#include "meshing/render/raster_view.h"
#include "terrain/scene/scene_file.h"
#include "terrain/scene/scene_painter.h"
#include "vision/image_io.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>

namespace {

using scree::Photo;

constexpr int kGap = 4;          // px
constexpr float kMoved = 1e-5F;  // metres of displacement that count

// The last frame; says what the ground has done until then.
Photo last_frame(scree::terrain::Scene scene, int iterations) {
    scene.deformer.iterations = iterations;
    scree::terrain::Simulation simulation(scene, scree::terrain::Device::Cpu);
    for (int frame = 0; frame < scene.frames; ++frame)
        simulation.step();
    const auto moved = simulation.ground().displacement(simulation.extent());
    const auto cells =
        std::count_if(moved.begin(), moved.end(), [](float u) { return std::fabs(u) > kMoved; });
    const auto material = simulation.material_reports().front();
    std::cout << iterations << " iterations: " << cells << " cells moved, "
              << simulation.volume().moved_m3 << " m3, down to " << material.deepest_m
              << " m, up to " << material.highest_m << " m, steepest "
              << material.greatest_slope_deg << " deg\n";
    return scree::terrain::make_painter(scene, simulation)->draw(simulation);
}

Photo strip(const scree::terrain::Scene& scene) {
    Photo all;
    for (const int iterations : {1, 3, 5, 8}) {
        const Photo one = last_frame(scene, iterations);
        all = all.empty() ? one : scree::meshing::side_by_side(all, one, kGap);
    }
    return all;
}

}  // namespace

int main(int n_words, char** words) {
    if (n_words != 3) {
        std::cerr << "usage: iterations SCENE.json OUT.jpg\n";
        return 2;
    }
    try {
        const Photo all = strip(scree::terrain::read_scene(words[1]));
        scree::write_whole_file(words[2], scree::vision::encode_jpeg(all, 85));
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "iterations: " << error.what() << '\n';
        return 1;
    }
}
