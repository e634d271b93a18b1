#pragma once

#include "base/options.h"
#include "meshing/curvature/curvature_scale.h"
#include "meshing/curvature/mean_curvature.h"
#include "meshing/mesh/adjacency.h"
#include "meshing/mesh/tri_mesh.h"

#include <cstddef>
#include <vector>

namespace scree::terrain {

/// Which way a vertex moves (`mesh-erosion.md` 3).
enum class WearDirection {
    Umbrella,  ///< Towards the mean of its neighbours: keeps triangles even.
    Normal,    ///< Against its normal: for comparison.
};

inline constexpr std::string_view kWearDirectionNames[] = {"umbrella", "normal"};

constexpr std::span<const std::string_view> names_of(WearDirection) {
    return kWearDirectionNames;
}

/// What one step of weathering does.
struct StepRules {
    double power = 1.0;                ///< n: higher wears protrusions alone.
    double step_limit = 10.0;          ///< x: no vertex moves further than the mean edge over x.
    Reading reading = Reading::Sound;  ///< Literal multiplies by the umbrella vector itself.
    WearDirection direction = WearDirection::Umbrella;
    meshing::CurvatureMethod curvature = meshing::CurvatureMethod::Tensor;
    meshing::CurvatureScale scale = meshing::CurvatureScale::DownscaleOnly;
    double quantile = 0.99;      ///< For CurvatureScale::Percentile.
    float frozen_factor = 0.0F;  ///< Factor to use in place of the measured one; 0 measures.
    meshing::RimPolicy rim = meshing::RimPolicy::Pinned;
};

/// What one step saw and did.
struct StepReport {
    double mean_edge = 0.0;         ///< Metres.
    meshing::CurvatureRange range;  ///< Of the mean curvature inside the rims, 1/m.
    float factor = 1.0F;            ///< Curvature was scaled by it.
    std::size_t n_moved = 0;        ///< Vertices.
    double farthest = 0.0;          ///< Longest way that a vertex went, metres.
};

/// Memory between steps: 60 bytes a vertex.
struct StepScratch {
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> umbrella;
    std::vector<float> corner_shares;  ///< Of the area around a vertex, in the adjacency's order.
    std::vector<float> curvature;      ///< Of the vertices, as the step saw it, 1/m.
    meshing::CurvatureScratch of_faces;
};

/// One step of weathering (`mesh-erosion.md` 4.2, steps 1 to 5): every vertex of positive scaled
/// curvature h moves by h^n e_avg / x along the unit umbrella vector, all at once.
///
/// Normals are not kept up to date in the mesh. Runs in parallel, the same bytes for any number of
/// threads.
/// @pre   The adjacency is the mesh's own; power >= 1, step_limit > 0.
/// @post  No vertex has moved further than e_avg / x (Reading::Sound), none with h <= 0 at all.
/// @throw InvalidInput  the adjacency is another mesh's.
StepReport weathering_step(meshing::TriMesh& mesh, const meshing::Adjacency& adjacency,
                           const StepRules& rules, StepScratch& scratch);

}  // namespace scree::terrain
