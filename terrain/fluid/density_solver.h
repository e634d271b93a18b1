#pragma once

// Inside the position-based fluid alone; not installed.

#include "terrain/fluid/fluid.h"
#include "terrain/fluid/smoothing_kernel.h"
#include "terrain/fluid/triangle_grid.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace scree::terrain::fluid {

/// What a step needs to know.
struct StepSetup {
    const TriangleGrid* mesh = nullptr;  ///< Null without one.
    SmoothingKernel kernel{0.2};
    float radius = 0.05F;
    float contact_distance = 0.0625F;
    float rest_sum = 1.0F;  ///< Kernel sum of a particle at rest.
    float softness = 1.0F;  ///< Added to the squared gradient.
    float viscosity = 0.0F;
    float friction = 0.0F;
    int iterations = 4;
    glm::vec3 gravity{0.0F};
};

/// Kernel sum and squared gradients of a particle in a cubic lattice of this spacing.
void calibrate(StepSetup& setup, float spacing);

/// The arrays of a step, kept from one to the next to save their making. All but `order` are
/// sorted by cells.
struct StepArrays {
    struct Block {
        std::vector<std::uint32_t> starts, items;
    };
    std::vector<std::uint32_t> order;  ///< Index in the state of each sorted particle.
    std::vector<glm::vec3> old_places, places, velocities, moves, pushes;
    std::vector<float> lambdas;
    std::vector<ContactPlanes> planes;
    std::vector<Block> neighbours;  ///< Of blocks of consecutive particles.
};

/// Move all particles by one short step; contacts are set anew.
void advance(FluidState& state, const StepSetup& setup, StepArrays& arrays, float seconds);

}  // namespace scree::terrain::fluid
