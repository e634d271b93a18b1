#include "base/error.h"
#include "meshing/gltf/check_gltf.h"
#include "meshing/gltf/gltf_read.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace {

bool finite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row]))
                return false;
    return true;
}

}  // namespace

// Any bytes are meshes whose triangles name vertices that exist, placed where numbers say, or an
// error of ours; the check never throws.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scree::meshing;
    const GltfLimits limits{.max_bytes = 1 << 20,
                            .max_json_bytes = 1 << 16,
                            .max_vertices = 10'000,
                            .max_triangles = 10'000,
                            .max_placements = 1'000};
    check_glb({data, size}, limits);
    LoadedGltf loaded;
    try {
        loaded = decode_glb({data, size}, limits);
    } catch (const scree::Error&) {
        return 0;
    }
    for (const GltfMesh& part : loaded.meshes)
        check_mesh(part.geometry);
    for (const GltfPlacement& placement : loaded.placements)
        if (placement.mesh >= loaded.meshes.size() || !finite(placement.world_from_mesh))
            std::abort();
    return 0;
}
