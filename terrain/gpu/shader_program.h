#pragma once

#include "terrain/gpu/gl_context.h"

#include <initializer_list>
#include <string>
#include <string_view>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace scree::terrain {

enum class ShaderStage { Vertex, TessControl, TessEvaluation, Fragment, Compute };

/// The GLSL of one stage, `#version` line included.
struct ShaderSource {
    ShaderStage stage = ShaderStage::Vertex;
    std::string text;
};

/// A linked program of the current context.
class ShaderProgram {
public:
    ShaderProgram() = default;
    /// @throw DeviceError  a stage does not compile or they do not link: names the program, the
    ///                     stage, and the first line at fault with the driver's words.
    ShaderProgram(std::string_view name, std::initializer_list<ShaderSource> sources);
    ~ShaderProgram();
    ShaderProgram(ShaderProgram&& other) noexcept;
    ShaderProgram& operator=(ShaderProgram&& other) noexcept;

    /// Make it the program that draws and dispatches.
    void use() const;

    /// Set a uniform; one that the compiler found unused is passed over.
    void set(const char* uniform, int value) const;
    void set(const char* uniform, float value) const;
    void set(const char* uniform, const glm::ivec2& value) const;
    void set(const char* uniform, const glm::ivec4& value) const;
    void set(const char* uniform, const glm::vec2& value) const;
    void set(const char* uniform, const glm::vec3& value) const;
    void set(const char* uniform, const glm::vec4& value) const;
    void set(const char* uniform, const glm::mat4& value) const;

private:
    unsigned id_ = 0;
};

}  // namespace scree::terrain
