#pragma once

#include "base/options.h"
#include "terrain/prepare/ground_lattice.h"

#include <cstddef>
#include <cstdint>

namespace scree::terrain {

struct TerrainMeshOptions {
    std::int64_t vertices = 10000;  ///< Of the mesh.
    double evenness = 0.1;          ///< 0: detail goes where the ground bends; 1: everywhere alike.
    double oversampling = 4.0;      ///< Places sampled for each vertex.
};

template <class Visitor>
void describe(TerrainMeshOptions& o, Visitor&& field) {
    field("vertices", o.vertices, {.min = 4, .max = 4e6, .help = "vertices of the mesh"});
    field(
        "evenness", o.evenness,
        {.min = 0, .max = 1, .help = "0: detail goes where the ground bends; 1: everywhere alike"});
    field("oversampling", o.oversampling,
          {.min = 1, .max = 16, .help = "places sampled for each vertex"});
}

/// Places to sample so that a mesh of the wanted size can be made of them; `most` there are to tell
/// apart (cells of a map, points of a survey), and more than those are no use.
/// @throw InvalidOption  a value is outside the range that describe() gives.
std::size_t places_for(const TerrainMeshOptions& options, std::size_t most);

/// The ground as an open sheet of triangles looking up: all known places, then decimated to the
/// wanted size (`mesh-erosion.md` 12). It has fewer vertices if the lattice has, and more if no
/// edge can go without turning a triangle over.
/// @throw InvalidOption  a value is outside the range that describe() gives.
/// @throw InvalidInput   as lattice_mesh().
meshing::TriMesh terrain_mesh(const GroundLattice& ground, const TerrainMeshOptions& options);

}  // namespace scree::terrain
