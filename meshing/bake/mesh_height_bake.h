#pragma once

#include "meshing/mesh/tri_mesh.h"
#include "vision/image_io.h"

#include <span>

#include <glm/mat4x4.hpp>

namespace scree::meshing {

/// Where a map lies in the world: its centre is the origin, columns grow along +x, rows along +z.
struct MapFrame {
    int width = 0;                  ///< Pixels.
    int height = 0;                 ///< Pixels.
    double metres_per_pixel = 0.0;  ///< Edge of a pixel on the ground.
    bool wraps = false;  ///< The map repeats: what leaves on one side enters on the other.
};

/// A mesh at its place. The mesh is borrowed.
struct PlacedMesh {
    const TriMesh* mesh = nullptr;
    glm::dmat4 world_from_mesh{1.0};
};

/// Displacement map of meshes seen by an orthographic camera that looks straight down
/// (`rocks-and-deformer.md` part E), by a z-buffer that keeps the greatest height.
///
/// The value is the height in metres of the surface over the pixel's centre; 0 where there is
/// none above the ground.
/// @pre   Meshes pass check_mesh() and hold at most 2^31 triangles together.
/// @throw InvalidInput  the frame has no pixels, more than 200 million or no scale; a mesh is
///        missing, broken, or placed by a matrix that is not finite or, in a wrapping frame, is
///        wider than 64 frames.
vision::HeightImage bake_mesh_heights(std::span<const PlacedMesh> meshes, const MapFrame& frame);

}  // namespace scree::meshing
