#pragma once

#include "terrain/gpu/gl_objects.h"
#include "terrain/gpu/shader_program.h"
#include "terrain/view/terrain_frame.h"
#include "terrain/view/view_matrices.h"

#include <string>
#include <vector>

#include <glm/vec4.hpp>

namespace scree::terrain {

/// The rocks of a ground on the device, drawn where they are near (`rocks-and-deformer.md` C.12).
class NearRocks {
public:
    /// @throw InvalidInput  a mesh is broken, a place names none or holds a number that is none.
    explicit NearRocks(const GroundRocks& rocks);

    bool empty() const { return places_.empty(); }
    /// Bounds of what lies within r1 of the eye, y from the ground below; empty (low above high)
    /// where nothing does.
    ViewBox bounds(const glm::vec3& eye, float near_m) const;
    /// Draw what lies within r1 of the eye; the program has its uniforms but `first_place`.
    void draw(const ShaderProgram& program, const glm::vec3& eye, float near_m);

private:
    struct Place {
        glm::mat4 ground_from_rock{1.0F};
        glm::vec4 reach{0.0F};  // x: of the rock above the ground, y: from its centre aside, metres
    };
    struct Part {
        int first = 0, count = 0;  // corners
    };

    static bool is_near(const Place& place, const glm::vec3& eye, float near_m);

    std::vector<Part> meshes_;
    std::vector<std::size_t> mesh_of_;  // by place; places stand in the order of their meshes
    std::vector<Place> places_;
    GlVertexArray array_;
    GlBuffer corners_, shown_;
};

std::string near_rock_vertex_glsl();

}  // namespace scree::terrain
