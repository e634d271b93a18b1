#include "meshing/space/triangle_pair.h"

#include "meshing/space/predicates.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

// The two axes along which a triangle's shadow has an area; false if it has none at all. Coplanar
// figures meet if their shadows do.
struct Shadow {
    int first = 0;
    int second = 1;
    int turn = 0;  // of the triangle's shadow

    glm::vec2 of(const glm::vec3& p) const { return {p[first], p[second]}; }
};

bool find_shadow(const TrianglePoints& t, Shadow& shadow) {
    for (int axis = 0; axis < 3; ++axis) {
        shadow = {(axis + 1) % 3, (axis + 2) % 3};
        shadow.turn = orientation(shadow.of(t[0]), shadow.of(t[1]), shadow.of(t[2]));
        if (shadow.turn != 0)
            return true;
    }
    return false;
}

bool between(float a, float b, float p) {
    return std::min(a, b) <= p && p <= std::max(a, b);
}

bool on_segment(const glm::vec2& a, const glm::vec2& b, const glm::vec2& p) {
    return orientation(a, b, p) == 0 && between(a.x, b.x, p.x) && between(a.y, b.y, p.y);
}

bool segments_meet(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c, const glm::vec2& d) {
    const int abc = orientation(a, b, c);
    const int abd = orientation(a, b, d);
    const int cda = orientation(c, d, a);
    const int cdb = orientation(c, d, b);
    if (abc * abd < 0 && cda * cdb < 0)
        return true;
    return on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b);
}

bool inside(const Shadow& shadow, const TrianglePoints& t, const glm::vec3& p) {
    for (std::size_t k = 0; k < 3; ++k)
        if (orientation(shadow.of(t[k]), shadow.of(t[(k + 1) % 3]), shadow.of(p)) * shadow.turn < 0)
            return false;
    return true;
}

bool coplanar_segment_meets(const glm::vec3& p, const glm::vec3& q, const TrianglePoints& t) {
    Shadow shadow;
    if (!find_shadow(t, shadow))
        return false;
    if (inside(shadow, t, p) || inside(shadow, t, q))
        return true;
    for (std::size_t k = 0; k < 3; ++k)
        if (segments_meet(shadow.of(p), shadow.of(q), shadow.of(t[k]), shadow.of(t[(k + 1) % 3])))
            return true;
    return false;
}

bool has_no_area(const TrianglePoints& t) {
    Shadow shadow;
    return !find_shadow(t, shadow);
}

// An edge of a's shadow has all of b on its outer side. Convex figures in a plane that share no
// point are parted by an edge of one of them.
bool parted(const Shadow& shadow, const TrianglePoints& a, int turn, const TrianglePoints& b) {
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec2 from = shadow.of(a[k]);
        const glm::vec2 to = shadow.of(a[(k + 1) % 3]);
        if (orientation(from, to, shadow.of(b[0])) * turn < 0 &&
            orientation(from, to, shadow.of(b[1])) * turn < 0 &&
            orientation(from, to, shadow.of(b[2])) * turn < 0)
            return true;
    }
    return false;
}

bool coplanar_triangles_meet(const TrianglePoints& a, const TrianglePoints& b) {
    Shadow shadow;
    if (!find_shadow(a, shadow))
        return false;
    const int turn_b = orientation(shadow.of(b[0]), shadow.of(b[1]), shadow.of(b[2]));
    return turn_b != 0 && !parted(shadow, a, shadow.turn, b) && !parted(shadow, b, turn_b, a);
}

}  // namespace

bool segment_meets_triangle(const glm::vec3& p, const glm::vec3& q, const TrianglePoints& t) {
    const int at_p = orientation(t[0], t[1], t[2], p);
    const int at_q = orientation(t[0], t[1], t[2], q);
    if (at_p == 0 && at_q == 0)
        return coplanar_segment_meets(p, q, t);
    if (at_p * at_q > 0)
        return false;
    const int s0 = orientation(p, q, t[0], t[1]);
    const int s1 = orientation(p, q, t[1], t[2]);
    const int s2 = orientation(p, q, t[2], t[0]);
    return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

bool triangles_meet(const TrianglePoints& a, const TrianglePoints& b) {
    std::array<int, 3> sides{};  // of b's corners
    for (std::size_t k = 0; k < 3; ++k)
        sides[k] = orientation(a[0], a[1], a[2], b[k]);
    if (sides[0] == sides[1] && sides[1] == sides[2])
        return sides[0] == 0 && coplanar_triangles_meet(a, b);
    if (has_no_area(a) || has_no_area(b))
        return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (segment_meets_triangle(a[k], a[(k + 1) % 3], b) ||
            segment_meets_triangle(b[k], b[(k + 1) % 3], a))
            return true;
    return false;
}

bool triangles_at_a_vertex_meet(const TrianglePoints& a, const TrianglePoints& b) {
    if (has_no_area(a) || has_no_area(b))
        return false;
    return segment_meets_triangle(a[1], a[2], b) || segment_meets_triangle(b[1], b[2], a);
}

bool triangles_at_an_edge_fold(const TrianglePoints& a, const TrianglePoints& b) {
    Shadow shadow;
    if (orientation(a[0], a[1], a[2], b[2]) != 0 || !find_shadow(a, shadow))
        return false;
    return orientation(shadow.of(a[0]), shadow.of(a[1]), shadow.of(b[2])) == shadow.turn;
}

}  // namespace scree::meshing
