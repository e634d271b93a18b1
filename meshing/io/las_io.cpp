#include "meshing/io/mesh_codecs.h"

#include <array>
#include <bit>
#include <cmath>
#include <concepts>

namespace scree::meshing::io {
namespace {

// Places in the header, as the LAS specification 1.4 R15 has them; older ones hold a part of it.
constexpr std::size_t kVersionAt = 24;
constexpr std::size_t kHeaderSizeAt = 94;
constexpr std::size_t kDataAt = 96;
constexpr std::size_t kFormatAt = 104;
constexpr std::size_t kRecordSizeAt = 105;
constexpr std::size_t kOldCountAt = 107;
constexpr std::size_t kScaleAt = 131;
constexpr std::size_t kOffsetAt = 155;
constexpr std::size_t kCountAt = 247;
constexpr std::size_t kLeastHeader = 227;
constexpr std::size_t kLeastHeader14 = 375;

// Bytes of a point in each format.
constexpr std::array<std::size_t, 11> kPointSizes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

class LasReader {
public:
    explicit LasReader(const Source& source) : source_(source) {}

    PointCloud read() {
        read_header();
        PointCloud cloud;
        cloud.points.reserve(count_);
        cloud.classes.reserve(count_);
        for (std::size_t i = 0; i < count_; ++i)
            read_point(first_ + i * record_size_, cloud);
        if (cloud.points.empty())
            source_.refuse("it holds no point");
        return cloud;
    }

private:
    // A little-endian number; the caller has seen that it is there.
    template <std::unsigned_integral Number>
    Number whole(std::size_t at) const {
        Number value = 0;
        for (std::size_t k = sizeof(Number); k-- > 0;)
            value = static_cast<Number>((std::uint64_t{value} << 8U) |
                                        static_cast<std::uint8_t>(source_.bytes[at + k]));
        return value;
    }
    double real(std::size_t at) const { return std::bit_cast<double>(whole<std::uint64_t>(at)); }

    void read_header() {
        const std::string_view bytes = source_.bytes;
        if (bytes.size() < kLeastHeader || !bytes.starts_with("LASF"))
            source_.refuse("it does not begin with the header of a LAS file");
        const unsigned major = whole<std::uint8_t>(kVersionAt);
        const unsigned minor = whole<std::uint8_t>(kVersionAt + 1);
        if (major != 1 || minor > 4)
            source_.refuse("it is LAS ", major, ".", minor, ", versions 1.0 to 1.4 are read");
        const std::size_t least = minor == 4 ? kLeastHeader14 : kLeastHeader;
        const std::size_t header_size = whole<std::uint16_t>(kHeaderSizeAt);
        first_ = whole<std::uint32_t>(kDataAt);
        if (header_size < least || first_ < header_size || first_ > bytes.size())
            source_.refuse("its header has ", header_size, " bytes and its points begin at byte ",
                           first_, " of ", bytes.size());
        read_format();
        const std::uint64_t old_count = whole<std::uint32_t>(kOldCountAt);
        read_count(minor == 4 ? whole<std::uint64_t>(kCountAt) : old_count);
        for (std::size_t k = 0; k < 3; ++k) {
            scale_[k] = real(kScaleAt + 8 * k);
            offset_[k] = real(kOffsetAt + 8 * k);
            if (!std::isfinite(scale_[k]) || !std::isfinite(offset_[k]) || scale_[k] == 0.0)
                source_.refuse("it scales its places by ", scale_[k], " and moves them by ",
                               offset_[k]);
        }
    }

    void read_format() {
        const unsigned format = whole<std::uint8_t>(kFormatAt);
        record_size_ = whole<std::uint16_t>(kRecordSizeAt);
        if ((format & 0xC0U) != 0)
            source_.refuse("its points are compressed (LAZ); write it as LAS first");
        if (format >= kPointSizes.size())
            source_.refuse("its points have format ", format, ", 0 to 10 are read");
        if (record_size_ < kPointSizes[format])
            source_.refuse("a point has ", record_size_, " bytes, format ", format, " needs ",
                           kPointSizes[format]);
        modern_ = format >= 6;
    }

    // A declared count that the bytes cannot hold costs nothing.
    void read_count(std::uint64_t count) {
        if (count > (source_.bytes.size() - first_) / record_size_)
            source_.refuse("it declares ", count, " points, more than its bytes can hold");
        if (count > source_.limits.max_vertices)
            source_.refuse("it declares ", count, " points, at most ", source_.limits.max_vertices,
                           " are read");
        count_ = static_cast<std::size_t>(count);
    }

    void read_point(std::size_t at, PointCloud& cloud) const {
        // Class and flags share a byte up to format 5 and have one each from 6 on.
        const unsigned klass = whole<std::uint8_t>(at + (modern_ ? 16 : 15));
        const unsigned flags = modern_ ? whole<std::uint8_t>(at + 15) & 0x0FU : klass >> 5U;
        constexpr unsigned kWithheld = 4;
        if ((flags & kWithheld) != 0)
            return;
        glm::dvec3 p;
        for (int k = 0; k < 3; ++k) {
            const std::size_t axis = static_cast<std::size_t>(k);
            const auto steps = std::bit_cast<std::int32_t>(whole<std::uint32_t>(at + 4 * axis));
            p[k] = steps * scale_[axis] + offset_[axis];
        }
        const glm::vec3 as_float(p);
        if (!std::isfinite(as_float.x) || !std::isfinite(as_float.y) || !std::isfinite(as_float.z))
            source_.refuse("point ", cloud.points.size(), " is no place that floats can hold");
        cloud.points.push_back(p);
        cloud.classes.push_back(static_cast<std::uint8_t>(modern_ ? klass : klass & 0x1FU));
    }

    const Source& source_;
    std::size_t first_ = 0;  // byte of the first point
    std::size_t record_size_ = 0;
    std::size_t count_ = 0;
    bool modern_ = false;
    std::array<double, 3> scale_{};
    std::array<double, 3> offset_{};
};

}  // namespace

PointCloud decode_las(const Source& source) {
    return LasReader(source).read();
}

}  // namespace scree::meshing::io
