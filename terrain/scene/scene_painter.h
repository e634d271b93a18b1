#pragma once

#include "base/raster.h"
#include "terrain/scene/simulation.h"

#include <memory>
#include <string>

namespace scree::terrain {

/// Draws a scene's frames: by OpenGL where a context can be made, else by the renderer in software.
class ScenePainter {
public:
    virtual ~ScenePainter() = default;
    virtual Photo draw(const Simulation& simulation) = 0;
    /// What draws, for a log.
    virtual std::string renderer() const = 0;
};

/// Looks of the materials are read, the ground is prepared.
/// @throw IoError, InvalidInput  a material's picture cannot be read.
std::unique_ptr<ScenePainter> make_painter(const Scene& scene, const Simulation& simulation);

/// The ground's colours from above, `side` pixels along the longer side.
/// @throw IoError, InvalidInput  a material's picture cannot be read.
Photo scene_colours(const Simulation& simulation, int side);

}  // namespace scree::terrain
