#pragma once

#include <filesystem>
#include <string>

namespace scree::vision {

/// What the first bytes of a picture file say, read without decoding it.
struct PictureHeader {
    std::string format;   ///< Name of the OpenImageIO reader: "png", "jpeg", "tiff" ...
    double width = 0.0;   ///< As the file declares it, px; 0 where opening it costs no memory.
    double height = 0.0;  ///< As the file declares it, px; 0 where opening it costs no memory.
    int bits = 0;         ///< Bits a sample of a PNG; 0 for other formats.
};

/// Find the format by its first bytes and the size it declares; make sure that PNG and JPEG files
/// go on to their end mark, for a decoder would fill a cut JPEG with grey and say nothing, and that
/// the attributes of an OpenEXR file are no longer than the file.
/// @throw IoError  the file is missing, a folder, no regular file, empty, cut off or of none of the
///                 formats PNG, JPEG, TIFF, OpenEXR, BMP, PNM, GIF, WebP and TGA.
PictureHeader read_picture_header(const std::filesystem::path& path);

}  // namespace scree::vision
