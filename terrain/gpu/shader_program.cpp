#include "terrain/gpu/shader_program.h"

#include <algorithm>
#include <charconv>
#include <epoxy/gl.h>
#include <utility>
#include <vector>

#include <glm/gtc/type_ptr.hpp>

namespace scree::terrain {
namespace {

GLenum gl_stage(ShaderStage stage) {
    switch (stage) {
        case ShaderStage::Vertex:
            return GL_VERTEX_SHADER;
        case ShaderStage::TessControl:
            return GL_TESS_CONTROL_SHADER;
        case ShaderStage::TessEvaluation:
            return GL_TESS_EVALUATION_SHADER;
        case ShaderStage::Fragment:
            return GL_FRAGMENT_SHADER;
        case ShaderStage::Compute:
            return GL_COMPUTE_SHADER;
    }
    return GL_VERTEX_SHADER;
}

const char* stage_name(ShaderStage stage) {
    switch (stage) {
        case ShaderStage::Vertex:
            return "vertex";
        case ShaderStage::TessControl:
            return "tessellation control";
        case ShaderStage::TessEvaluation:
            return "tessellation evaluation";
        case ShaderStage::Fragment:
            return "fragment";
        case ShaderStage::Compute:
            return "compute";
    }
    return "unknown";
}

std::string first_line(std::string_view text) {
    return std::string(text.substr(0, text.find('\n')));
}

// The line number in "0:12(5): error: ..." (Mesa) or "0(12) : error C...: ..." (others); 0 if none.
int line_at_fault(std::string_view log) {
    if (log.size() < 3 || log[0] != '0' || (log[1] != ':' && log[1] != '('))
        return 0;
    int line = 0;
    std::from_chars(log.data() + 2, log.data() + log.size(), line);
    return line;
}

std::string line_of(std::string_view text, int number) {
    for (int line = 1; line < number; ++line) {
        const auto end = text.find('\n');
        if (end == std::string_view::npos)
            return {};
        text.remove_prefix(end + 1);
    }
    return first_line(text);
}

unsigned compile(std::string_view name, const ShaderSource& source) {
    const unsigned shader = glCreateShader(gl_stage(source.stage));
    const char* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    int done = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done != 0)
        return shader;
    std::vector<char> log(4096, '\0');
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size() - 1), nullptr, log.data());
    glDeleteShader(shader);
    const int line = line_at_fault(log.data());
    if (line > 0)
        fail<DeviceError>("the ", stage_name(source.stage), " shader of ", name,
                          " does not compile: ", first_line(log.data()), ", in line ", line, ": ",
                          line_of(source.text, line));
    fail<DeviceError>("the ", stage_name(source.stage), " shader of ", name,
                      " does not compile: ", first_line(log.data()));
}

}  // namespace

ShaderProgram::ShaderProgram(std::string_view name, std::initializer_list<ShaderSource> sources)
    : id_(glCreateProgram()) {
    std::vector<unsigned> shaders;
    try {
        for (const ShaderSource& source : sources) {
            shaders.push_back(compile(name, source));
            glAttachShader(id_, shaders.back());
        }
        glLinkProgram(id_);
    } catch (...) {
        for (const unsigned shader : shaders)
            glDeleteShader(shader);
        glDeleteProgram(id_);
        throw;
    }
    for (const unsigned shader : shaders)
        glDeleteShader(shader);  // freed with the program
    int done = 0;
    glGetProgramiv(id_, GL_LINK_STATUS, &done);
    if (done != 0)
        return;
    std::vector<char> log(4096, '\0');
    glGetProgramInfoLog(id_, static_cast<GLsizei>(log.size() - 1), nullptr, log.data());
    glDeleteProgram(id_);
    fail<DeviceError>("the shaders of ", name, " do not link: ", first_line(log.data()));
}

ShaderProgram::~ShaderProgram() {
    if (id_ != 0)
        glDeleteProgram(id_);
}
ShaderProgram::ShaderProgram(ShaderProgram&& other) noexcept : id_(std::exchange(other.id_, 0U)) {}
ShaderProgram& ShaderProgram::operator=(ShaderProgram&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
}

void ShaderProgram::use() const {
    glUseProgram(id_);
}

void ShaderProgram::set(const char* uniform, int value) const {
    glProgramUniform1i(id_, glGetUniformLocation(id_, uniform), value);
}
void ShaderProgram::set(const char* uniform, float value) const {
    glProgramUniform1f(id_, glGetUniformLocation(id_, uniform), value);
}
void ShaderProgram::set(const char* uniform, const glm::ivec2& value) const {
    glProgramUniform2i(id_, glGetUniformLocation(id_, uniform), value.x, value.y);
}
void ShaderProgram::set(const char* uniform, const glm::ivec4& value) const {
    glProgramUniform4i(id_, glGetUniformLocation(id_, uniform), value.x, value.y, value.z, value.w);
}
void ShaderProgram::set(const char* uniform, const glm::vec2& value) const {
    glProgramUniform2f(id_, glGetUniformLocation(id_, uniform), value.x, value.y);
}
void ShaderProgram::set(const char* uniform, const glm::vec3& value) const {
    glProgramUniform3f(id_, glGetUniformLocation(id_, uniform), value.x, value.y, value.z);
}
void ShaderProgram::set(const char* uniform, const glm::vec4& value) const {
    glProgramUniform4f(id_, glGetUniformLocation(id_, uniform), value.x, value.y, value.z, value.w);
}
void ShaderProgram::set(const char* uniform, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(id_, glGetUniformLocation(id_, uniform), 1, GL_FALSE,
                              glm::value_ptr(value));
}

}  // namespace scree::terrain
