#pragma once

#include "vision/thesis/ray_marching.h"
#include "vision/thesis/thesis_options.h"

#include <vector>

#include <glm/vec2.hpp>

namespace scree::vision {

/// Pixels of a regular lattice over a picture, row by row: floor(width / spacing) columns and
/// floor(height / spacing) rows, at least one of each (AMB-07).
/// @pre  width, height and spacing are positive.
std::vector<glm::ivec2> grid_nodes(int width, int height, int spacing);

/// The nodes that lie on no edge pixel, in the order in which they are visited (A.5).
std::vector<glm::ivec2> visiting_order(const RayCaster& caster, const ThesisOptions& options);

}  // namespace scree::vision
