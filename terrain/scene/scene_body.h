#pragma once

#include "meshing/mesh/tri_mesh.h"
#include "terrain/contact/contact_force.h"
#include "terrain/contact/footing.h"
#include "terrain/contact/object_motion.h"
#include "terrain/grid/soil_field.h"
#include "terrain/scene/ground_solver.h"
#include "terrain/scene/scene.h"

#include <functional>

namespace scree::terrain {

/// The mesh of a scene's object, in its own frame.
/// @throw IoError, InvalidInput, InvalidOption  a file cannot be read or shows no mesh; names it.
meshing::TriMesh object_mesh(const ObjectShape& shape);

/// One object while a scene runs: where it is, what it stands on, how it has pressed so far.
class SceneBody {
public:
    /// @param object  Must outlive the body.
    SceneBody(const SceneObject& object, const CellGrid& grid);

    const SceneObject& object() const { return *object_; }
    const meshing::TriMesh& mesh() const { return mesh_; }
    const glm::dmat4& world_from_mesh() const { return world_from_mesh_; }
    /// It is part of the scene at the time of the last move.
    bool present() const { return present_; }

    /// Cells that its surface travels between two times, at most: what a step must not exceed.
    double travel_cells(double from_s, double to_s) const;

    /// Go to a time, `step_s` after the last: place, rotation, scale, and the height that the ride
    /// gives over the solver's present ground.
    /// @param stiffness  Pascals a metre of depth over a window's cells, asked for Ride::Weight.
    void move(double time_s, double step_s, const GroundSolver& ground,
              const std::function<FloatRaster(const CellWindow&)>& stiffness, double gravity);

    /// What presses now; present and over the ground only.
    PressingBody pressing() const;
    const Underside& underside() const { return underside_; }

    /// Add what a step's contact was to the totals.
    void note(const BodyContact& contact);
    double deepest_m() const { return deepest_m_; }
    int most_cells() const { return most_cells_; }
    double unspent_n() const { return unspent_n_; }
    bool ever_smaller_than_cell() const { return smaller_than_cell_; }

private:
    Underside seen_at(const Pose& pose) const;
    void ride(double step_s, const GroundSolver& ground,
              const std::function<FloatRaster(const CellWindow&)>& stiffness, double gravity,
              Pose& pose);

    const SceneObject* object_;
    CellGrid grid_;
    meshing::TriMesh mesh_;
    double reach_m_ = 0.0;  // farthest vertex from the origin
    bool present_ = false;
    bool moved_before_ = false;
    double height_ = 0.0;  // of a riding body
    double speed_ = 0.0;   // upwards, m/s
    glm::dvec2 way_{0.0};  // horizontal direction of travel, or zero
    Footing footing_;
    Underside underside_;
    glm::dmat4 world_from_mesh_{1.0};
    Pose pose_;
    double deepest_m_ = 0.0;
    int most_cells_ = 0;
    double unspent_n_ = 0.0;
    bool smaller_than_cell_ = false;
};

}  // namespace scree::terrain
