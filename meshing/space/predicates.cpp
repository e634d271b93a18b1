// Signs of determinants in three stages: doubles with a bound on their error (after Shewchuk 1997),
// 128-bit whole numbers where the coordinates fit a common grid, as those of one place do, and
// rationals for the rest. Coordinates are floats, so no product of three differences underflows.
#include "meshing/space/predicates.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <gmpxx.h>
#include <span>

#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

__extension__ using Wide = __int128;

constexpr double kHalfUlp = 1.1102230246251565e-16;
constexpr double kBound2 = (3.0 + 16.0 * kHalfUlp) * kHalfUlp;
constexpr double kBound3 = (7.0 + 56.0 * kHalfUlp) * kHalfUlp;
constexpr int kGridBits = 39;  // determinants of three differences then stay under 2^124

// The numbers as multiples of one power of two; false if they span too many bits.
bool on_grid(std::span<const float> values, std::span<std::int64_t> whole) {
    float reach = 0.0F;
    for (const float v : values)
        reach = std::max(reach, std::abs(v));
    int exponent = 0;
    std::frexp(reach, &exponent);
    const double scale = std::ldexp(1.0, kGridBits - exponent);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double scaled = static_cast<double>(values[i]) * scale;
        whole[i] = static_cast<std::int64_t>(scaled);
        if (static_cast<double>(whole[i]) != scaled)
            return false;
    }
    return true;
}

template <class Number>
int sign_of(const Number& value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

// Negative, as the callers want it, if d lies in front.
template <class Number>
int sign_of_rows(const std::array<Number, 9>& m) {
    const Number x = m[4] * m[8] - m[5] * m[7];
    const Number y = m[5] * m[6] - m[3] * m[8];
    const Number z = m[3] * m[7] - m[4] * m[6];
    const Number det = m[0] * x + m[1] * y + m[2] * z;
    return sign_of(det);
}

int exact_orientation(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                      const glm::vec3& d) {
    const std::array<float, 12> values = {a.x, a.y, a.z, b.x, b.y, b.z,
                                          c.x, c.y, c.z, d.x, d.y, d.z};
    std::array<std::int64_t, 12> whole{};
    if (on_grid(values, whole)) {
        std::array<Wide, 9> rows{};
        for (std::size_t i = 0; i < 9; ++i)
            rows[i] = whole[i] - whole[9 + i % 3];
        return -sign_of_rows(rows);
    }
    std::array<mpq_class, 9> rows;
    for (std::size_t i = 0; i < 9; ++i)
        rows[i] = mpq_class(values[i]) - mpq_class(values[9 + i % 3]);
    return -sign_of_rows(rows);
}

int exact_orientation(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    const std::array<float, 6> values = {a.x, a.y, b.x, b.y, c.x, c.y};
    std::array<std::int64_t, 6> w{};
    if (on_grid(values, w))
        return sign_of(static_cast<Wide>(w[0] - w[4]) * (w[3] - w[5]) -
                       static_cast<Wide>(w[1] - w[5]) * (w[2] - w[4]));
    const mpq_class det = (mpq_class(a.x) - mpq_class(c.x)) * (mpq_class(b.y) - mpq_class(c.y)) -
                          (mpq_class(a.y) - mpq_class(c.y)) * (mpq_class(b.x) - mpq_class(c.x));
    return sign_of(det);
}

}  // namespace

int orientation(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    const glm::dvec3 u = glm::dvec3(a) - glm::dvec3(d);
    const glm::dvec3 v = glm::dvec3(b) - glm::dvec3(d);
    const glm::dvec3 w = glm::dvec3(c) - glm::dvec3(d);
    const double yz = v.y * w.z;
    const double zy = v.z * w.y;
    const double zx = v.z * w.x;
    const double xz = v.x * w.z;
    const double xy = v.x * w.y;
    const double yx = v.y * w.x;
    const double det = u.x * (yz - zy) + u.y * (zx - xz) + u.z * (xy - yx);
    const double bound = kBound3 * (std::abs(u.x) * (std::abs(yz) + std::abs(zy)) +
                                    std::abs(u.y) * (std::abs(zx) + std::abs(xz)) +
                                    std::abs(u.z) * (std::abs(xy) + std::abs(yx)));
    if (std::abs(det) > bound)
        return det > 0.0 ? -1 : 1;
    return bound == 0.0 ? 0 : exact_orientation(a, b, c, d);
}

int orientation(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    const glm::dvec2 u = glm::dvec2(a) - glm::dvec2(c);
    const glm::dvec2 v = glm::dvec2(b) - glm::dvec2(c);
    const double left = u.x * v.y;
    const double right = u.y * v.x;
    const double det = left - right;
    const double bound = kBound2 * (std::abs(left) + std::abs(right));
    if (std::abs(det) > bound)
        return det > 0.0 ? 1 : -1;
    return bound == 0.0 ? 0 : exact_orientation(a, b, c);
}

}  // namespace scree::meshing
