#pragma once

#include "terrain/material/shader_templates.h"

#include <string>

namespace scree::terrain {

// The GLSL of the view, stage by stage: ground_shaders.cpp has the mesh, shading_shaders.cpp the
// ground's and walls' colours, view_shaders.cpp the rest. How materials blend and where their
// pictures lie is in the functions that ground_shaders() makes for the map, with layers.

/// Texture units, the same in every program of the view.
enum ViewUnit {
    kBaseUnit = 0,     ///< Base heights, R32F.
    kMovedUnit = 1,    ///< Displacements, R32F.
    kSurfaceUnit = 2,  ///< Slopes x and z, share of the dynamic normal, open sky: RGBA16F.
    kSunUnit = 3,      ///< Sunlight that reaches a cell past the ground, R8.
    kIdUnit = 4,       ///< Ids of the map's cells, R8UI: `scree_ids`.
    kAlbedoUnit = 5,   ///< sRGB array: `scree_albedo`.
    kDetailUnit = 6,   ///< Slopes x and z, height, open sky: RGBA8 array.
    kUnderUnit = 9,    ///< Undersides of the objects.
    kDepthUnit = 8,    ///< Depth of the ground in the picture.
    kShadowUnit = 7,   ///< Depth of the objects from the sun.
    kReliefUnit = 10,  ///< Heights of the looks about their mean, R16F array: `scree_displacement`.
};

std::string ground_vertex_glsl();
std::string ground_control_glsl();
std::string ground_evaluation_glsl(const GroundShaders& made);
/// From the depth of the picture, sky included.
std::string ground_fragment_glsl(const GroundShaders& made);

std::string surface_compute_glsl();  ///< Slopes and open sky of a window of cells.
std::string sun_compute_glsl();      ///< Sunlight of a window of cells.

/// Rocks near the eye; near_rocks.h has the vertices.
std::string near_rock_fragment_glsl(const GroundShaders& made);
std::string wall_vertex_glsl();  ///< The sides of the ground.
std::string wall_fragment_glsl(const GroundShaders& made);
std::string object_vertex_glsl();
std::string object_fragment_glsl();
std::string shadow_vertex_glsl();  ///< Objects seen from the sun.
std::string shadow_fragment_glsl();
std::string screen_vertex_glsl();     ///< One triangle over the whole picture.
std::string resolve_fragment_glsl();  ///< Samples to pixels.
std::string line_fragment_glsl();     ///< Edges of the wire view.

}  // namespace scree::terrain
