#pragma once

#include "base/random.h"
#include "meshing/mesh/tri_mesh.h"
#include "tests/support/rock_samples.h"
#include "vision/rock_data.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree::test {

/// A picture of that size without rocks, at that scale.
inline vision::RockSet empty_picture(int width, int height, double metres_per_pixel) {
    vision::RockSet set;
    set.image = "synthetic.png";
    set.width = width;
    set.height = height;
    set.metres_per_pixel = metres_per_pixel;
    return set;
}

/// Rocks of `low` to `high` pixels mean radius scattered over a picture; they may overlap.
inline vision::RockSet scattered_rocks(int width, int height, int count, double low, double high,
                                       std::uint64_t seed) {
    Rng rng({.seed = seed});
    vision::RockSet set = empty_picture(width, height, 0.002);
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 centre(rng.uniform(0.0, width), rng.uniform(0.0, height));
        set.rocks.push_back(lobed_rock(centre, rng.uniform(low, high), rng.bits()));
    }
    return set;
}

/// The surface (3.5) of a rock about its own centre, in metres: `rings` bands of latitude from pole
/// to pole, `segments` a turn, closed but for the doubled seam column; with normals by position
/// and texture coordinates into the picture.
inline meshing::TriMesh rock_surface(const vision::Rock& rock, const vision::RockSet& set,
                                     int rings, int segments) {
    constexpr double pi = std::numbers::pi;
    meshing::TriMesh mesh;
    const double scale = vision::scale_of(set);
    const auto stride = static_cast<std::uint32_t>(segments + 1);
    for (int k = 0; k <= rings; ++k)
        for (int s = 0; s <= segments; ++s) {
            const double theta = -0.5 * pi + pi * k / rings;
            const double phi = 2.0 * pi * (s % segments) / segments;
            const double across = vision::radius_at(rock.outline, phi) * std::cos(theta);
            const glm::dvec3 p(across * std::cos(phi), rock.depth * std::sin(theta),
                               across * std::sin(phi));
            const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
            mesh.positions.emplace_back(p * scale);
            mesh.normals.emplace_back(p / length);
            mesh.texcoords.emplace_back(
                std::clamp((rock.outline.centre.x + p.x) / set.width, 0.0, 1.0),
                std::clamp((rock.outline.centre.y + p.z) / set.height, 0.0, 1.0));
        }
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(rings); ++k)
        for (std::uint32_t s = 0; s + 1 < stride; ++s) {
            const std::uint32_t c = k * stride + s;
            if (k + 1 < static_cast<std::uint32_t>(rings))
                mesh.triangles.emplace_back(c, c + stride, c + stride + 1);
            if (k > 0)
                mesh.triangles.emplace_back(c + stride + 1, c + 1, c);
        }
    return mesh;
}

/// Place of a rock in the world: the picture's centre is the origin.
inline glm::dvec3 rock_place(const vision::Rock& rock, const vision::RockSet& set) {
    const double scale = vision::scale_of(set);
    return {(rock.outline.centre.x - 0.5 * set.width) * scale, 0.0,
            (rock.outline.centre.y - 0.5 * set.height) * scale};
}

}  // namespace scree::test
