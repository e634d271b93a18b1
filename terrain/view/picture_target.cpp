#include "terrain/view/picture_target.h"

#include "terrain/gpu/gl_context.h"
#include "terrain/view/view_shaders.h"

#include <algorithm>
#include <cstdint>
#include <epoxy/gl.h>
#include <vector>

#include <glm/vec4.hpp>

namespace scree::terrain {
namespace {

void check_complete(const GlFramebuffer& buffer) {
    const GLenum status = glCheckNamedFramebufferStatus(buffer.id(), GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        fail<DeviceError>("the graphics device cannot draw to the picture (status 0x", std::hex,
                          status, ")");
}

}  // namespace

PictureTarget::PictureTarget(const GlContext& context, int width, int height, int supersampling)
    : width_(width),
      height_(height),
      along_(supersampling),
      colours_(GL_TEXTURE_2D),
      depth_(GL_TEXTURE_2D),
      resolved_(0U),
      depth_only_(0U),
      colours_only_(0U),
      both_(0U),
      pixels_(0U),
      no_corners_(0U),
      resolve_("the picture", {{ShaderStage::Vertex, screen_vertex_glsl()},
                               {ShaderStage::Fragment, resolve_fragment_glsl()}}) {
    if (std::max(samples_across(), samples_down()) > context.max_texture_size())
        fail<InvalidInput>("a picture of ", width, " x ", height, " pixels with ", supersampling,
                           " samples along each side is wider than ", context.device(), " draws (",
                           context.max_texture_size(), ")");
    glTextureStorage2D(colours_.id(), 1, GL_SRGB8_ALPHA8, samples_across(), samples_down());
    glTextureStorage2D(depth_.id(), 1, GL_DEPTH_COMPONENT32F, samples_across(), samples_down());
    for (const GlTexture* texture : {&colours_, &depth_}) {
        glTextureParameteri(texture->id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(texture->id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    glNamedRenderbufferStorage(resolved_.id(), GL_SRGB8_ALPHA8, width, height);
    glNamedFramebufferTexture(depth_only_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
    glNamedFramebufferDrawBuffer(depth_only_.id(), GL_NONE);
    glNamedFramebufferTexture(colours_only_.id(), GL_COLOR_ATTACHMENT0, colours_.id(), 0);
    glNamedFramebufferTexture(both_.id(), GL_COLOR_ATTACHMENT0, colours_.id(), 0);
    glNamedFramebufferTexture(both_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
    glNamedFramebufferRenderbuffer(pixels_.id(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                   resolved_.id());
    check_gl("making the picture");
    for (const GlFramebuffer* buffer : {&depth_only_, &colours_only_, &both_, &pixels_})
        check_complete(*buffer);
}

void PictureTarget::bind(const GlFramebuffer& buffer) const {
    glBindFramebuffer(GL_FRAMEBUFFER, buffer.id());
    glViewport(0, 0, samples_across(), samples_down());
    glEnable(GL_FRAMEBUFFER_SRGB);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
}

void PictureTarget::bind_depth() const {
    bind(depth_only_);
    glEnable(GL_DEPTH_TEST);
    const float far = 1.0F;
    glClearNamedFramebufferfv(depth_only_.id(), GL_DEPTH, 0, &far);
}

void PictureTarget::bind_colours() const {
    bind(colours_only_);
    glDisable(GL_DEPTH_TEST);
}

void PictureTarget::bind_both() const {
    bind(both_);
    glEnable(GL_DEPTH_TEST);
}

Photo PictureTarget::read() const {
    bind(pixels_);
    glDisable(GL_DEPTH_TEST);
    glViewport(0, 0, width_, height_);
    glBindTextureUnit(0, colours_.id());
    resolve_.set("along", along_);
    resolve_.use();
    glBindVertexArray(no_corners_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<glm::tvec4<std::uint8_t>> bytes(static_cast<std::size_t>(width_) *
                                                static_cast<std::size_t>(height_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, pixels_.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    check_gl("reading the picture");
    Photo picture(width_, height_);
    for (int y = 0; y < height_; ++y)  // the device's row 0 is the lowest
        for (int x = 0; x < width_; ++x)
            picture(x, y) = glm::u8vec3(
                bytes[static_cast<std::size_t>(height_ - 1 - y) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(x)]);
    return picture;
}

}  // namespace scree::terrain
