#include "terrain/prepare/ground_lattice.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/mesh/cleaning.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree::terrain {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Vertices in the order of the lattice; kNone where nothing is known.
constexpr std::uint32_t kNone = 0xFFFFFFFFU;

// The triangles of a cell from its known corners, counter-clockwise seen from above: near left,
// far left, far right, near right (z grows towards the far side). Diagonals alternate, so no
// direction is favoured.
void add_cell(const std::uint32_t (&corner)[4], bool other_way,
              std::vector<glm::uvec3>& triangles) {
    const auto add = [&](int a, int b, int c) {
        if (corner[a] != kNone && corner[b] != kNone && corner[c] != kNone)
            triangles.emplace_back(corner[a], corner[b], corner[c]);
    };
    const bool no_02 = corner[0] == kNone || corner[2] == kNone;
    const bool no_13 = corner[1] == kNone || corner[3] == kNone;
    if (no_02 || (other_way && !no_13)) {
        add(0, 1, 3);
        add(1, 2, 3);
    } else {
        add(0, 1, 2);
        add(0, 2, 3);
    }
}

}  // namespace

GroundLattice lattice_over(const glm::dvec2& low, const glm::dvec2& high, std::size_t n) {
    const glm::dvec2 size = high - low;
    if (!(size.x > 0.0) || !(size.y > 0.0) || !std::isfinite(size.x) || !std::isfinite(size.y))
        fail<InvalidInput>("the ground measures ", size.x, " x ", size.y,
                           " m, both must be positive");
    if (n > kMostLatticePlaces)
        fail<InvalidInput>("the ground would be sampled at ", n, " places, at most ",
                           kMostLatticePlaces, " are taken: ask for fewer vertices");
    // m along x and m size.y / size.x along z, as m^2 size.y / size.x = n
    const double along_x = std::sqrt(static_cast<double>(n) * size.x / size.y);
    const double most = std::max(2.0, 0.5 * static_cast<double>(n));  // the other side has 2
    const auto count = [most](double places) {
        return static_cast<int>(std::clamp(std::round(places), 2.0, most));
    };
    const int columns = count(along_x);
    const int rows = count(static_cast<double>(n) / along_x);
    GroundLattice lattice;
    lattice.heights = FloatRaster(columns, rows, kUnknown);
    lattice.first = low;
    lattice.step = {size.x / (columns - 1), size.y / (rows - 1)};
    return lattice;
}

GroundLattice lattice_of(const Heightfield& field, std::size_t n) {
    check_heightfield(field);
    const double cell = field.cell_size;
    GroundLattice lattice = lattice_over(
        glm::dvec2(0.5 * cell),
        glm::dvec2(field.heights.width() - 0.5, field.heights.height() - 0.5) * cell, n);
    parallel_for_each_index(
        0, static_cast<std::size_t>(lattice.heights.height()), 16, [&](std::size_t row) {
            const int j = static_cast<int>(row);
            for (int i = 0; i < lattice.heights.width(); ++i) {
                const glm::dvec2 p = lattice.place(i, j);
                lattice.heights(i, j) = static_cast<float>(height_at(field, p.x, p.y));
            }
        });
    return lattice;
}

double height_at(const GroundLattice& ground, double x, double z) {
    const FloatRaster& heights = ground.heights;
    const double u = (x - ground.first.x) / ground.step.x;
    const double v = (z - ground.first.y) / ground.step.y;
    if (!(u >= 0.0 && v >= 0.0 && u <= heights.width() - 1 && v <= heights.height() - 1))
        return std::numeric_limits<double>::quiet_NaN();
    const int i = std::min(static_cast<int>(u), heights.width() - 2);
    const int j = std::min(static_cast<int>(v), heights.height() - 2);
    double sum = 0.0, weights = 0.0;
    for (int b = 0; b < 2; ++b)
        for (int a = 0; a < 2; ++a) {
            const double h = static_cast<double>(heights(i + a, j + b));
            const double weight =
                (a == 1 ? u - i : 1.0 - (u - i)) * (b == 1 ? v - j : 1.0 - (v - j));
            if (std::isnan(h))
                continue;
            sum += weight * h;
            weights += weight;
        }
    return weights > 0.0 ? sum / weights : std::numeric_limits<double>::quiet_NaN();
}

meshing::TriMesh lattice_mesh(const GroundLattice& ground) {
    meshing::TriMesh mesh;
    const FloatRaster& heights = ground.heights;
    Raster<std::uint32_t> vertex(heights.width(), heights.height(), kNone);
    for (int j = 0; j < heights.height(); ++j)
        for (int i = 0; i < heights.width(); ++i) {
            if (std::isnan(heights(i, j)))
                continue;
            const glm::dvec2 p = ground.place(i, j);
            vertex(i, j) = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.emplace_back(p.x, heights(i, j), p.y);
        }
    for (int j = 0; j + 1 < heights.height(); ++j)
        for (int i = 0; i + 1 < heights.width(); ++i)
            add_cell({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j)},
                     (i + j) % 2 != 0, mesh.triangles);
    if (mesh.triangles.empty())
        fail<InvalidInput>("nowhere are three places of the ground known side by side");
    meshing::clean_mesh(mesh);
    return mesh;
}

}  // namespace scree::terrain
