#pragma once

#include "terrain/material/description_map.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scree::terrain {

/// What the id text file of an RGBA map holds (`rocks-and-deformer.md` D.2). It has no soils (they
/// stand in the picture), and neither sizes of textures nor compaction.
struct IdFile {
    double mobility_max = 1.0;   ///< Mobility of a full green.
    double diffusion_max = 1.0;  ///< Diffusion of a full blue.
    double cell_size = 0.0;      ///< Edge of a map cell, metres; 0: not said.
    std::vector<Material> materials;

    bool operator==(const IdFile&) const = default;
};

inline constexpr std::size_t kMaxIdFileBytes = std::size_t{1} << 20;

/// The file as text: a header, then a line `id name albedo displacement normal gravel a b c` for
/// each material; `-` stands for no file and for a hat taken from the neighbours. Words with
/// spaces stand in quotes. Paths are written relative to `folder`.
/// @throw InvalidInput  a material breaks check_materials(), a maximum is not positive.
std::string ids_to_text(const IdFile& file, const std::filesystem::path& folder);

/// Read what ids_to_text() writes, with any spacing, empty lines and comments behind `#`. Gravel
/// needs an albedo texture here too.
/// @throw InvalidInput  names `source` and the line.
IdFile ids_from_text(std::string_view text, const std::string& source,
                     const std::filesystem::path& folder);

/// @throw IoError, InvalidInput
IdFile read_id_file(const std::filesystem::path& path);

}  // namespace scree::terrain
