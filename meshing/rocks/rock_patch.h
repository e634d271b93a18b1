#pragma once

#include "base/options.h"
#include "meshing/rocks/rock_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/ext/quaternion_float.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree::meshing {

/// One placed copy of a mesh: world = translation + rotation * (scale * local).
struct PatchInstance {
    std::uint32_t prototype = 0;                 ///< Index into RockPatch::prototypes.
    glm::vec3 translation{0.0F};                 ///< Metres.
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};  ///< A unit quaternion.
    glm::vec3 scale{1.0F};
};

/// What the making of a patch achieved. Coverage is the share of ground under silhouettes.
struct PatchReport {
    std::size_t left_out = 0;        ///< Stones that found no room; 0 if the size was free.
    double coverage_by_darts = 0.0;  ///< After dart throwing, on as much ground as that needs.
    double coverage = 0.0;           ///< After gaps were closed.
};

/// Ground covered with copies of a few meshes, centred on the origin. If made by rearrange_rocks()
/// or scatter_rocks(), it tiles: copies of it side by side meet without overlap.
struct RockPatch {
    std::vector<std::size_t> prototypes;   ///< Indices into the meshes it was made from.
    std::vector<PatchInstance> instances;  ///< Ordered by prototype.
    glm::dvec2 size{0.0};                  ///< Along x and z, metres.
    PatchReport report;
};

struct PatchOptions {
    double width = 0.0;     ///< Along x, m; 0 takes the depth.
    double depth = 0.0;     ///< Along z, m; 0 takes the width, both 0 what the stones need.
    int tries = 100;        ///< Places tried for a stone each time.
    int sweeps = 8;         ///< Rounds of moving stones into voids.
    double step = 0.5;      ///< Share of a void that a stone moves into in a sweep.
    bool turn = true;       ///< Turn each stone about the vertical at random.
    int prototypes = 20;    ///< Meshes that scatter_rocks() picks from the rock set.
    std::int64_t seed = 1;  ///< Other seeds give other patches.
};

template <class Visitor>
void describe(PatchOptions& o, Visitor&& field) {
    field("width", o.width, {.min = 0, .max = 1e6, .unit = "m", .help = "0 follows the depth"});
    field("depth", o.depth,
          {.min = 0, .max = 1e6, .unit = "m", .help = "0 follows the width, both 0 the stones"});
    field("tries", o.tries, {.min = 1, .max = 10000, .help = "places tried for a stone"});
    field("sweeps", o.sweeps, {.min = 0, .max = 1000, .help = "rounds that close gaps"});
    field("step", o.step, {.min = 0.01, .max = 1, .help = "share of a void moved into a sweep"});
    field("turn", o.turn, {.help = "turn each stone at random"});
    field("prototypes", o.prototypes, {.min = 1, .max = 65535, .help = "different meshes"});
    field("seed", o.seed, {.min = 0, .max = 9e15, .help = "other seeds give other patches"});
}

/// The source's ground: columns x rows identical patches, every rock where the photograph has it
/// (`rocks-and-deformer.md` A.18).
/// @param patch_size  Ground that the meshes came from, metres.
/// @throw InvalidOption  a size or count is not positive, or over 10 million instances.
RockPatch repeat_rocks(const std::vector<RockMesh>& rocks, glm::dvec2 patch_size, int columns,
                       int rows);

/// The rearrangement that the source proposes: every rock `copies` times on a torus, the largest
/// first, by Poisson-disk dart throwing with each rock's greatest radius; then gaps are closed by
/// moving stones into voids, and what found no room is tried again by silhouette.
/// @throw InvalidOption  a value is outside its range, or copies under 1.
/// @throw InvalidInput   more than a million stones, a rock without silhouette, or a given size
///                       under four radii of the largest rock.
RockPatch rearrange_rocks(const std::vector<RockMesh>& rocks, int copies = 1,
                          const PatchOptions& options = {});

/// `count` stones with the sizes of the rock set, made of a few prototypes, placed the same way.
/// @throw InvalidOption  a value is outside its range, or count not in [1, 1e6].
/// @throw InvalidInput   as rearrange_rocks(), or no rocks.
RockPatch scatter_rocks(const std::vector<RockMesh>& rocks, int count,
                        const PatchOptions& options = {});

}  // namespace scree::meshing
