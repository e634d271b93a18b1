#pragma once

#include "base/options.h"
#include "meshing/curvature/curvature_scale.h"
#include "meshing/curvature/mean_curvature.h"
#include "meshing/mesh/adjacency.h"
#include "meshing/mesh/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace scree::terrain {

/// Water wears the surface where it touches it.
struct WetErosionOptions {
    double influence = 1.0;    ///< Reach of a particle, in mean edges; 3 rounds the banks.
    double power = 1.0;        ///< Of the scaled curvature: higher spares what is flat.
    double step_limit = 10.0;  ///< A step moves a vertex by at most a mean edge over this.
    meshing::UnsignedScale range = meshing::UnsignedScale::Automatic;  ///< Curvature to speed.
    Reading concave = Reading::Sound;  ///< Literal: hollows may fill up, as the source has it.
    meshing::RimPolicy rim = meshing::RimPolicy::Pinned;
    meshing::CurvatureMethod curvature = meshing::CurvatureMethod::Tensor;
};

template <class Visitor>
void describe(WetErosionOptions& o, Visitor&& field) {
    field("influence", o.influence,
          {.min = 0.01, .max = 100, .help = "reach of a particle, in mean edges"});
    field("power", o.power, {.min = 1, .max = 100, .help = "of the scaled curvature"});
    field("step-limit", o.step_limit,
          {.min = 1, .max = 1e6, .help = "a step moves at most a mean edge over this"});
    field("range", o.range, {.help = "how curvature becomes speed"});
    field("concave", o.concave, {.help = "literal: hollows may fill up"});
    field("rim", o.rim, {.help = "what the rim of an open mesh does"});
    field("curvature", o.curvature, {.help = "how curvature is estimated"});
}

/// What one step did; the times are the columns of the source's tables.
struct WetErosionReport {
    std::size_t n_affected = 0;  ///< Vertices within reach of a colliding particle.
    std::size_t n_moved = 0;     ///< Of them, those that changed their place.
    double mean_edge = 0.0;      ///< Metres.
    double least_curvature = 0.0;
    double greatest_curvature = 0.0;
    double greatest_move = 0.0;  ///< Metres; at most mean_edge / step_limit.
    double affected_seconds = 0.0;
    double curvature_seconds = 0.0;
    double laplacian_seconds = 0.0;
    double displacement_seconds = 0.0;
};

/// Memory that steps use between calls, and their results a vertex.
struct WetErosionScratch {
    std::vector<float> factors;      ///< Distance factor, 0 for dry vertices.
    std::vector<std::uint32_t> wet;  ///< The others, increasing.
    std::vector<glm::vec3> normals;
    std::vector<float> curvature;       ///< Mean curvature, one over metres.
    std::vector<glm::vec3> directions;  ///< Unit umbrella vectors of the wet vertices.
    std::vector<float> speeds;          ///< Curvature as 0 to 1.
    meshing::CurvatureScratch estimator;
};

/// Distance factor of every vertex: 1 at a particle, 0 from `reach` on (`mesh-erosion.md` 7.2).
/// Only the nearest particle counts.
/// @pre  reach > 0, places finite.
void distance_factors(std::span<const glm::vec3> vertices, std::span<const glm::vec3> particles,
                      double reach, std::vector<float>& factors);

/// One step of hydraulic erosion (`mesh-erosion.md` 7): wet vertices move inwards, the more the
/// more they stick out and the nearer the water is. Dry vertices keep their bits.
///
/// Runs in parallel, the same bytes for any number of threads.
/// @param colliding  Places of the particles that touch the mesh.
/// @pre   The adjacency is the mesh's own.
/// @post  No vertex moved by more than its factor times mean_edge / step_limit.
/// @throw InvalidOption  a value is outside the range that describe() gives.
WetErosionReport erode_wet(meshing::TriMesh& mesh, const meshing::Adjacency& adjacency,
                           std::span<const glm::vec3> colliding, const WetErosionOptions& options,
                           WetErosionScratch& scratch);

}  // namespace scree::terrain
