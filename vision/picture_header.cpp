#include "vision/picture_header.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>

namespace scree::vision {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

/// Bytes of a file by position; reads beyond its end give zeros and set `beyond`.
class Bytes {
public:
    explicit Bytes(const fs::path& path) : file_(path, std::ios::binary) {
        if (!file_)
            fail<IoError>("cannot read ", path.string(), ": no permission");
        file_.seekg(0, std::ios::end);
        size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file_.tellg()));
    }

    std::uint64_t size() const { return size_; }
    bool beyond() const { return beyond_; }

    unsigned at(std::uint64_t position) {
        if (position >= size_) {
            beyond_ = true;
            return 0;
        }
        if (position < first_ || position >= first_ + filled_)
            fill(position);
        return position - first_ < filled_ ? block_[position - first_] : 0U;
    }

    /// Position of the next such byte from here on, or the file's size.
    std::uint64_t find(unsigned char wanted, std::uint64_t position) {
        while (position < size_ && at(position) != wanted) {
            const auto* start = block_.data() + (position - first_);
            const auto* end = block_.data() + filled_;
            const auto* hit = std::find(start, end, wanted);
            position += static_cast<std::uint64_t>(std::max<std::ptrdiff_t>(1, hit - start));
        }
        return std::min(position, size_);
    }

    unsigned big(std::uint64_t position, unsigned n) {
        unsigned value = 0;
        for (unsigned i = 0; i < n; ++i)
            value = (value << 8) | at(position + i);
        return value;
    }

    unsigned little(std::uint64_t position, unsigned n) {
        unsigned value = 0;
        for (unsigned i = n; i-- > 0;)
            value = (value << 8) | at(position + i);
        return value;
    }

    bool has(std::uint64_t position, std::string_view text) {
        for (std::size_t i = 0; i < text.size(); ++i)
            if (at(position + i) != static_cast<unsigned char>(text[i]))
                return false;
        return true;
    }

private:
    void fill(std::uint64_t position) {
        file_.clear();
        file_.seekg(static_cast<std::streamoff>(position));
        file_.read(reinterpret_cast<char*>(block_.data()),
                   static_cast<std::streamsize>(block_.size()));
        first_ = position;
        filled_ = static_cast<std::uint64_t>(std::max<std::streamsize>(0, file_.gcount()));
    }

    std::ifstream file_;
    std::uint64_t size_ = 0;
    std::uint64_t first_ = 0;
    std::uint64_t filled_ = 0;
    bool beyond_ = false;
    std::array<std::uint8_t, 1 << 16> block_{};
};

[[noreturn]] void refuse_cut(const fs::path& path) {
    fail<IoError>("cannot read ", path.string(), ": the file is cut off");
}

PictureHeader png_header(Bytes& bytes, const fs::path& path) {
    std::uint64_t chunk = 8;
    while (!bytes.has(chunk + 4, "IEND")) {
        const std::uint64_t next = chunk + 12 + bytes.big(chunk, 4);
        if (next >= bytes.size())
            refuse_cut(path);
        chunk = next;
    }
    return {"png", static_cast<double>(bytes.big(16, 4)), static_cast<double>(bytes.big(20, 4)),
            static_cast<int>(bytes.at(24))};
}

