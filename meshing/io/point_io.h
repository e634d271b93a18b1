#pragma once

#include "meshing/io/mesh_io.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace scree::meshing {

enum class PointFormat { Ply, Las };

/// By the ending of the name, in any case.
/// @throw IoError  the ending is neither .ply nor .las.
PointFormat point_format_of(const std::filesystem::path& path);

/// Points as a file holds them, in its order and its own axes: surveys stand far from the origin,
/// where floats would round them to decimetres.
struct PointCloud {
    std::vector<glm::dvec3> points;
    /// What each point is, of a LAS file (2 is ground, 9 water); empty of a PLY file.
    std::vector<std::uint8_t> classes;
};

inline constexpr std::uint8_t kGroundClass = 2;  ///< Of the American Society's list.

/// Read the bytes of a file of points: the vertices of a PLY file, or the points of a LAS file of
/// version 1.0 to 1.4 that is not compressed. Points that the LAS file marks as withheld are left
/// out. Nothing is allocated on the word of a count that the bytes cannot hold.
/// @param name    For messages.
/// @param limits  Points count as vertices.
/// @throw InvalidInput  the bytes are damaged or compressed, hold no point, a place that is no
///                      number, or pass a limit.
PointCloud decode_points(std::span<const std::uint8_t> bytes, PointFormat format,
                         std::string_view name, const MeshLimits& limits = {});

/// The same from a file; its ending tells the format.
/// @throw IoError  it cannot be read or is larger than the limit.
PointCloud read_points(const std::filesystem::path& path, const MeshLimits& limits = {});

}  // namespace scree::meshing
