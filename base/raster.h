#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree {

/// A rectangle of values, row by row without padding; row 0 is the top of a picture.
///
/// Pixel (x, y) covers [x, x+1) x [y, y+1); its centre lies at (x + 0.5, y + 0.5).
template <class T>
class Raster {
public:
    Raster() = default;
    Raster(int width, int height, const T& value = T{})
        : width_(width),
          height_(height),
          values_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {
        assert(width >= 0 && height >= 0);
    }

    int width() const { return width_; }
    int height() const { return height_; }
    bool empty() const { return values_.empty(); }
    std::size_t size() const { return values_.size(); }
    bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

    T& operator()(int x, int y) { return values_[index(x, y)]; }
    const T& operator()(int x, int y) const { return values_[index(x, y)]; }

    T* row(int y) { return values_.data() + index(0, y); }
    const T* row(int y) const { return values_.data() + index(0, y); }
    T* data() { return values_.data(); }
    const T* data() const { return values_.data(); }
    auto begin() { return values_.begin(); }
    auto end() { return values_.end(); }
    auto begin() const { return values_.begin(); }
    auto end() const { return values_.end(); }

    bool operator==(const Raster&) const = default;

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    int width_ = 0;
    int height_ = 0;
    std::vector<T> values_;
};

using Mask = Raster<std::uint8_t>;       ///< 0 is off, anything else is on.
using FloatRaster = Raster<float>;       ///< One channel; the unit is said where it is used.
using LabelMap = Raster<std::uint16_t>;  ///< 0 is background, any other value one rock.
using Photo = Raster<glm::u8vec3>;       ///< sRGB-coded colours as the camera stored them.

}  // namespace scree
