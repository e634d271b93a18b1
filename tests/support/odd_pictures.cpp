#include "tests/support/odd_pictures.h"

#include <array>
#include <stdexcept>

#include <OpenImageIO/imageio.h>

namespace scree::test {
namespace {

void append_big_endian(std::string& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char>(value >> shift & 0xFF);
}

std::uint32_t crc32(const std::string& bytes) {
    std::uint32_t crc = 0xFFFFFFFF;
    for (const char c : bytes) {
        crc ^= static_cast<std::uint8_t>(c);
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ (0xEDB88320 & (0 - (crc & 1)));
    }
    return ~crc;
}

std::uint32_t adler32(const std::string& bytes) {
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const char c : bytes) {
        a = (a + static_cast<std::uint8_t>(c)) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

std::string chunk(const std::string& type, const std::string& data) {
    std::string bytes;
    append_big_endian(bytes, static_cast<std::uint32_t>(data.size()));
    bytes += type + data;
    append_big_endian(bytes, crc32(type + data));
    return bytes;
}

std::string header(std::uint32_t width, std::uint32_t height, char colour_type) {
    std::string data;
    append_big_endian(data, width);
    append_big_endian(data, height);
    data += {8, colour_type, 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", data);
}

// Zlib's stored blocks: no compression needed here.
std::string stored(const std::string& bytes) {
    std::string out = "\x78\x01";
    for (std::size_t at = 0; at < bytes.size(); at += 65535) {
        const std::size_t n = std::min<std::size_t>(65535, bytes.size() - at);
        out += static_cast<char>(at + n == bytes.size() ? 1 : 0);
        for (const std::size_t value : {n, ~n}) {
            out += static_cast<char>(value & 0xFF);
            out += static_cast<char>(value >> 8 & 0xFF);
        }
        out += bytes.substr(at, n);
    }
    append_big_endian(out, adler32(bytes));
    return out;
}

void require(bool done, const std::filesystem::path& path) {
    if (!done)
        throw std::runtime_error("cannot write " + path.string() + ": " + OIIO::geterror());
}

// Values of the form's channels, eight bits each.
std::vector<std::uint8_t> channels_of(const Photo& photo, Form form, int n_channels) {
    std::vector<std::uint8_t> values;
    values.reserve(photo.size() * static_cast<std::size_t>(n_channels));
    for (const glm::u8vec3& c : photo) {
        const auto inverse = [](std::uint8_t v) { return static_cast<std::uint8_t>(255 - v); };
        const std::array<std::uint8_t, 4> all =
            form == Form::Cmyk
                ? std::array<std::uint8_t, 4>{inverse(c.x), inverse(c.y), inverse(c.z), 0}
                : std::array<std::uint8_t, 4>{c.x, c.y, c.z, 128};
        values.insert(values.end(), all.begin(), all.begin() + n_channels);
    }
    return values;
}

}  // namespace

std::string palette_png(const Raster<std::uint8_t>& indices,
                        const std::vector<glm::u8vec3>& palette) {
    std::string colours;
    for (const glm::u8vec3& c : palette)
        colours += {static_cast<char>(c.x), static_cast<char>(c.y), static_cast<char>(c.z)};
    std::string rows;
    for (int y = 0; y < indices.height(); ++y) {
        rows += '\0';
        rows.append(reinterpret_cast<const char*>(indices.row(y)),
                    static_cast<std::size_t>(indices.width()));
    }
    return header(static_cast<std::uint32_t>(indices.width()),
                  static_cast<std::uint32_t>(indices.height()), 3) +
           chunk("PLTE", colours) + chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

std::string huge_png(std::uint32_t width, std::uint32_t height) {
    return header(width, height, 2) + chunk("IDAT", stored("tiny")) + chunk("IEND", "");
}

void write_in_form(const std::filesystem::path& path, const Photo& photo, Form form) {
    const int n_channels = form == Form::Grey                          ? 1
                           : form == Form::Alpha || form == Form::Cmyk ? 4
                                                                       : 3;
    OIIO::ImageSpec spec(photo.width(), photo.height(), n_channels,
                         form == Form::Sixteen ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
    if (form == Form::Cmyk) {
        spec.channelnames = {"C", "M", "Y", "K"};
        spec["tiff:ColorSpace"] = "CMYK";
        spec["tiff:PhotometricInterpretation"] = 5;
    }
    spec["oiio:UnassociatedAlpha"] = 1;  // colours are written as they are
    auto output = OIIO::ImageOutput::create(path.string());
    require(output != nullptr, path);
    const std::vector<std::uint8_t> values = channels_of(photo, form, n_channels);
    if (form != Form::Animated) {
        require(output->open(path.string(), spec) &&
                    output->write_image(OIIO::TypeDesc::UINT8, values.data()) && output->close(),
                path);
        return;
    }
    const std::vector<std::uint8_t> black(values.size(), 0);
    const std::array<OIIO::ImageSpec, 2> frames = {spec, spec};
    require(output->open(path.string(), 2, frames.data()) &&
                output->write_image(OIIO::TypeDesc::UINT8, values.data()) &&
                output->open(path.string(), spec, OIIO::ImageOutput::AppendSubimage) &&
                output->write_image(OIIO::TypeDesc::UINT8, black.data()) && output->close(),
            path);
}

}  // namespace scree::test
