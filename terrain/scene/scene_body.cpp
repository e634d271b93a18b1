#include "terrain/scene/scene_body.h"

#include "base/error.h"
#include "meshing/gltf/gltf_read.h"
#include "meshing/mesh/bounds.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace scree::terrain {
namespace {

constexpr double kStill = 1e-9;  // metres in a step

// All placements of a file, joined.
meshing::TriMesh mesh_of(const MeshFile& source) {
    const meshing::LoadedGltf file =
        meshing::read_glb(source.file, {.max_vertices = 5'000'000, .max_triangles = 10'000'000});
    meshing::TriMesh all;
    for (const meshing::GltfPlacement& placement : file.placements) {
        const meshing::TriMesh& part = file.meshes[placement.mesh].geometry;
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (const glm::vec3& p : part.positions)
            all.positions.emplace_back(placement.world_from_mesh * glm::dvec4(glm::dvec3(p), 1.0));
        for (const glm::uvec3& t : part.triangles)
            all.triangles.push_back(t + first);
        if (all.positions.size() > 20'000'000)
            fail<InvalidInput>(source.file.string(), " shows more than 20 million vertices");
    }
    if (all.triangles.empty())
        fail<InvalidInput>(source.file.string(), " shows no mesh");
    meshing::check_mesh(all);
    return all;
}

}  // namespace

meshing::TriMesh object_mesh(const ObjectShape& shape) {
    return std::visit(
        [](const auto& one) {
            using Shape = std::remove_cvref_t<decltype(one)>;
            if constexpr (std::is_same_v<Shape, SphereShape>)
                return sphere_mesh(one);
            else if constexpr (std::is_same_v<Shape, BoxShape>)
                return box_mesh(one);
            else if constexpr (std::is_same_v<Shape, TyreShape>)
                return tyre_mesh(one);
            else if constexpr (std::is_same_v<Shape, BootShape>)
                return boot_mesh(one);
            else
                return mesh_of(one);
        },
        shape);
}

SceneBody::SceneBody(const SceneObject& object, const CellGrid& grid)
    : object_(&object), grid_(grid), mesh_(object_mesh(object.shape)) {
    reach_m_ = meshing::outer_radius(mesh_);
    pose_ = object.motion.keys.front().pose;
    world_from_mesh_ = matrix_of(pose_);
    height_ = pose_.position.y;
}

double SceneBody::travel_cells(double from_s, double to_s) const {
    if (!is_present(object_->motion, to_s))
        return 0.0;
    const Pose a = pose_at(object_->motion, from_s);
    const Pose b = pose_at(object_->motion, to_s);
    const double way = glm::distance(a.position, b.position);
    const double growth = reach_m_ * std::abs(b.scale - a.scale);
    // A rolling wheel's rim leaves the ground upwards: only what turns otherwise sweeps over it.
    const double turn = 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(a.rotation, b.rotation))));
    const double sweep = object_->motion.rolling ? 0.0 : turn * reach_m_ * b.scale;
    return (way + growth + sweep) / grid_.cell_size;
}

Underside SceneBody::seen_at(const Pose& pose) const {
    if (std::holds_alternative<SphereShape>(object_->shape))
        return underside_of_sphere(
            pose.position, std::get<SphereShape>(object_->shape).radius_m * pose.scale, grid_);
    return underside_of_checked(mesh_, matrix_of(pose), grid_);
}

void SceneBody::ride(double step_s, const GroundSolver& ground,
                     const std::function<FloatRaster(const CellWindow&)>& stiffness, double gravity,
                     Pose& pose) {
    pose.position.y = height_;
    underside_ = seen_at(pose);
    if (underside_.covered == 0)
        return;
    follow(footing_, underside_, ground.heights(underside_.window));
    double target = 0.0;
    if (object_->motion.ride == Ride::Sink) {
        target = height_ + raise_to_sink(footing_, underside_, object_->motion.sink_m);
    } else {
        const double load = object_->mass_kg * gravity + std::max(0.0, -object_->force_n.y);
        target = height_ + raise_to_bear(footing_, underside_, stiffness(underside_.window),
                                         grid_.cell_size, load);
        speed_ -= gravity * step_s;
        const double fallen = height_ + speed_ * step_s;
        if (fallen > target)
            target = fallen;
        else
            speed_ = 0.0;
    }
    const auto raise = static_cast<float>(target - height_);
    height_ = target;
    pose.position.y = target;
    for (float& under : underside_.heights)
        under += raise;
}

void SceneBody::move(double time_s, double step_s, const GroundSolver& ground,
                     const std::function<FloatRaster(const CellWindow&)>& stiffness,
                     double gravity) {
    present_ = is_present(object_->motion, time_s);
    Pose pose = pose_at(object_->motion, time_s);
    if (!present_) {
        footing_ = {};
        underside_ = {};
        moved_before_ = false;
        return;
    }
    if (!moved_before_) {
        height_ = pose.position.y;
        speed_ = 0.0;
        pose_ = pose_at(object_->motion, time_s - step_s);
    }
    const glm::dvec2 way(pose.position.x - pose_.position.x, pose.position.z - pose_.position.z);
    way_ = glm::length(way) > kStill ? glm::normalize(way) : glm::dvec2(0.0);
    if (object_->motion.ride == Ride::Path)
        underside_ = seen_at(pose);
    else
        ride(step_s, ground, stiffness, gravity, pose);
    pose_ = pose;
    world_from_mesh_ = matrix_of(pose);
    moved_before_ = true;
}

PressingBody SceneBody::pressing() const {
    const glm::dvec3 drag = object_->drag_n * glm::dvec3(way_.x, 0.0, way_.y);
    return {&underside_,
            object_->force_n + drag,
            object_->mass_kg,
            {pose_.position.x, pose_.position.z}};
}

void SceneBody::note(const BodyContact& contact) {
    deepest_m_ = std::max(deepest_m_, contact.deepest_m);
    most_cells_ = std::max(most_cells_, contact.cells);
    unspent_n_ = std::max(unspent_n_, contact.unspent_force);
    smaller_than_cell_ = smaller_than_cell_ || contact.smaller_than_cell;
}

}  // namespace scree::terrain
