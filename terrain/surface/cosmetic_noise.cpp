#include "terrain/surface/cosmetic_noise.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "meshing/mesh/normals.h"

namespace scree::terrain {
namespace {

constexpr std::uint64_t kStream = 0x726f756768ULL;

}  // namespace

void roughen(meshing::TriMesh& mesh, const meshing::Adjacency& adjacency, double amplitude,
             std::uint64_t seed) {
    if (!(amplitude >= 0.0 && amplitude < 1e30))
        fail<InvalidInput>("the amplitude of cosmetic noise is ", amplitude,
                           ", it must be 0 or more mean edges");
    const auto normals = meshing::vertex_normals(mesh, adjacency);
    const double most = amplitude * meshing::mean_edge_length(mesh, adjacency);
    parallel_for_each_index(0, mesh.positions.size(), 1024, [&](std::size_t v) {
        if (adjacency.rim[v] != 0)
            return;
        Rng rng({.seed = seed, .stream = kStream, .cell = v});
        mesh.positions[v] += normals[v] * static_cast<float>(rng.uniform(-most, most));
    });
}

}  // namespace scree::terrain
