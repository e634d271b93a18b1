#include "tests/fuzz/mesh_file_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return scree::fuzz::try_mesh({data, size}, scree::meshing::MeshFormat::Ply);
}
