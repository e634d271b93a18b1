#include "meshing/rocks/procedural_rock.h"

#include "base/error.h"
#include "meshing/mesh/bounds.h"
#include "meshing/rocks/ring_grid.h"
#include "meshing/rocks/size_lod.h"
#include "meshing/rocks/spherical_worley.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostHalvings = 40;
constexpr int kProbes = 4096;

using Components = std::array<double, 4>;  // by WorleyComponent

Components components_of(const WorleyDistances& d) {
    return {d.first, d.second, d.third, d.second - d.first};
}

// Directions spread evenly over the sphere.
glm::dvec3 probe(int i) {
    const double y = -1.0 + (2.0 * i + 1.0) / kProbes;
    const double out = std::sqrt(1.0 - y * y);
    const double azimuth = kPi * (3.0 - std::sqrt(5.0)) * i;
    return {out * std::cos(azimuth), y, out * std::sin(azimuth)};
}

// A place on the grid. The poles are exact, so that all their vertices weld.
struct Place {
    double azimuth;
    double out;  // cosine of the elevation
    double up;   // sine of the elevation
};

Place place_at(double azimuth, double elevation) {
    return {azimuth, std::cos(elevation), std::sin(elevation)};
}

// The surface (3.2) with the functions of part B.
class NoisySurface {
public:
    explicit NoisySurface(const ProceduralRockOptions& options)
        : options_(options),
          noise_(options.points, static_cast<std::uint64_t>(options.seed)),
          amplitude_(options.amplitude) {
        for (int i = 0; i < kProbes; ++i) {
            const Components here = components_of(noise_.distances(probe(i)));
            for (std::size_t c = 0; c < here.size(); ++c)
                greatest_[c] = std::max(greatest_[c], here[c]);
        }
    }

    double amplitude() const { return amplitude_; }
    void halve() { amplitude_ *= 0.5; }

    glm::dvec3 operator()(const Place& place) const {
        const glm::dvec3 direction(std::cos(place.azimuth) * place.out, place.up,
                                   std::sin(place.azimuth) * place.out);
        return semi_axes(direction) * direction;
    }

private:
    // Noise is a function of the direction, never of the angles, so seam and poles agree.
    glm::dvec3 semi_axes(const glm::dvec3& direction) const {
        const Components noise = components_of(noise_.distances(direction));
        const auto factor = [&](WorleyComponent component, double window) {
            const auto c = static_cast<std::size_t>(component);
            const double part = std::min(1.0, noise[c] / greatest_[c]);
            return 1.0 + amplitude_ * (part - 0.5) * window;
        };
        const glm::dvec3 half(0.5 * options_.width, 0.5 * options_.height, 0.5 * options_.depth);
        if (options_.form == WorleyForm::Radial)
            return half * factor(options_.radial, 1.0);
        const double away_from_poles = 1.0 - direction.y * direction.y;
        return half * glm::dvec3(factor(options_.along_x, 1.0),
                                 factor(options_.along_y, away_from_poles),
                                 factor(options_.along_z, 1.0));
    }

    const ProceduralRockOptions& options_;
    SphericalWorley noise_;
    double amplitude_;
    Components greatest_{};
};

RingGrid grid_of(const ProceduralRockOptions& options) {
    const int rings = options.rings > 0 ? options.rings : rings_for_segments(options.segments);
    return {options.segments, rings, options.texcoords ? RingLayout::Seamed : RingLayout::Shared};
}

// Call with ring, column, azimuth and elevation of every vertex, in their order.
template <class Visit>
void for_vertices(const RingGrid& grid, Visit&& visit) {
    for (int ring = 0; ring <= grid.rings; ++ring) {
        const double elevation = kPi * ring / grid.rings - 0.5 * kPi;
        const int columns = columns_of(grid, ring);
        for (int column = 0; column < columns; ++column)
            visit(ring, column, 2.0 * kPi * (column % grid.segments) / grid.segments, elevation);
    }
}

