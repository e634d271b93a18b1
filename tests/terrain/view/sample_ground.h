#pragma once

#include "terrain/view/terrain_frame.h"

namespace scree::terrain::test {

/// A rolling ground, `side` cells square, 4 m wide whatever its resolution.
Heightfield rolling_ground(int side, unsigned seed = 1);

/// Three strips along z: sand (id 1), mud (id 2) and pebbles (id 7), with wavy borders.
DescriptionMap three_strips(double width_m, int side = 128);

/// Made-up looks for them: ripples of sand, cracked mud, round pebbles.
std::vector<MaterialLook> strip_looks(int side = 512);

/// A groove across all three strips, as wide as a tyre, with rims; zero elsewhere.
FloatRaster groove(const Heightfield& base);

/// A unit sphere with normals.
meshing::TriMesh sphere(int rings = 24);

/// A box with edges 1, without normals.
meshing::TriMesh box();

}  // namespace scree::terrain::test
