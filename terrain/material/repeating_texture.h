#pragma once

#include "base/raster.h"

#include <glm/vec3.hpp>

namespace scree::terrain {

/// A texture that repeats over the ground, ready to be read at one size of pixel.
template <class Value>
class RepeatingTexture {
public:
    RepeatingTexture() = default;
    /// @param size_m   Edge of ground that one repetition covers, metres.
    /// @param pixel_m  Edge of the pixels that will be asked for: finer texels are averaged first.
    RepeatingTexture(const Raster<Value>& texels, double size_m, double pixel_m);

    bool empty() const { return texels_.empty(); }
    /// Bilinear between texel centres, at a place on the ground in metres.
    Value at(double x, double z) const;

private:
    Raster<Value> texels_;
    double size_m_ = 1.0;
};

extern template class RepeatingTexture<float>;
extern template class RepeatingTexture<glm::vec3>;

/// Linear light of sRGB colours, and back.
Raster<glm::vec3> linear_light(const Photo& photo);
glm::u8vec3 srgb_colour(glm::vec3 light);

/// Unit vectors of a normal texture, and back.
Raster<glm::vec3> unit_normals(const Photo& photo);
glm::u8vec3 normal_colour(glm::vec3 normal);

}  // namespace scree::terrain
