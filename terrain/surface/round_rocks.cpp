#include "terrain/surface/round_rocks.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/mesh/bounds.h"
#include "terrain/surface/weathering.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

constexpr double kStepShare = 0.01;  // of the mean radius

double mean_radius(const meshing::TriMesh& mesh) {
    double sum = 0.0;
    for (const glm::vec3& p : mesh.positions)
        sum += glm::length(glm::dvec3(p));
    return sum / static_cast<double>(mesh.positions.size());
}

WeatheringOptions options_for(const meshing::TriMesh& mesh, int steps) {
    const double edge = meshing::mean_edge_length(mesh, meshing::build_adjacency(mesh));
    WeatheringOptions options;
    options.steps = steps;
    options.step_limit = std::clamp(edge / (kStepShare * mean_radius(mesh)), 10.0, 1e6);
    options.scale = meshing::CurvatureScale::Always;
    return options;
}

void round_one(meshing::RockMesh& rock, int steps) {
    meshing::TriMesh& mesh = rock.mesh;
    if (mesh.triangles.empty())
        return;
    const meshing::TriMesh before = mesh;
    const double volume = meshing::signed_volume(mesh);
    weather(mesh, options_for(mesh, steps));
    const double left = meshing::signed_volume(mesh);
    if (!(volume > 0.0 && left > 0.0)) {  // no body to keep the volume of
        mesh = before;
        return;
    }
    const auto scale = static_cast<float>(std::cbrt(volume / left));
    for (glm::vec3& p : mesh.positions)
        p *= scale;
    const meshing::Box box = meshing::bounding_box(mesh);
    rock.box_min = box.min;
    rock.box_max = box.max;
    rock.bounding_radius = meshing::outer_radius(mesh);
    rock.inscribed_radius = meshing::inner_radius(mesh);
}

}  // namespace

void round_rocks(std::vector<meshing::RockMesh>& rocks, int steps, const Progress* progress) {
    if (steps < 0)
        fail<InvalidOption>("steps is ", steps, ", must be 0 or more");
    if (steps == 0)
        return;
    parallel_for_each_index(0, rocks.size(), 1, [&](std::size_t i) {
        stop_if_cancelled(progress, "rounding rocks");
        round_one(rocks[i], steps);
    });
}

}  // namespace scree::terrain
