// Mean curvature of a surface of second order through a vertex, fitted by weighted least squares
// to two rings of neighbours in the frame of the vertex normal:
//   z = d x + e y + (L x^2 + 2 M x y + N y^2) / 2,
//   H = -((1 + e^2) L - 2 d e M + (1 + d^2) N) / (2 (1 + d^2 + e^2)^(3/2)),
// positive where the surface falls away from its normal.
#include "base/parallel.h"
#include "meshing/curvature/estimators.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace scree::meshing::curvature {
namespace {

constexpr std::size_t kMaxPoints = 48;  // two rings have 18 points on an even mesh
constexpr std::size_t kSlots = 128;
constexpr std::uint32_t kFree = 0xFFFFFFFFU;
// Weight 1 / (r^2 + kSoftness s^2), s the root mean square distance: near points count more, very
// near ones do not drown the others.
constexpr double kSoftness = 0.1;

// Distinct vertices around one, found again by hashing.
class Patch {
public:
    explicit Patch(std::uint32_t centre) : centre_(centre) { slots_.fill(kFree); }

    void add(std::uint32_t vertex) {
        if (vertex == centre_ || size_ == kMaxPoints)
            return;
        std::size_t slot = (vertex * 0x9E3779B1U) >> 25;
        while (slots_[slot] != kFree) {
            if (slots_[slot] == vertex)
                return;
            slot = (slot + 1) % kSlots;
        }
        slots_[slot] = vertex;
        points_[size_++] = vertex;
    }

    std::size_t size() const { return size_; }
    std::uint32_t operator[](std::size_t i) const { return points_[i]; }

private:
    std::array<std::uint32_t, kSlots> slots_;
    std::array<std::uint32_t, kMaxPoints> points_;
    std::size_t size_ = 0;
    std::uint32_t centre_;
};

// Both rings; of a very large first ring a part that is spread evenly.
void collect(const Adjacency& adjacency, std::uint32_t vertex, Patch& patch) {
    const auto ring = adjacency.neighbours_of(vertex);
    const std::size_t n = std::min(ring.size(), kMaxPoints);
    for (std::size_t i = 0; i < n; ++i)
        patch.add(ring[i * ring.size() / n]);
    const std::size_t n_first = patch.size();
    for (std::size_t i = 0; i < n_first && patch.size() < kMaxPoints; ++i)
        for (const std::uint32_t other : adjacency.neighbours_of(patch[i]))
            patch.add(other);
}

using Matrix = std::array<std::array<double, 5>, 5>;
using Vector = std::array<double, 5>;

// LDL^T of the lower triangle in place; false if it is not positive definite to rounding.
bool solve(Matrix& m, Vector& r) {
    constexpr std::size_t n = 5;
    for (std::size_t j = 0; j < n; ++j) {
        const double before = m[j][j];
        for (std::size_t k = 0; k < j; ++k)
            m[j][j] -= m[j][k] * m[j][k] * m[k][k];
        if (!(m[j][j] > 1e-9 * before))
            return false;
        const double inverse = 1.0 / m[j][j];
        for (std::size_t i = j + 1; i < n; ++i) {
            for (std::size_t k = 0; k < j; ++k)
                m[i][j] -= m[i][k] * m[j][k] * m[k][k];
            m[i][j] *= inverse;
        }
    }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < i; ++k)
            r[i] -= m[i][k] * r[k];
    for (std::size_t i = n; i-- > 0;) {
        r[i] /= m[i][i];
        for (std::size_t k = i + 1; k < n; ++k)
            r[i] -= m[k][i] * r[k];
    }
    return true;
}

// Sums over the points of weight x^i y^j and of weight z x^i y^j.
struct Moments {
    double xx = 0, xy = 0, yy = 0;
    double xxx = 0, xxy = 0, xyy = 0, yyy = 0;
    double xxxx = 0, xxxy = 0, xxyy = 0, xyyy = 0, yyyy = 0;
    double zx = 0, zy = 0, zxx = 0, zxy = 0, zyy = 0;

    void add(double x, double y, double z, double weight) {
        const double x2 = x * x;
        const double x1y1 = x * y;
        const double y2 = y * y;
        const double wx2 = weight * x2;
        const double wxy = weight * x1y1;
        const double wy2 = weight * y2;
        xx += wx2;
        xy += wxy;
        yy += wy2;
        xxx += wx2 * x;
        xxy += wx2 * y;
        xyy += wy2 * x;
        yyy += wy2 * y;
        xxxx += wx2 * x2;
        xxxy += wx2 * x1y1;
        xxyy += wx2 * y2;
        xyyy += wy2 * x1y1;
        yyyy += wy2 * y2;
        zx += weight * x * z;
        zy += weight * y * z;
        zxx += wx2 * z;
        zxy += wxy * z;
        zyy += wy2 * z;
    }

    // Of z = r0 x + r1 y + r2 x^2 + r3 x y + r4 y^2.
    bool fit(Vector& r) const {
        Matrix m = {{{xx, 0, 0, 0, 0},
                     {xy, yy, 0, 0, 0},
                     {xxx, xxy, xxxx, 0, 0},
                     {xxy, xyy, xxxy, xxyy, 0},
                     {xyy, yyy, xxyy, xyyy, yyyy}}};
        r = {zx, zy, zxx, zxy, zyy};
        return solve(m, r);
    }
};

// Two unit vectors that span the plane across a unit vector (Duff et al. 2017).
std::array<glm::dvec3, 2> frame_across(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    return {glm::dvec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            glm::dvec3(b, sign + n.y * n.y * a, -n.y)};
}

// False where the points do not determine a quadric.
bool fit_vertex(const Surface& surface, std::uint32_t v, double& curvature) {
    Patch patch(v);
    collect(surface.adjacency, v, patch);
    const glm::dvec3 normal(surface.normals[v]);
    if (patch.size() < 5 || normal == glm::dvec3(0.0))
        return false;
    const glm::dvec3 here(surface.mesh.positions[v]);
    const auto [across, along] = frame_across(normal);
    std::array<double, kMaxPoints> x{}, y{}, z{};
    double sum = 0.0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(surface.mesh.positions[patch[i]]) - here;
        x[i] = glm::dot(d, across);
        y[i] = glm::dot(d, along);
        z[i] = glm::dot(d, normal);
        sum += x[i] * x[i] + y[i] * y[i];
    }
    if (!(sum > 0.0))
        return false;
    const double unit = std::sqrt(static_cast<double>(patch.size()) / sum);
    Moments moments;
    for (std::size_t i = 0; i < patch.size(); ++i) {
        const double px = x[i] * unit;
        const double py = y[i] * unit;
        moments.add(px, py, z[i] * unit, 1.0 / (px * px + py * py + kSoftness));
    }
    Vector r{};
    if (!moments.fit(r))
        return false;
    const double d2 = r[0] * r[0];
    const double e2 = r[1] * r[1];
    const double g = 1.0 + d2 + e2;
    curvature =
        -unit * ((1.0 + e2) * r[2] - r[0] * r[1] * r[3] + (1.0 + d2) * r[4]) / (g * std::sqrt(g));
    return std::isfinite(curvature);
}

}  // namespace

void estimate_by_quadric(const Surface& surface, std::span<float> curvature) {
    parallel_for_each_index(0, curvature.size(), kGrain / 4, [&](std::size_t v) {
        double fitted = 0.0;
        curvature[v] = fit_vertex(surface, static_cast<std::uint32_t>(v), fitted)
                           ? static_cast<float>(fitted)
                           : cotangent_curvature(surface, v);
    });
}

}  // namespace scree::meshing::curvature