bool starts_frame(unsigned marker) {  // SOF0 to SOF15 without DHT, JPG and DAC
    return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

// Walk the segments, and the coded data between them, to the end mark.
PictureHeader jpeg_header(Bytes& bytes, const fs::path& path) {
    PictureHeader header{"jpeg", 0.0, 0.0, 0};
    std::uint64_t at = 2;
    while (at + 1 < bytes.size()) {
        const unsigned marker = bytes.at(at + 1);
        const bool coded = bytes.at(at) != 0xFF || marker == 0x00 || marker == 0xFF ||
                           (marker >= 0xD0 && marker <= 0xD7) || marker == 0x01;
        if (coded) {
            at = bytes.find(0xFF, at + 1);
            continue;
        }
        if (marker == 0xD9)
            return header;
        if (starts_frame(marker)) {
            header.height = std::max(header.height, static_cast<double>(bytes.big(at + 5, 2)));
            header.width = std::max(header.width, static_cast<double>(bytes.big(at + 7, 2)));
        }
        at += 2 + std::max(2U, bytes.big(at + 2, 2));
    }
    refuse_cut(path);
}

PictureHeader webp_header(Bytes& bytes) {
    PictureHeader header{"webp", 0.0, 0.0, 0};
    if (bytes.has(12, "VP8X")) {
        header.width = 1.0 + bytes.little(24, 3);
        header.height = 1.0 + bytes.little(27, 3);
    } else if (bytes.has(12, "VP8L")) {
        const unsigned bits = bytes.little(21, 4);
        header.width = 1.0 + (bits & 0x3FFF);
        header.height = 1.0 + ((bits >> 14) & 0x3FFF);
    } else {
        header.width = bytes.little(26, 2) & 0x3FFF;
        header.height = bytes.little(28, 2) & 0x3FFF;
    }
    return header;
}

// Position behind the text that starts here and ends with a zero.
std::uint64_t after_text(Bytes& bytes, std::uint64_t at) {
    return bytes.find(0, at) + 1;
}

struct TypeLength {
    std::string_view type;  // with the zero at its end
    std::uint64_t length;
};

// OpenEXR's types of fixed length. Its reader trusts the type, not the length that is written.
constexpr TypeLength kExrTypes[] = {
    {"box2i\0"sv, 16},      {"box2f\0"sv, 16},   {"chromaticities\0"sv, 32},
    {"compression\0"sv, 1}, {"double\0"sv, 8},   {"envmap\0"sv, 1},
    {"float\0"sv, 4},       {"int\0"sv, 4},      {"keycode\0"sv, 28},
    {"lineOrder\0"sv, 1},   {"m33f\0"sv, 36},    {"m44f\0"sv, 64},
    {"m33d\0"sv, 72},       {"m44d\0"sv, 128},   {"rational\0"sv, 8},
    {"tiledesc\0"sv, 9},    {"timecode\0"sv, 8}, {"v2i\0"sv, 8},
    {"v2f\0"sv, 8},         {"v2d\0"sv, 16},     {"v3i\0"sv, 12},
    {"v3f\0"sv, 12},        {"v3d\0"sv, 24}};

// Whether an attribute of this type can be of this length.
bool fits_type(Bytes& bytes, std::uint64_t type, std::uint64_t data, std::uint64_t length) {
    for (const TypeLength& known : kExrTypes)
        if (bytes.has(type, known.type))
            return length == known.length;
    if (bytes.has(type, "preview\0"sv))
        return length == 8 + 4 * std::uint64_t{bytes.little(data, 4)} * bytes.little(data + 4, 4);
    if (!bytes.has(type, "chlist\0"sv))
        return true;
    std::uint64_t at = data;  // channels: a name and 16 bytes each, a zero at the end
    while (at < data + length && bytes.at(at) != 0)
        at = after_text(bytes, at) + 16;
    return at + 1 == data + length;
}

// Walk the attributes: the reader takes as much memory as each says it has.
PictureHeader exr_header(Bytes& bytes, const fs::path& path) {
    PictureHeader header{"openexr", 0.0, 0.0, 0};
    const bool parts = (bytes.little(4, 4) & 0x1000U) != 0;
    std::uint64_t at = 8;
    for (bool more = true; more; more = parts && bytes.at(at) != 0) {
        while (bytes.at(at) != 0) {
            const std::uint64_t type = after_text(bytes, at);
            const std::uint64_t size = after_text(bytes, type);
            const std::uint64_t data = size + 4;
            const std::uint64_t length = bytes.little(size, 4);
            if (data + length >= bytes.size())
                refuse_cut(path);
            if (!fits_type(bytes, type, data, length))
                fail<IoError>("cannot read ", path.string(), ": its header is damaged");
            if (bytes.has(at, "dataWindow\0box2i\0"sv)) {
                const auto corner = [&](unsigned i) {
                    return static_cast<double>(
                        static_cast<std::int32_t>(bytes.little(data + std::uint64_t{4} * i, 4)));
                };
                header.width = std::max(header.width, corner(2) - corner(0) + 1.0);
                header.height = std::max(header.height, corner(3) - corner(1) + 1.0);
            }
            at = data + length;
        }
        ++at;
    }
    return header;
}

double magnitude(unsigned bits) {  // of a 32-bit number in two's complement
    return static_cast<double>(bits < 0x80000000U ? bits : 0U - bits);
}

PictureHeader bmp_header(Bytes& bytes) {
    if (bytes.little(14, 4) == 12)
        return {"bmp", static_cast<double>(bytes.little(18, 2)),
                static_cast<double>(bytes.little(20, 2)), 0};
    return {"bmp", magnitude(bytes.little(18, 4)), magnitude(bytes.little(22, 4)), 0};
}

bool is_pnm(Bytes& bytes) {
    const unsigned kind = bytes.at(1);
    const unsigned blank = bytes.at(2);
    const bool known = (kind >= '1' && kind <= '6') || kind == 'f' || kind == 'F';
    return bytes.at(0) == 'P' && known &&
           (blank == ' ' || blank == '\n' || blank == '\r' || blank == '\t' || blank == '#');
}

bool is_tiff(Bytes& bytes) {
    return bytes.has(0, "II*\0"sv) || bytes.has(0, "MM\0*"sv) || bytes.has(0, "II+\0"sv) ||
           bytes.has(0, "MM\0+"sv);
}

std::string lower_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return extension;
}

