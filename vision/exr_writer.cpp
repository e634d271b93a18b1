#include "vision/exr_writer.h"

#include "base/whole_file.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace scree::vision {
namespace {

static_assert(std::endian::native == std::endian::little, "OpenEXR's order of bytes");

// The parts of the format that this file uses: https://openexr.com, "File Layout".
class Bytes {
public:
    void text(std::string_view text) {
        bytes_.insert(bytes_.end(), text.begin(), text.end());
        bytes_.push_back(0);
    }
    template <class Number>
    void number(Number value) {
        const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
        bytes_.insert(bytes_.end(), first, first + sizeof value);
    }
    template <class... Numbers>
    void attribute(std::string_view name, std::string_view type, Numbers... values) {
        text(name);
        text(type);
        number(static_cast<std::int32_t>((sizeof values + ...)));
        (number(values), ...);
    }
    void text_attribute(std::string_view name, std::string_view value) {
        text(name);
        text("string");
        number(static_cast<std::int32_t>(value.size()));
        bytes_.insert(bytes_.end(), value.begin(), value.end());
    }
    void end() { bytes_.push_back(0); }

    std::size_t size() const { return bytes_.size(); }
    std::span<const std::uint8_t> all() const { return bytes_; }

private:
    std::vector<std::uint8_t> bytes_;
};

Bytes header(std::int32_t width, std::int32_t height, double metres_per_pixel) {
    constexpr std::int32_t kMagic = 20000630, kVersion = 2, kFloat = 2;
    constexpr std::uint8_t kNone = 0, kDownwards = 0;
    Bytes h;
    h.number(kMagic);
    h.number(kVersion);
    h.text_attribute("capDate", "1970:01:01 00:00:00");  // the present would give other bytes
    h.text("channels");
    h.text("chlist");
    h.number(std::int32_t{19});
    h.text("Y");
    for (const std::int32_t value : {kFloat, 0, 1, 1})  // type, linear or not, sampling in x and y
        h.number(value);
    h.end();
    h.text_attribute("comments", "heights in metres");
    h.attribute("compression", "compression", kNone);
    for (const char* window : {"dataWindow", "displayWindow"})
        h.attribute(window, "box2i", std::int32_t{0}, std::int32_t{0}, width - 1, height - 1);
    h.attribute("lineOrder", "lineOrder", kDownwards);
    h.attribute("pixelAspectRatio", "float", 1.0F);
    h.attribute("scree:metres_per_pixel", "double", metres_per_pixel);
    h.attribute("screenWindowCenter", "v2f", 0.0F, 0.0F);
    h.attribute("screenWindowWidth", "float", 1.0F);
    h.end();
    return h;
}

}  // namespace

void write_exr(const std::filesystem::path& path, const FloatRaster& channel,
               double metres_per_pixel) {
    assert(!channel.empty());
    StagedFile file(path);
    Bytes head = header(channel.width(), channel.height(), metres_per_pixel);
    const std::size_t row_size = static_cast<std::size_t>(channel.width()) * sizeof(float);
    const auto n_rows = static_cast<std::size_t>(channel.height());
    const std::size_t first = head.size() + n_rows * sizeof(std::uint64_t);
    for (std::size_t y = 0; y < n_rows; ++y)
        head.number(std::uint64_t{first + y * (2 * sizeof(std::int32_t) + row_size)});
    file.write(head.all());
    for (int y = 0; y < channel.height(); ++y) {
        Bytes row;
        row.number(y);
        row.number(static_cast<std::int32_t>(row_size));
        file.write(row.all());
        file.write({reinterpret_cast<const std::uint8_t*>(channel.row(y)), row_size});
    }
    file.close();
}

}  // namespace scree::vision
