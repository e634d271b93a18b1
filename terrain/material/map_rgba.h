#pragma once

#include "terrain/material/description_map.h"
#include "terrain/material/id_text.h"
#include "vision/image_io.h"

#include <filesystem>
#include <string>
#include <vector>

namespace scree::terrain {

/// The published form of a description map: a picture and its id file
/// (`rocks-and-deformer.md` D.1, D.2).
struct RgbaMap {
    vision::RgbaImage picture;
    IdFile ids;
};

/// What a conversion between the two forms could not keep.
struct ConversionReport {
    double repose_deg = 0.0;  ///< Greatest error of a cell, degrees.
    double mobility = 0.0;    ///< Greatest error of a cell.
    double diffusion = 0.0;
    std::vector<int> without_cells;  ///< Ids whose soil is in no cell and so was not written.
    std::vector<std::string> lost;   ///< What else the form has no place for, a sentence each.

    /// Nothing was lost at all.
    bool exact() const {
        return repose_deg == 0.0 && mobility == 0.0 && diffusion == 0.0 && without_cells.empty() &&
               lost.empty();
    }
};

/// Pack a map: red = repose / 90 deg, green = mobility / its maximum, blue = diffusion / its
/// maximum, each to the nearest of 2^bits - 1 steps, alpha = id, so that alpha over full alpha is
/// id / 255 at either depth. A maximum is 1, or the greatest value of the map if that is more.
/// Red stops one step below full: a repose of 90 degrees is no soil.
/// @throw InvalidInput   the map breaks check_map().
/// @throw InvalidOption  `bits` is neither 8 nor 16.
RgbaMap pack_map(const DescriptionMap& map, int bits, ConversionReport* report = nullptr);

/// Unpack a map. A material's soil is the mean over its cells; a plane is kept only if a cell
/// differs from that. Packing the result again gives the same picture.
/// @param cell_size  Used where the id file says none, metres.
/// @throw InvalidInput  an id has no material, a 16-bit alpha is no multiple of 257, a red is full.
DescriptionMap unpack_map(const RgbaMap& rgba, double cell_size,
                          ConversionReport* report = nullptr);

/// Read both files. @throw IoError, InvalidInput
RgbaMap read_rgba_map(const std::filesystem::path& picture, const std::filesystem::path& id_file);

}  // namespace scree::terrain