void fill_positions(const NoisySurface& surface, const RingGrid& grid, TriMesh& mesh) {
    mesh.positions.clear();
    for_vertices(grid, [&](int ring, int, double azimuth, double elevation) {
        const bool pole = ring == 0 || ring == grid.rings;
        mesh.positions.emplace_back(
            surface(pole ? Place{0.0, 0.0, ring == 0 ? -1.0 : 1.0} : place_at(azimuth, elevation)));
    });
}

// Condition 6 of A.1 on the mesh: every face looks away from the centre.
bool faces_outwards(const TriMesh& mesh) {
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
        const glm::dvec3 a(mesh.positions[t.x]);
        const glm::dvec3 b(mesh.positions[t.y]);
        const glm::dvec3 c(mesh.positions[t.z]);
        return glm::dot(a, glm::cross(b, c)) > 0.0;
    });
}

// Mean of the normals of the faces around a pole, by area.
glm::vec3 pole_normal(const TriMesh& mesh, const glm::vec3& pole) {
    glm::dvec3 sum(0.0);
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 a = mesh.positions[t.x];
        const glm::vec3 b = mesh.positions[t.y];
        const glm::vec3 c = mesh.positions[t.z];
        if (a == pole || b == pole || c == pole)
            sum += glm::cross(glm::dvec3(b - a), glm::dvec3(c - a));
    }
    return glm::vec3(glm::normalize(sum));
}

void fill_normals(const NoisySurface& surface, const RingGrid& grid, TriMesh& mesh) {
    const glm::vec3 south = pole_normal(mesh, mesh.positions.front());
    const glm::vec3 north = pole_normal(mesh, mesh.positions.back());
    // Differences over the steps of the grid: finer ones show every crease as teeth.
    const double along = kPi / grid.rings;
    const double across = 2.0 * kPi / grid.segments;
    for_vertices(grid, [&](int ring, int, double azimuth, double elevation) {
        if (ring == 0 || ring == grid.rings) {
            mesh.normals.push_back(ring == 0 ? south : north);
            return;
        }
        const glm::dvec3 up = surface(place_at(azimuth, elevation + along)) -
                              surface(place_at(azimuth, elevation - along));
        const glm::dvec3 round = surface(place_at(azimuth + across, elevation)) -
                                 surface(place_at(azimuth - across, elevation));
        mesh.normals.emplace_back(glm::normalize(glm::cross(up, round)));
    });
}

void fill_texcoords(const RingGrid& grid, TriMesh& mesh) {
    for_vertices(grid, [&](int ring, int column, double, double) {
        const bool pole = ring == 0 || ring == grid.rings;
        mesh.texcoords.emplace_back((column + (pole ? 0.5 : 0.0)) / grid.segments,
                                    1.0 - static_cast<double>(ring) / grid.rings);
    });
}

}  // namespace

ProceduralRock make_procedural_rock(const ProceduralRockOptions& options) {
    check(options);
    if (options.rings == 1)
        fail<InvalidOption>("rings is 1, must be 0 or at least 2");
    const RingGrid grid = grid_of(options);
    NoisySurface surface(options);
    ProceduralRock result;
    TriMesh& mesh = result.rock.mesh;
    mesh.triangles = ring_triangles(grid);
    fill_positions(surface, grid, mesh);
    while (!faces_outwards(mesh) && result.halvings < kMostHalvings) {
        surface.halve();
        ++result.halvings;
        fill_positions(surface, grid, mesh);
    }
    fill_normals(surface, grid, mesh);
    if (options.texcoords)
        fill_texcoords(grid, mesh);
    result.amplitude = surface.amplitude();
    const Box box = bounding_box(mesh);
    result.rock.box_min = box.min;
    result.rock.box_max = box.max;
    result.rock.bounding_radius = outer_radius(mesh);
    result.rock.inscribed_radius = inner_radius(mesh);
    result.rock.segments = grid.segments;
    result.rock.rings = grid.rings;
    if (options.base == RockBase::Resting)
        result.rock.position.y = -box.min.y;
    return result;
}

}  // namespace scree::meshing
