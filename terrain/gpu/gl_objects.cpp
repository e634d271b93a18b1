#include "terrain/gpu/gl_objects.h"

#include "terrain/gpu/gl_context.h"

#include <epoxy/gl.h>

namespace scree::terrain {

unsigned create_gl_object(GlKind kind, unsigned target) {
    unsigned id = 0;
    switch (kind) {
        case GlKind::Buffer:
            glCreateBuffers(1, &id);
            break;
        case GlKind::Texture:
            glCreateTextures(target, 1, &id);
            break;
        case GlKind::Framebuffer:
            glCreateFramebuffers(1, &id);
            break;
        case GlKind::Renderbuffer:
            glCreateRenderbuffers(1, &id);
            break;
        case GlKind::VertexArray:
            glCreateVertexArrays(1, &id);
            break;
    }
    return id;
}

void destroy_gl_object(GlKind kind, unsigned id) {
    switch (kind) {
        case GlKind::Buffer:
            glDeleteBuffers(1, &id);
            break;
        case GlKind::Texture:
            glDeleteTextures(1, &id);
            break;
        case GlKind::Framebuffer:
            glDeleteFramebuffers(1, &id);
            break;
        case GlKind::Renderbuffer:
            glDeleteRenderbuffers(1, &id);
            break;
        case GlKind::VertexArray:
            glDeleteVertexArrays(1, &id);
            break;
    }
}

void check_gl(const char* what) {
    const GLenum first = glGetError();
    if (first == GL_NO_ERROR)
        return;
    while (glGetError() != GL_NO_ERROR) {
    }
    if (first == GL_OUT_OF_MEMORY)
        fail<DeviceError>("the graphics device has not enough memory for ", what);
    fail<DeviceError>("OpenGL error 0x", std::hex, first, " during ", what);
}

}  // namespace scree::terrain
