#pragma once

// The formats behind mesh_io; not installed.

#include "base/error.h"
#include "meshing/io/mesh_io.h"
#include "meshing/io/point_io.h"

#include <string>
#include <string_view>

namespace scree::meshing::io {

/// Where a mesh comes from and what it may cost.
struct Source {
    std::string_view bytes;
    std::string_view name;
    const MeshLimits& limits;

    template <class... Parts>
    [[noreturn]] void refuse(const Parts&... parts) const {
        fail<InvalidInput>("cannot read ", name, ": ", parts...);
    }
};

/// A mesh under construction that keeps the limits and checks the numbers.
class Builder {
public:
    explicit Builder(const Source& source) : source_(source) {}

    /// Make room, after the caller has seen that the bytes can hold so much.
    void expect(std::size_t n_vertices, std::size_t n_triangles);
    void add_vertex(double x, double y, double z);
    /// Add a polygon of vertices that may come later; a fan of triangles.
    void add_polygon(std::span<const std::uint32_t> polygon);
    /// Throw if there is no vertex or a triangle names one that is not there.
    MeshFile finish();

    MeshFile file;
    /// Where to put the vertices as the file has them too; null keeps the floats alone.
    std::vector<glm::dvec3>* exact = nullptr;

private:
    const Source& source_;
};

MeshFile decode_obj(const Source& source);
MeshFile decode_ply(const Source& source);
MeshFile decode_off(const Source& source);
MeshFile decode_stl(const Source& source);
PointCloud decode_ply_points(const Source& source);
PointCloud decode_las(const Source& source);

std::string encode_obj(const MeshFile& file);
std::string encode_ply(const MeshFile& file, bool text);
std::string encode_off(const MeshFile& file);
std::string encode_stl(const MeshFile& file, bool text);

}  // namespace scree::meshing::io
