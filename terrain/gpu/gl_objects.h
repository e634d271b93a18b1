#pragma once

#include <utility>

namespace scree::terrain {

enum class GlKind { Buffer, Texture, Framebuffer, Renderbuffer, VertexArray };

/// The name of a new object of a kind in the current context. `target` (an OpenGL enumerator) is
/// read for textures alone.
unsigned create_gl_object(GlKind kind, unsigned target);
void destroy_gl_object(GlKind kind, unsigned id);

/// An object that the current context owns; gone with its owner, whose context must be current.
template <GlKind kind>
class GlObject {
public:
    GlObject() = default;
    explicit GlObject(unsigned target) : id_(create_gl_object(kind, target)) {}
    ~GlObject() { reset(); }
    GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0U)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        if (this != &other) {
            reset();
            id_ = std::exchange(other.id_, 0U);
        }
        return *this;
    }

    unsigned id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }
    void reset() {
        if (id_ != 0)
            destroy_gl_object(kind, std::exchange(id_, 0U));
    }

private:
    unsigned id_ = 0;
};

using GlBuffer = GlObject<GlKind::Buffer>;
using GlTexture = GlObject<GlKind::Texture>;
using GlFramebuffer = GlObject<GlKind::Framebuffer>;
using GlRenderbuffer = GlObject<GlKind::Renderbuffer>;
using GlVertexArray = GlObject<GlKind::VertexArray>;

/// Throw DeviceError if the current context has met an error; `what` says during which work.
void check_gl(const char* what);

}  // namespace scree::terrain
