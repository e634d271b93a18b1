#pragma once

#include "base/raster.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <glm/fwd.hpp>
#include <glm/vec4.hpp>

namespace scree::vision {

/// What a picture may cost before it is refused.
struct ReadLimits {
    double max_pixels = 200e6;  ///< Width times height; checked before memory is taken.
};

/// A photograph and what its file says of its scale.
struct PhotoFile {
    Photo pixels;
    double metres_per_pixel = 0.0;  ///< From the metadata `scree:metres_per_pixel`; 0 if unknown.
};

/// Heights in metres with the scale that makes them meaningful elsewhere.
struct HeightImage {
    FloatRaster metres;
    double metres_per_pixel = 0.0;  ///< 0 if unknown.
    bool in_metres = true;          ///< False: shares of white, the file says nothing of metres.
};

/// Four channels of whole numbers that are data, not colours: alpha is never multiplied in.
struct RgbaImage {
    Raster<glm::u16vec4> values;  ///< Each at most 255 if `bits` is 8.
    int bits = 8;                 ///< 8 or 16, as in the file.

    bool operator==(const RgbaImage&) const = default;
};

/// One channel of a float picture.
struct NamedPlane {
    std::string name;
    FloatRaster values;
};

/// Read a photograph as 8-bit sRGB: PNG, JPEG, TIFF, OpenEXR, BMP, PNM, GIF, WebP or TGA of any
/// depth. The format is told by the first bytes, not by the name.
///
/// EXIF orientation is applied. Grey becomes three equal channels, palettes are looked up, CMYK is
/// converted, alpha is dropped, the first frame of an animation is taken; float pictures are taken
/// as linear light and coded.
/// @throw IoError       the file is missing, a folder, truncated or of no known format.
/// @throw InvalidInput  it has more pixels than the limit, no pixels, or values that are no
/// numbers.
PhotoFile read_photo(const std::filesystem::path& path, const ReadLimits& limits = {});

/// How many channels a picture has. @throw IoError, InvalidInput  as read_photo().
int count_channels(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Read a label map: one channel of 8 or 16 bits, values kept as they are.
LabelMap read_labels(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Read one channel as float (heights): integers are divided by their largest value.
/// Honours `scree:metres_min` and `scree:metres_max` if the file carries them.
HeightImage read_heights(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Read four channels of 8 or 16 bits, values kept as they are.
/// @throw InvalidInput  it has another number of channels or other values; else as read_photo().
RgbaImage read_rgba(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Read every channel of a float picture with its name, in the order of the file.
/// @throw InvalidInput  a value is no number or the file holds whole numbers; else as read_photo().
std::vector<NamedPlane> read_planes(const std::filesystem::path& path,
                                    const ReadLimits& limits = {});

/// Write 8-bit sRGB PNG. `path` is used as it is: stage it for an atomic write.
/// @throw IoError  names the path and the reason.
void write_png(const std::filesystem::path& path, const Photo& picture);
/// Write three channels of 8 bits that are data, not colours (normals): PNG without a colour space.
void write_data_png(const std::filesystem::path& path, const Photo& picture);
/// Write 8-bit grey PNG.
void write_png(const std::filesystem::path& path, const Raster<std::uint8_t>& picture);
/// Write 16-bit grey PNG with the labels as they are.
void write_labels(const std::filesystem::path& path, const LabelMap& labels);

/// Write heights as 32-bit float EXR in metres, scale in the metadata.
void write_heights_exr(const std::filesystem::path& path, const HeightImage& heights);
/// Write heights as 16-bit PNG from their least to their greatest value; both stand in the
/// metadata as `scree:metres_min` and `scree:metres_max`, beside `scree:metres_per_pixel`.
void write_heights_png(const std::filesystem::path& path, const HeightImage& heights);

/// Write PNG without a colour space, alpha as it is.
void write_rgba_png(const std::filesystem::path& path, const RgbaImage& picture);
/// Write planes of one size as channels of a 32-bit float EXR.
void write_planes_exr(const std::filesystem::path& path, std::span<const NamedPlane> planes);

/// A JPEG file in memory. @param quality 1 to 100.
std::vector<std::uint8_t> encode_jpeg(const Photo& picture, int quality);

}  // namespace scree::vision
