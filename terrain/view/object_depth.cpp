#include "terrain/view/object_depth.h"

#include <epoxy/gl.h>

namespace scree::terrain {

DepthMap::DepthMap(int side, bool compare) : side_(side), depth_(GL_TEXTURE_2D), target_(0U) {
    const GLint filter = compare ? GL_LINEAR : GL_NEAREST;
    glTextureStorage2D(depth_.id(), 1, GL_DEPTH_COMPONENT32F, side, side);
    glTextureParameteri(depth_.id(), GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(depth_.id(), GL_TEXTURE_MAG_FILTER, filter);
    glTextureParameteri(depth_.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(depth_.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    if (compare) {
        glTextureParameteri(depth_.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glTextureParameteri(depth_.id(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
    glNamedFramebufferTexture(target_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
    glNamedFramebufferDrawBuffer(target_.id(), GL_NONE);
}

void DepthMap::fill(const std::function<void()>& draw) const {
    glBindFramebuffer(GL_FRAMEBUFFER, target_.id());
    glViewport(0, 0, side_, side_);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LEQUAL);
    const float far = 1.0F;
    glClearNamedFramebufferfv(target_.id(), GL_DEPTH, 0, &far);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(2.0F, 4.0F);
    draw();
    glDisable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace scree::terrain
