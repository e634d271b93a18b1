#pragma once

#include "terrain/gpu/gl_objects.h"
#include "terrain/gpu/shader_program.h"
#include "terrain/material/shader_templates.h"
#include "terrain/view/terrain_frame.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree::terrain {

/// A window of ground on the device: heights, displacements, what follows from both, and looks.
class GroundTextures {
public:
    /// @throw InvalidInput, DeviceError  as TerrainView's constructor.
    GroundTextures(const GlContext& context, const TerrainGround& ground);

    /// Take new displacements of the cells of `changed` (of the base; clipped to the window).
    /// @throw InvalidInput  the raster has another size, or a value that is no number.
    void update(const FloatRaster& displacement, const CellWindow& changed);
    /// Bring slopes, open sky and sunlight up to date.
    void finish(const glm::vec3& sun_direction);

    /// The functions that blend the map's looks, with layers; a program that has them needs
    /// set_samplers() once.
    const GroundShaders& shaders() const { return shaders_; }
    static void set_samplers(const ShaderProgram& program);

    /// Bind all textures and the looks' buffer to their units.
    void bind() const;
    /// Set what the shaders know of the ground's place and size.
    void set_uniforms(const ShaderProgram& program) const;

    /// Height of the base at a place, the window's rim carried outwards; waits for the device.
    float base_height(float x, float z) const;
    const CellWindow& window() const { return window_; }
    float cell_size() const { return cell_size_; }
    glm::vec2 origin() const { return origin_; }
    glm::vec2 size() const { return size_; }
    float lowest() const { return lowest_; }    ///< Height, no displacement may lie below it.
    float highest() const { return highest_; }  ///< Height, no displacement may lie above it.
    float detail_reach() const { return detail_reach_; }  ///< How far looks may move a point.

private:
    void load_heights(const Heightfield& base);
    void load_map(const GlContext& context, const TerrainGround& ground);
    void load_looks(const GlContext& context, const TerrainGround& ground);
    void run(const ShaderProgram& program, const GlTexture& out, unsigned format,
             const CellWindow& cells) const;

    CellWindow window_;
    float cell_size_;
    glm::vec2 origin_{0.0F}, size_{1.0F};
    float base_lowest_ = 0.0F, base_highest_ = 0.0F, lowest_ = 0.0F, highest_ = 0.0F;
    float detail_reach_ = 0.0F;
    float map_cells_per_m_ = 1.0F;
    int side_ = 1;
    glm::vec3 sun_{0.0F};
    CellWindow dirty_;  // in cells of the window

    GlTexture base_, moved_, surface_, sun_reach_, ids_, albedo_, detail_, relief_;
    GlBuffer looks_;
    GroundShaders shaders_;
    ShaderProgram surface_program_, sun_program_;
};

}  // namespace scree::terrain
