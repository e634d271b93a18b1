#pragma once

#include "base/raster.h"
#include "terrain/gpu/gl_objects.h"
#include "terrain/gpu/shader_program.h"

namespace scree::terrain {

/// A picture that is drawn with several samples to a pixel, then read.
class PictureTarget {
public:
    /// @param supersampling  Samples along each side of a pixel.
    /// @throw InvalidInput  the samples are more than a texture of the device holds.
    PictureTarget(const GlContext& context, int width, int height, int supersampling);

    /// Draw to the depth alone, and clear it.
    void bind_depth() const;
    /// Draw to the colours alone; the depth may be read as a texture.
    void bind_colours() const;
    /// Draw to both.
    void bind_both() const;
    unsigned depth_texture() const { return depth_.id(); }
    int samples_across() const { return width_ * along_; }
    int samples_down() const { return height_ * along_; }

    /// Average the samples and read the picture.
    Photo read() const;

private:
    void bind(const GlFramebuffer& buffer) const;

    int width_, height_, along_;
    GlTexture colours_, depth_;
    GlRenderbuffer resolved_;
    GlFramebuffer depth_only_, colours_only_, both_, pixels_;
    GlVertexArray no_corners_;
    ShaderProgram resolve_;
};

}  // namespace scree::terrain
