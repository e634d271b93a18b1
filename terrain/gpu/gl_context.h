#pragma once

#include "base/error.h"

#include <memory>
#include <string>

namespace scree::terrain {

/// The graphics device is missing, or it refused what it was asked for.
class DeviceError : public Error {
    using Error::Error;
};

struct GlContextOptions {
    bool software = false;  ///< Only a device that draws on the processor (Mesa's llvmpipe).
};

/// An OpenGL 4.5 core context without a window, by EGL.
///
/// Threads: a context belongs to the thread that made it. Everything that takes a context is
/// called, and destroyed, on that thread alone; several contexts may live on one thread, each call
/// makes its own current. Contexts on different threads do not disturb each other.
class GlContext {
public:
    struct Attempt;

    /// The best device there is: hardware first, then software. Never throws for lack of one: the
    /// reason, with the packages that help, stands in the attempt.
    static Attempt try_make(const GlContextOptions& options = {});
    /// @throw DeviceError  there is none; the message is the attempt's reason.
    static std::unique_ptr<GlContext> make(const GlContextOptions& options = {});

    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// Make it the thread's current context.
    void make_current() const;

    /// The device's name as the driver gives it, such as "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& device() const;
    /// It draws on the processor.
    bool is_software() const;
    /// Longest side of a texture, texels.
    int max_texture_size() const;
    /// Most layers of a texture array.
    int max_texture_layers() const;

private:
    struct State;
    explicit GlContext(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// What came of looking for a device.
struct GlContext::Attempt {
    std::unique_ptr<GlContext> context;  ///< Null where there is none...
    std::string reason;                  ///< ...and why, in one sentence with the remedy.
};

}  // namespace scree::terrain
