#pragma once

#include "base/options.h"
#include "meshing/mesh/tri_mesh.h"
#include "meshing/rocks/radius_profile.h"
#include "vision/rock_data.h"

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace scree::meshing {

/// Normals of a rock mesh (`rocks-and-deformer.md` A.16).
enum class NormalForm {
    Exact,        ///< Of the surface; as printed, with its three errors, when read literally.
    Approximate,  ///< The direction from the rock's centre.
};

/// Where the resting plane y = 0 cuts a rock.
enum class RockBase {
    Half,     ///< Through the equator: tops at the depth.
    Resting,  ///< Under the rock: it lies on the ground.
};

inline constexpr std::string_view kNormalFormNames[] = {"exact", "approximate"};
inline constexpr std::string_view kRockBaseNames[] = {"half", "resting"};
inline constexpr std::string_view kRadiusSamplingNames[] = {"point", "averaged"};

constexpr std::span<const std::string_view> names_of(NormalForm) {
    return kNormalFormNames;
}
constexpr std::span<const std::string_view> names_of(RockBase) {
    return kRockBaseNames;
}
constexpr std::span<const std::string_view> names_of(RadiusSampling) {
    return kRadiusSamplingNames;
}

struct RockMeshOptions {
    int max_segments = 30;  ///< Of the largest rock.
    int min_segments = 8;   ///< Of a vanishing rock; the source keeps 3, at 0.3 of the volume.
    int rings = 0;          ///< 0 links them to the segments: half of them, and one.
    bool size_lod = true;   ///< Fewer segments for smaller rocks; otherwise all get max_segments.
    bool seam = false;      ///< Repeat the first column for coordinates that wrap round.
    bool texcoords = true;  ///< Write texture coordinates into the photograph.
    bool compensate_volume = false;  ///< Scale each mesh to the volume of its exact surface.
    NormalForm normals = NormalForm::Exact;
    RadiusSampling sampling = RadiusSampling::Point;
    RockBase base = RockBase::Half;
    Reading reading = Reading::Sound;  ///< Literal: sheared indices, point sampling, printed
                                       ///< normals, 3 segments at least.
    double region_width = 0.0;  ///< Ground that the photograph covers, m; 0 follows the scale.
    double region_depth = 0.0;  ///< The same along z.
};

template <class Visitor>
void describe(RockMeshOptions& o, Visitor&& field) {
    field("max-segments", o.max_segments,
          {.min = 3, .max = 720, .help = "segments of the largest rock"});
    field("min-segments", o.min_segments,
          {.min = 3, .max = 720, .help = "segments of the smallest rocks"});
    field("rings", o.rings, {.min = 0, .max = 720, .help = "rings a rock; 0 follows the segments"});
    field("size-lod", o.size_lod, {.help = "fewer segments for smaller rocks"});
    field("seam", o.seam, {.help = "repeat the first column of vertices"});
    field("texcoords", o.texcoords, {.help = "texture coordinates into the photograph"});
    field("compensate-volume", o.compensate_volume, {.help = "keep the exact volume"});
    field("normals", o.normals, {.help = "normals of the surface or from the centre"});
    field("sampling", o.sampling, {.help = "how a segment reads the outline's radii"});
    field("base", o.base, {.help = "resting plane through the rock or under it"});
    field("reading", o.reading, {.help = "sound or literal form of the published method"});
    field("region-width", o.region_width,
          {.min = 0, .max = 1e9, .unit = "m", .help = "ground along x; 0 follows the scale"});
    field("region-depth", o.region_depth,
          {.min = 0, .max = 1e9, .unit = "m", .help = "ground along z; 0 follows the scale"});
}

/// A rock of a photograph as a closed mesh about its own centre.
struct RockMesh {
    TriMesh mesh;              ///< Relative to `position`; axes as in the world.
    glm::vec3 position{0.0F};  ///< Of the centre in the world, metres.
    glm::vec3 box_min{0.0F};   ///< Bounding box, relative to `position`.
    glm::vec3 box_max{0.0F};
    float bounding_radius = 0.0F;   ///< Of the sphere about the centre that holds the mesh.
    float inscribed_radius = 0.0F;  ///< Of the largest sphere about the centre inside the mesh.
    int segments = 0;
    int rings = 0;
    std::size_t source = 0;  ///< Index into the rock set.
};

/// Meshes of all rocks, in their order (A.13 to A.17).
///
/// Picture columns run along x, rows along z; the picture's centre is the world's origin. A radius
/// or depth under a thousandth of the rock's greatest radius is raised to it, so that no face
/// degenerates.
///
/// @post  With Reading::Sound every mesh is closed, two-sided, of genus 0 and positive volume.
/// @throw InvalidOption  a value is outside the range that describe() gives.
/// @throw InvalidInput   a picture without size, a centre, radius or depth that is no number in
///                       range, or more than 100 million vertices in all.
std::vector<RockMesh> build_rock_meshes(const vision::RockSet& set,
                                        const RockMeshOptions& options = {});

}  // namespace scree::meshing
