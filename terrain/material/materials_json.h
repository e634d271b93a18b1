#pragma once

#include "terrain/material/description_map.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scree::terrain {

/// What `materials.json` holds (docs/description-maps.md): the table of materials, and the files of
/// a map where it belongs to one.
struct MaterialTable {
    double cell_size = 1.0;            ///< Edge of a map cell, metres.
    std::filesystem::path ids;         ///< 8-bit grey picture of ids; empty: a table alone.
    std::filesystem::path parameters;  ///< EXR of float planes; empty: the materials' own.
    std::vector<Material> materials;   ///< In order of id.

    bool operator==(const MaterialTable&) const = default;
};

inline constexpr std::size_t kMaxMaterialsBytes = std::size_t{4} << 20;

/// The table as text. Paths are written relative to `folder`, where the text will lie; numbers
/// have the shortest form that reads back as the same value, so writing again changes no byte.
/// @throw InvalidInput  the table breaks check_materials().
std::string materials_to_json(const MaterialTable& table, const std::filesystem::path& folder);

/// Read what materials_to_json() writes; paths are resolved against `folder`. Materials may stand
/// in any order.
/// @param source  Name of the text in messages.
/// @throw InvalidInput  names source and JSON path: no JSON, another format or version, a member
///                      missing, unknown, given twice, of another type or out of range.
MaterialTable materials_from_json(std::string_view text, const std::string& source,
                                  const std::filesystem::path& folder);

/// Read a file of materials. @throw IoError, InvalidInput
MaterialTable read_materials(const std::filesystem::path& path);

/// `path` as it is written in a file that lies in `folder`, and back; empty stays empty.
std::string relative_text(const std::filesystem::path& path, const std::filesystem::path& folder);
std::filesystem::path resolved_path(const std::string& text, const std::filesystem::path& folder);

}  // namespace scree::terrain
