#pragma once

#include "terrain/gpu/gl_objects.h"

#include <functional>

#include <glm/mat4x4.hpp>

namespace scree::terrain {

/// A depth picture that is drawn in one pass and looked up in another.
class DepthMap {
public:
    /// @param compare  Look-ups compare with a depth instead of giving it.
    DepthMap(int side, bool compare);

    /// Clear it and call `draw` with it as what is drawn to.
    void fill(const std::function<void()>& draw) const;
    int size() const { return side_; }
    unsigned texture() const { return depth_.id(); }

private:
    int side_;
    GlTexture depth_;
    GlFramebuffer target_;
};

}  // namespace scree::terrain