PictureHeader header_of(Bytes& bytes, const fs::path& path) {
    if (bytes.has(0, "\x89PNG\r\n\x1A\n"))
        return png_header(bytes, path);
    if (bytes.has(0, "\xFF\xD8\xFF"))
        return jpeg_header(bytes, path);
    if (bytes.has(0, "GIF87a") || bytes.has(0, "GIF89a"))
        return {"gif", static_cast<double>(bytes.little(6, 2)),
                static_cast<double>(bytes.little(8, 2)), 0};
    if (bytes.has(0, "RIFF") && bytes.has(8, "WEBP"))
        return webp_header(bytes);
    if (bytes.has(0, "BM"))
        return bmp_header(bytes);
    if (is_tiff(bytes))
        return {"tiff", 0.0, 0.0, 0};
    if (bytes.has(0, "\x76\x2F\x31\x01"))
        return exr_header(bytes, path);
    if (is_pnm(bytes))
        return {"pnm", 0.0, 0.0, 0};
    if (lower_extension(path) == ".tga")  // has no mark of its own
        return {"targa", static_cast<double>(bytes.little(12, 2)),
                static_cast<double>(bytes.little(14, 2)), 0};
    fail<IoError>("cannot read ", path.string(),
                  ": no picture of a known format (PNG, JPEG, TIFF, OpenEXR, BMP, PNM, GIF, WebP, "
                  "TGA)");
}

}  // namespace

PictureHeader read_picture_header(const fs::path& path) {
    std::error_code error;
    if (!fs::exists(path, error))
        fail<IoError>("cannot read ", path.string(), ": no such file");
    if (fs::is_directory(path, error))
        fail<IoError>("cannot read ", path.string(), ": it is a folder, name a picture in it");
    if (!fs::is_regular_file(path, error))
        fail<IoError>("cannot read ", path.string(), ": it is no regular file");
    Bytes bytes(path);
    if (bytes.size() == 0)
        fail<IoError>("cannot read ", path.string(), ": the file is empty");
    PictureHeader header = header_of(bytes, path);
    if (bytes.beyond())
        refuse_cut(path);
    return header;
}

}  // namespace scree::vision
