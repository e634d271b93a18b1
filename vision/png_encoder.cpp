#include "vision/png_encoder.h"

#include "base/parallel.h"
#include "base/simd.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <libdeflate.h>
#include <memory>
#include <new>
#include <string_view>

namespace scree::vision {
namespace {

// The fastest: the higher levels take twice the time for a few percent of the size.
constexpr int kLevel = 1;
constexpr std::size_t kMostInAChunk = std::size_t{1} << 30U;

using Bytes = std::vector<std::uint8_t>;

// Memory that nobody has written to costs nothing until it is.
struct Buffer {
    explicit Buffer(std::size_t n)
        : data(std::make_unique_for_overwrite<std::uint8_t[]>(n)), size(n) {}
    std::unique_ptr<std::uint8_t[]> data;
    std::size_t size;
};

struct FreeCompressor {
    void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};

void append_word(Bytes& bytes, std::size_t word) {
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

void append_chunk(Bytes& file, std::string_view type, std::span<const std::uint8_t> content) {
    append_word(file, content.size());
    const std::size_t first = file.size();
    file.insert(file.end(), type.begin(), type.end());
    file.insert(file.end(), content.begin(), content.end());
    append_word(file, libdeflate_crc32(0, file.data() + first, file.size() - first));
}

void append_text(Bytes& file, std::string_view keyword, std::string_view text) {
    Bytes content(keyword.begin(), keyword.end());
    content.push_back(0);
    content.insert(content.end(), text.begin(), text.end());
    append_chunk(file, "tEXt", content);
}

void append_head(Bytes& file, const PngPicture& picture) {
    for (const int byte : {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a})
        file.push_back(static_cast<std::uint8_t>(byte));
    Bytes header;
    append_word(header, picture.width);
    append_word(header, picture.height);
    const int colour_type = picture.n_channels == 4 ? 6 : picture.n_channels == 3 ? 2 : 0;
    for (const int byte : {picture.bits, colour_type, 0, 0, 0})
        header.push_back(static_cast<std::uint8_t>(byte));
    append_chunk(file, "IHDR", header);
    if (picture.is_srgb)
        append_chunk(file, "sRGB", Bytes{0});
    for (const auto& [keyword, text] : picture.texts)
        append_text(file, keyword, text);
}

SCREE_MULTIVERSION void less_above(const std::uint8_t* row, const std::uint8_t* above,
                                   std::size_t n, std::uint8_t* __restrict out) {
    for (std::size_t i = 0; i < n; ++i)
        out[i] = static_cast<std::uint8_t>(row[i] - above[i]);
}

SCREE_MULTIVERSION void less_average(const std::uint8_t* row, const std::uint8_t* above,
                                     std::size_t n, std::size_t step,
                                     std::uint8_t* __restrict out) {
    for (std::size_t i = 0; i < step; ++i)
        out[i] = static_cast<std::uint8_t>(row[i] - above[i] / 2);
    for (std::size_t i = step; i < n; ++i)
        out[i] = static_cast<std::uint8_t>(row[i] - (row[i - step] + above[i]) / 2);
}

// A row as the format wants it: 16-bit samples with their high byte first. `scratch` may hold it.
const std::uint8_t* row_bytes(const PngPicture& picture, std::size_t y, std::size_t n,
                              Bytes& scratch) {
    const auto* row = static_cast<const std::uint8_t*>(picture.samples) + y * n;
    if (picture.bits == 8 || std::endian::native == std::endian::big)
        return row;
    for (std::size_t i = 0; i + 1 < n; i += 2) {
        scratch[i] = row[i + 1];
        scratch[i + 1] = row[i];
    }
    return scratch.data();
}

Buffer filtered(const PngPicture& picture) {
    constexpr std::size_t kRowsAPiece = 64;
    const auto step = static_cast<std::size_t>(picture.n_channels * picture.bits / 8);
    const std::size_t n = picture.width * step;
    Buffer lines(picture.height * (n + 1));
    parallel_for(0, picture.height, kRowsAPiece, [&](std::size_t first, std::size_t last) {
        Bytes zeros(first == 0 ? n : 0), here(n), over(n);
        const std::uint8_t* above =
            first == 0 ? zeros.data() : row_bytes(picture, first - 1, n, over);
        for (std::size_t y = first; y < last; ++y) {
            const std::uint8_t* row = row_bytes(picture, y, n, here);
            std::uint8_t* out = lines.data.get() + y * (n + 1);
            *out++ = static_cast<std::uint8_t>(picture.filter);
            if (picture.filter == PngFilter::Above)
                less_above(row, above, n, out);
            else
                less_average(row, above, n, step, out);
            std::swap(here, over);
            above = row;
        }
    });
    return lines;
}

Buffer compressed(const Buffer& lines) {
    const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
        libdeflate_alloc_compressor(kLevel));
    if (!compressor)
        throw std::bad_alloc();
    Buffer out(libdeflate_zlib_compress_bound(compressor.get(), lines.size));
    out.size = libdeflate_zlib_compress(compressor.get(), lines.data.get(), lines.size,
                                        out.data.get(), out.size);
    assert(out.size > 0);  // the bound is enough for any content
    return out;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const PngPicture& picture) {
    assert(picture.width > 0 && picture.height > 0);
    assert(picture.bits == 8 || picture.bits == 16);
    Bytes file;
    append_head(file, picture);
    const Buffer pixels = compressed(filtered(picture));
    file.reserve(file.size() + pixels.size + 64);
    for (std::size_t at = 0; at < pixels.size; at += kMostInAChunk)
        append_chunk(file, "IDAT",
                     {pixels.data.get() + at, std::min(kMostInAChunk, pixels.size - at)});
    append_chunk(file, "IEND", {});
    return file;
}

}  // namespace scree::vision
