#include "meshing/rocks/rock_mesh.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/mesh/bounds.h"
#include "meshing/rocks/ring_grid.h"
#include "meshing/rocks/size_lod.h"
#include "meshing/rocks/world_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

namespace scree::meshing {
namespace {

using vision::kRadii;
using vision::Rock;
using vision::RockSet;

constexpr std::size_t kMostVertices = 100'000'000;
constexpr float kThinnest = 1e-3F;  // least radius or depth over the greatest radius
constexpr float kGreatestRadius = 1e6F;
constexpr double kPi = std::numbers::pi;

// What every rock of a batch shares.
struct Frame {
    glm::dmat4 world_from_image{1.0};
    glm::dvec3 scale{1.0};  // metres a pixel along each axis
    glm::dvec2 image{1.0};  // size, px
    RockMeshOptions options;
};

float greatest_radius(const Rock& rock) {
    return *std::max_element(rock.outline.radii.begin(), rock.outline.radii.end());
}

void check_rock(const Rock& rock, std::size_t index) {
    const auto in_range = [](float r) { return r > 0.0F && r <= kGreatestRadius; };
    const glm::dvec2 centre = rock.outline.centre;
    if (!(std::abs(centre.x) <= kGreatestRadius && std::abs(centre.y) <= kGreatestRadius))
        fail<InvalidInput>("rock ", index, " has its centre at (", centre.x, ", ", centre.y,
                           ") px, must be within ", kGreatestRadius);
    if (!in_range(rock.depth))
        fail<InvalidInput>("rock ", index, " has a depth of ", rock.depth,
                           " px, must be positive and at most ", kGreatestRadius);
    for (std::size_t k = 0; k < kRadii; ++k)
        if (!in_range(rock.outline.radii[k]))
            fail<InvalidInput>("rock ", index, " has a radius of ", rock.outline.radii[k],
                               " px at ", k, " degrees, must be positive and at most ",
                               kGreatestRadius);
}

RingGrid grid_of(const RockMeshOptions& options, double share) {
    const bool literal = options.reading == Reading::Literal;
    const int least =
        literal ? kFewestSegments : std::min(options.min_segments, options.max_segments);
    RingGrid grid;
    grid.segments = segments_for_size(options.max_segments, options.size_lod ? share : 1.0, least);
    grid.rings = options.rings > 0 ? options.rings : rings_for_segments(grid.segments);
    grid.layout = literal        ? RingLayout::Sheared
                  : options.seam ? RingLayout::Seamed
                                 : RingLayout::Shared;
    return grid;
}

std::vector<RingGrid> plan_grids(const RockSet& set, const RockMeshOptions& options) {
    float greatest = 0.0F;  // (3.14): over all rocks, then over their radii
    for (std::size_t i = 0; i < set.rocks.size(); ++i) {
        check_rock(set.rocks[i], i);
        greatest = std::max(greatest, greatest_radius(set.rocks[i]));
    }
    std::vector<RingGrid> grids;
    grids.reserve(set.rocks.size());
    std::size_t vertices = 0;
    for (const Rock& rock : set.rocks) {
        grids.push_back(grid_of(options, static_cast<double>(greatest_radius(rock)) / greatest));
        vertices += vertex_count(grids.back());
        if (vertices > kMostVertices)
            fail<InvalidInput>("the meshes of ", set.rocks.size(), " rocks have more than ",
                               kMostVertices, " vertices; lower max-segments or rings");
    }
    return grids;
}

// The rock's radii and depth, raised where they are too thin to mesh.
struct Shape {
    std::array<float, kRadii> radii;
    double depth;
};

Shape shape_of(const Rock& rock) {
    const float least = kThinnest * greatest_radius(rock);
    Shape shape{};
    std::transform(rock.outline.radii.begin(), rock.outline.radii.end(), shape.radii.begin(),
                   [&](float r) { return std::max(r, least); });
    shape.depth = std::max(rock.depth, least);
    return shape;
}

// One ring of a rock, in pixels about its centre.
struct Ring {
    double height;  // y
    double shrink;  // cos of the elevation, exactly 0 at the poles so that they weld
};

Ring ring_at(int ring, int rings, double depth) {
    if (ring == 0)
        return {-depth, 0.0};
    if (ring == rings)
        return {depth, 0.0};
    const double elevation = -0.5 * kPi + kPi * ring / rings;
    return {depth * std::sin(elevation), std::cos(elevation)};
}

// One vertex, in pixels about the rock's centre.
struct SurfacePoint {
    glm::dvec3 position;
    double radius;  // of the outline at its azimuth
    double slope;   // derivative of the radius
    bool pole;
};

// Unnormalised; the corrected form of (3.12), see A.16, or as printed for the literal reading.
glm::dvec3 normal_at(const SurfacePoint& point, double depth, const RockMeshOptions& options) {
    const glm::dvec3& p = point.position;
    const double bend = point.slope / point.radius;
    if (options.normals == NormalForm::Approximate)
        return p;
    if (options.reading == Reading::Literal)
        return {-depth * (p.x - bend * p.z), -bend * p.y, -depth * (p.z + bend * p.x)};
    if (point.pole)
        return p;
    return {depth * (p.x + bend * p.z), point.radius * point.radius / depth * p.y,
            depth * (p.z - bend * p.x)};
}

// Normals transform by the inverse transpose of a diagonal matrix.
glm::vec3 world_normal(const glm::dvec3& normal, const glm::dvec3& scale) {
    const glm::dvec3 turned = normal / scale;
    const double length = glm::length(turned);
    return length > 0.0 ? glm::vec3(turned / length) : glm::vec3(0.0F, 1.0F, 0.0F);
}

void fill_vertices(const Rock& rock, const Shape& shape, const RingGrid& grid, const Frame& frame,
                   TriMesh& mesh) {
    const RadiusSampling sampling =
        frame.options.reading == Reading::Literal ? RadiusSampling::Point : frame.options.sampling;
    const RadiusProfile profile = sample_radii(shape.radii, grid.segments, sampling);
    const auto n_segments = static_cast<std::size_t>(grid.segments);
    std::vector<glm::dvec2> border(n_segments);
    for (std::size_t s = 0; s < n_segments; ++s) {
        const double azimuth = 2.0 * kPi * static_cast<double>(s) / grid.segments;
        border[s] = profile.radius[s] * glm::dvec2(std::cos(azimuth), std::sin(azimuth));
    }
    for (int k = 0; k <= grid.rings; ++k) {
        const Ring ring = ring_at(k, grid.rings, shape.depth);
        const auto columns = static_cast<std::size_t>(columns_of(grid, k));
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t s = column % n_segments;
            const glm::dvec2 flat = ring.shrink * border[s];  // (3.5)
            const SurfacePoint point{{flat.x, ring.height, flat.y},
                                     profile.radius[s],
                                     profile.slope[s],
                                     ring.shrink == 0.0};
            mesh.positions.emplace_back(point.position * frame.scale);
            mesh.normals.push_back(
                world_normal(normal_at(point, shape.depth, frame.options), frame.scale));
            if (frame.options.texcoords)  // (3.11); glTF's v grows downwards as rows do
                mesh.texcoords.emplace_back(glm::clamp((flat + rock.outline.centre) / frame.image,
                                                       glm::dvec2(0.0), glm::dvec2(1.0)));
        }
    }
}

void restore_volume(const Shape& shape, const Frame& frame, TriMesh& mesh) {
    const double per_pixel = frame.scale.x * frame.scale.y * frame.scale.z;
    const double exact = ellipsoid_volume(shape.radii, shape.depth) * per_pixel;
    const auto factor = static_cast<float>(std::cbrt(exact / signed_volume(mesh)));
    for (glm::vec3& p : mesh.positions)
        p *= factor;
}

RockMesh build(const Rock& rock, std::size_t index, const RingGrid& grid, const Frame& frame) {
    RockMesh result;
    result.segments = grid.segments;
    result.rings = grid.rings;
    result.source = index;
    TriMesh& mesh = result.mesh;
    mesh.positions.reserve(vertex_count(grid));
    mesh.normals.reserve(vertex_count(grid));
    mesh.texcoords.reserve(frame.options.texcoords ? vertex_count(grid) : 0);
    mesh.triangles = ring_triangles(grid);
    const Shape shape = shape_of(rock);
    fill_vertices(rock, shape, grid, frame, mesh);
    if (frame.options.compensate_volume)
        restore_volume(shape, frame, mesh);
    const Box box = bounding_box(mesh);
    result.box_min = box.min;
    result.box_max = box.max;
    result.bounding_radius = outer_radius(mesh);
    result.inscribed_radius = inner_radius(mesh);
    const double lift = frame.options.base == RockBase::Resting ? shape.depth : 0.0;
    result.position = glm::vec3(to_world(frame.world_from_image, static_cast<int>(frame.image.x),
                                         static_cast<int>(frame.image.y),
                                         {rock.outline.centre.x, lift, rock.outline.centre.y}));
    return result;
}

Frame frame_of(const RockSet& set, const RockMeshOptions& options) {
    GroundRegion region = region_of(set);
    const double aspect = region.depth / region.width;
    if (options.region_width > 0.0)
        region.width = options.region_width;
    else if (options.region_depth > 0.0)
        region.width = options.region_depth / aspect;
    if (options.region_depth > 0.0)
        region.depth = options.region_depth;
    else
        region.depth = region.width * aspect;
    Frame frame;
    frame.world_from_image = world_from_image(set.width, set.height, region);
    frame.scale = {frame.world_from_image[0][0], frame.world_from_image[1][1],
                   frame.world_from_image[2][2]};
    frame.image = {set.width, set.height};
    frame.options = options;
    return frame;
}

}  // namespace

std::vector<RockMesh> build_rock_meshes(const RockSet& set, const RockMeshOptions& options) {
    check(options);
    if (options.rings == 1)
        fail<InvalidOption>("rings is 1, must be 0 or at least 2");
    const Frame frame = frame_of(set, options);
    const std::vector<RingGrid> grids = plan_grids(set, options);
    std::vector<RockMesh> meshes(set.rocks.size());
    parallel_for_each_index(0, meshes.size(), 16, [&](std::size_t i) {
        meshes[i] = build(set.rocks[i], i, grids[i], frame);
    });
    return meshes;
}

}  // namespace scree::meshing
