#include "terrain/prepare/terrain_mesh.h"

#include "meshing/mesh/decimation.h"

#include <algorithm>
#include <cmath>

namespace scree::terrain {

std::size_t places_for(const TerrainMeshOptions& options, std::size_t most) {
    check(options);
    const auto vertices = static_cast<std::size_t>(options.vertices);
    const auto wanted = static_cast<std::size_t>(
        std::ceil(static_cast<double>(options.vertices) * options.oversampling));
    // Rounding a lattice's sides may lose a row and a column.
    const std::size_t least =
        vertices + 2 * static_cast<std::size_t>(std::ceil(std::sqrt(double(options.vertices))));
    return std::min({std::max(least, std::min(wanted, most)), kMostLatticePlaces});
}

meshing::TriMesh terrain_mesh(const GroundLattice& ground, const TerrainMeshOptions& options) {
    check(options);
    meshing::TriMesh mesh = lattice_mesh(ground);
    if (mesh.positions.size() > static_cast<std::size_t>(options.vertices))
        meshing::decimate(
            mesh, {.vertices = options.vertices, .evenness = options.evenness, .keep_up = true});
    return mesh;
}

}  // namespace scree::terrain
