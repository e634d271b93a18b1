#include "terrain/surface/erosion_ground.h"

#include "base/error.h"
#include "meshing/mesh/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace scree::terrain {
namespace {

using meshing::TriMesh;

constexpr double kMostTriangles = 2e6;
constexpr double kUprightness = 0.02;  // a canyon's wall leans back by so much of its height

double swing_at(const GroundOptions& o, double x) {
    return o.shape == GroundShape::Bend ? o.swing * std::sin(2.0 * std::numbers::pi * x / o.length)
                                        : 0.0;
}

double bank_width(const GroundOptions& o) {
    return o.shape == GroundShape::Bend ? o.bank_width : kUprightness * o.bed_depth;
}

// Half a cross-section from the middle of the bed outwards: (across, height above the bed).
std::vector<glm::dvec2> corners_of_section(const GroundOptions& o, double half_width) {
    if (o.shape == GroundShape::Slope)
        return {{0.0, 0.0}, {half_width, 0.0}};
    const double foot = 0.5 * o.bed_width;
    const double top = foot + bank_width(o);
    return {{0.0, 0.0}, {foot, 0.0}, {top, o.bed_depth}, {half_width, o.bed_depth}};
}

// How many edges each leg of the section is divided into; the same all along the bed.
std::vector<unsigned> edges_of_legs(const std::vector<glm::dvec2>& corners, double edge) {
    std::vector<unsigned> counts;
    for (std::size_t i = 1; i < corners.size(); ++i)
        counts.push_back(static_cast<unsigned>(
            std::max(1.0, std::round(glm::distance(corners[i - 1], corners[i]) / edge))));
    return counts;
}

std::vector<glm::dvec2> half_section(const std::vector<glm::dvec2>& corners,
                                     const std::vector<unsigned>& counts) {
    std::vector<glm::dvec2> places = {corners[0]};
    for (std::size_t i = 0; i < counts.size(); ++i)
        for (unsigned k = 1; k <= counts[i]; ++k)
            places.push_back(
                glm::mix(corners[i], corners[i + 1], static_cast<double>(k) / counts[i]));
    return places;
}

void check_ground(const GroundOptions& o) {
    check(o);
    double triangles = 0.0;
    if (o.shape == GroundShape::Block) {
        const double n = std::max(1.0, std::round(o.width / o.edge));
        triangles = 12.0 * n * n;
    } else {
        triangles =
            2.0 * (o.length / o.edge + 1.0) * ((o.width + 2.0 * o.bed_depth) / o.edge + 8.0);
    }
    if (triangles > kMostTriangles)
        fail<InvalidInput>("the ground would have about ", triangles, " triangles, at most ",
                           kMostTriangles, " are allowed; take longer edges");
    if (o.shape == GroundShape::Slope || o.shape == GroundShape::Block)
        return;
    const double half =
        0.5 * o.bed_width + bank_width(o) + (o.shape == GroundShape::Bend ? o.swing : 0.0);
    if (half + o.edge > 0.5 * o.width)
        fail<InvalidInput>("bed, banks and swing need ", 2.0 * (half + o.edge),
                           " m of width, the ground has ", o.width, " m; make it wider");
}

TriMesh make_sheet(const GroundOptions& o) {
    const auto n_along = static_cast<unsigned>(std::max(1.0, std::round(o.length / o.edge)));
    const std::vector<unsigned> counts =
        edges_of_legs(corners_of_section(o, 0.5 * o.width), o.edge);
    TriMesh mesh;
    unsigned n_across = 0;
    for (unsigned i = 0; i <= n_along; ++i) {
        const double x = (static_cast<double>(i) / n_along - 0.5) * o.length;
        const glm::vec3 bed = bed_at(o, x);
        const double shift = static_cast<double>(bed.z);
        const auto left = half_section(corners_of_section(o, 0.5 * o.width + shift), counts);
        const auto right = half_section(corners_of_section(o, 0.5 * o.width - shift), counts);
        const auto put = [&](double across, double height) {
            mesh.positions.emplace_back(x, static_cast<double>(bed.y) + height, shift + across);
        };
        for (std::size_t k = left.size(); k-- > 1;)
            put(-left[k].x, left[k].y);
        for (const glm::dvec2& place : right)
            put(place.x, place.y);
        n_across = static_cast<unsigned>(left.size() + right.size() - 1);
    }
    for (unsigned i = 0; i < n_along; ++i)
        for (unsigned k = 0; k + 1 < n_across; ++k) {
            const unsigned a = i * n_across + k, b = a + 1, c = a + n_across, d = c + 1;
            // x to c, z to b: up is z cross x. Diagonals alternate, so that none leads.
            if ((i + k) % 2 == 0) {
                mesh.triangles.emplace_back(a, b, d);
                mesh.triangles.emplace_back(a, d, c);
            } else {
                mesh.triangles.emplace_back(a, b, c);
                mesh.triangles.emplace_back(b, d, c);
            }
        }
    return mesh;
}

// Six faces that share their edges' vertices.
TriMesh make_block(const GroundOptions& o) {
    const auto n = static_cast<unsigned>(std::max(1.0, std::round(o.width / o.edge)));
    const auto size = static_cast<float>(o.width);
    TriMesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (int end = 0; end < 2; ++end) {
            const auto base = static_cast<unsigned>(mesh.positions.size());
            for (unsigned j = 0; j <= n; ++j)
                for (unsigned i = 0; i <= n; ++i) {
                    std::array<unsigned, 3> at{};
                    const auto k = static_cast<std::size_t>(axis);
                    at[k] = end == 1 ? n : 0;
                    at[(k + 1) % 3] = end == 1 ? i : j;
                    at[(k + 2) % 3] = end == 1 ? j : i;
                    const glm::vec3 unit = glm::vec3(at[0], at[1], at[2]) / static_cast<float>(n);
                    mesh.positions.push_back((unit - glm::vec3(0.5F, 0.0F, 0.5F)) * size);
                }
            for (unsigned j = 0; j < n; ++j)
                for (unsigned i = 0; i < n; ++i) {
                    const unsigned a = base + j * (n + 1) + i, b = a + 1;
                    const unsigned c = a + n + 1, d = c + 1;
                    if ((i + j) % 2 == 0) {
                        mesh.triangles.emplace_back(a, b, d);
                        mesh.triangles.emplace_back(a, d, c);
                    } else {
                        mesh.triangles.emplace_back(a, b, c);
                        mesh.triangles.emplace_back(b, d, c);
                    }
                }
        }
    return meshing::weld(mesh);
}

}  // namespace

glm::vec3 bed_at(const GroundOptions& o, double x) {
    const double height = (0.5 * o.length - x) * o.fall;
    return {static_cast<float>(x), static_cast<float>(height), static_cast<float>(swing_at(o, x))};
}

TriMesh make_ground(const GroundOptions& options) {
    check_ground(options);
    return options.shape == GroundShape::Block ? make_block(options) : make_sheet(options);
}

}  // namespace scree::terrain
