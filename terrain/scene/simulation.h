#pragma once

#include "terrain/grid/heightfield.h"
#include "terrain/grid/settle.h"
#include "terrain/grid/soil_field.h"
#include "terrain/material/description_map.h"
#include "terrain/scene/ground_solver.h"
#include "terrain/scene/scene.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

namespace scree::terrain {

/// An object as it stands at the end of a frame.
struct PlacedObject {
    const SceneObject* object = nullptr;
    const meshing::TriMesh* mesh = nullptr;
    glm::dmat4 world_from_mesh{1.0};
    bool present = false;
};

/// What one frame took and did.
struct FrameReport {
    int substeps = 0;
    double place_ms = 0.0;    ///< Poses, rides and undersides.
    double contact_ms = 0.0;  ///< Heights below objects, forces.
    double step_ms = 0.0;     ///< The ground's answer.
    int contact_cells = 0;    ///< Of the last substep, all objects.
    double unspent_n = 0.0;   ///< Force that passed the yield in it, newtons.
    int tiles = 0;            ///< Active tiles of the last substep.
    double compacted_m3 = 0.0;
};

/// What an object did over all frames so far.
struct ObjectReport {
    std::string name;
    double deepest_m = 0.0;
    int most_cells = 0;
    double unspent_n = 0.0;          ///< Greatest force that passed the yield in a step, newtons.
    bool smaller_than_cell = false;  ///< At some time: it left no track then.
};

/// The ground of one material.
struct MaterialReport {
    std::string name;
    int id = 0;
    double repose_deg = 0.0;
    double greatest_slope_deg = 0.0;  ///< Of faces whose ground has moved; 0 if none has.
    double moved_m3 = 0.0;            ///< Half the displacement's absolute sum.
    double deepest_m = 0.0;           ///< Greatest fall of its ground.
    double highest_m = 0.0;           ///< Greatest rise.
};

/// Volume between the ground and a level floor one metre below its lowest base.
struct VolumeReport {
    double before_m3 = 0.0;
    double after_m3 = 0.0;
    double compacted_m3 = 0.0;
    double moved_m3 = 0.0;        ///< Half the displacement's absolute sum.
    double relative_drift = 0.0;  ///< (after + compacted - before) / before.
    double drift_of_moved = 0.0;  ///< The same over moved_m3: the sharper figure.
};

/// A scene while it runs.
///
/// One way: objects push the ground; of the ground they only take the height that a ride gives
/// them. The same scene gives the same ground for any number of threads.
class Simulation {
public:
    /// Builds the ground, the soils and the objects; nothing has moved yet.
    /// @param scene  Must outlive the simulation.
    /// @throw IoError, InvalidInput  a file of the scene cannot be read or used; the explicit step
    ///                               is beyond the bound of the scene's map. Names the scene.
    explicit Simulation(const Scene& scene, Device device = Device::Auto);
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Run the next frame.
    FrameReport step();

    /// Lift every object off and bring the ground to rest by settle_to_rest(), whatever the scene
    /// says: no motion in time, so it is for the end of a run.
    /// @throw InvalidInput  the reading is literal or the border is zero, neither of which rests
    /// so.
    SettleReport settle();

    int frame() const;  ///< Frames run so far.
    const Heightfield& base() const;
    const DescriptionMap& map() const;
    const GroundSolver& ground() const;
    const std::string& device_reason() const;
    CellWindow extent() const;
    std::vector<PlacedObject> objects() const;

    std::vector<ObjectReport> object_reports() const;
    std::vector<MaterialReport> material_reports() const;
    VolumeReport volume() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace scree::terrain
