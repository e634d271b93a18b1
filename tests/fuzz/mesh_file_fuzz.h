#pragma once

#include "base/error.h"
#include "meshing/io/mesh_io.h"
#include "meshing/mesh/cleaning.h"

#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

namespace scree::fuzz {

/// Any bytes are a mesh that can be cleaned and written, and that reads back with as many vertices
/// and triangles, or an error of ours.
inline int try_mesh(std::span<const std::uint8_t> bytes, meshing::MeshFormat format) {
    const meshing::MeshLimits limits{
        .max_bytes = 1 << 20, .max_vertices = 10'000, .max_triangles = 10'000};
    meshing::MeshFile file;
    try {
        file = meshing::decode_mesh(bytes, format, "fuzz", limits);
    } catch (const Error&) {
        return 0;
    }
    meshing::check_mesh(file.mesh);
    meshing::TriMesh clean = file.mesh;
    meshing::clean_mesh(clean);
    if (format == meshing::MeshFormat::Stl)
        return 0;  // loses triangles that name a place twice
    const std::string text = meshing::encode_mesh(file, format, {.text = true});
    const meshing::MeshFile again = meshing::decode_mesh(
        {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, format, "again");
    if (again.mesh.positions != file.mesh.positions || again.mesh.triangles != file.mesh.triangles)
        std::abort();
    return 0;
}

}  // namespace scree::fuzz
