#include "tests/terrain/view/sample_ground.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace scree::terrain::test {
namespace {

// Smooth noise over a lattice of `period` cells that repeats, -1 to 1.
class Noise {
public:
    Noise(int period, unsigned seed) : period_(period), values_(period, period) {
        Rng random({.seed = seed});
        for (float& v : values_)
            v = static_cast<float>(random.uniform(-1.0, 1.0));
    }
    float at(float x, float y) const {
        const float fx = std::floor(x);
        const float fy = std::floor(y);
        const float u = smooth(x - fx);
        const float v = smooth(y - fy);
        const int i = static_cast<int>(fx);
        const int j = static_cast<int>(fy);
        const float top = value(i, j) * (1 - u) + value(i + 1, j) * u;
        const float bottom = value(i, j + 1) * (1 - u) + value(i + 1, j + 1) * u;
        return top * (1 - v) + bottom * v;
    }

private:
    static float smooth(float t) { return t * t * (3 - 2 * t); }
    float value(int i, int j) const {
        return values_((i % period_ + period_) % period_, (j % period_ + period_) % period_);
    }
    int period_;
    FloatRaster values_;
};

std::uint8_t byte(float v) {
    return static_cast<std::uint8_t>(std::clamp(v, 0.0F, 255.0F));
}

glm::u8vec3 tinted(const glm::vec3& colour, float factor) {
    return {byte(colour.x * factor), byte(colour.y * factor), byte(colour.z * factor)};
}

MaterialLook sand(int side) {
    MaterialLook look{.albedo = Photo(side, side),
                      .displacement = FloatRaster(side, side),
                      .size_m = 0.8,
                      .roughness = 0.95F};
    const Noise bend(8, 3);
    const Noise grain(side, 4);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(side);
            const float v = static_cast<float>(y) / static_cast<float>(side);
            const float wave = std::sin(6.2831853F * (9.0F * v + 0.35F * bend.at(8 * u, 8 * v)));
            const float g = grain.at(static_cast<float>(x), static_cast<float>(y));
            look.displacement(x, y) = 0.0035F * wave + 0.0006F * g;
            look.albedo(x, y) = tinted({206, 178, 136}, 0.97F + 0.04F * wave + 0.07F * g);
        }
    return look;
}

MaterialLook mud(int side) {
    MaterialLook look{.albedo = Photo(side, side),
                      .displacement = FloatRaster(side, side),
                      .size_m = 1.0,
                      .roughness = 0.5F};
    const Noise coarse(6, 5);
    const Noise fine(48, 6);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(side);
            const float v = static_cast<float>(y) / static_cast<float>(side);
            const float h = 0.7F * coarse.at(6 * u, 6 * v) + 0.3F * fine.at(48 * u, 48 * v);
            look.displacement(x, y) = 0.006F * h;
            look.albedo(x, y) = tinted({92, 72, 56}, 1.0F + 0.22F * h);
        }
    return look;
}

// Round stones thrown one over the other, round the seams.
MaterialLook pebbles(int side) {
    MaterialLook look{.albedo = Photo(side, side, {88, 84, 80}),
                      .displacement = FloatRaster(side, side),
                      .size_m = 0.9,
                      .roughness = 0.8F};
    Rng random({.seed = 7});
    const float texels = static_cast<float>(side);
    for (int i = 0; i < 900; ++i) {
        const float r = texels * static_cast<float>(random.uniform(0.012, 0.032));
        const float squash = static_cast<float>(random.uniform(0.6, 1.0));
        const float turn = static_cast<float>(random.uniform(0.0, 3.14159));
        const auto cx = static_cast<float>(random.uniform(0.0, texels));
        const auto cy = static_cast<float>(random.uniform(0.0, texels));
        const float shade = static_cast<float>(random.uniform(0.6, 1.15));
        const float warm = static_cast<float>(random.uniform(-1.0, 1.0));
        const int reach = static_cast<int>(r) + 1;
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx) {
                const auto px = static_cast<float>(dx);
                const auto py = static_cast<float>(dy);
                const float a = (px * std::cos(turn) + py * std::sin(turn)) / r;
                const float b = (py * std::cos(turn) - px * std::sin(turn)) / (r * squash);
                const float inside = 1.0F - a * a - b * b;
                if (inside <= 0.0F)
                    continue;
                const int x = (static_cast<int>(cx) + dx + 2 * side) % side;
                const int y = (static_cast<int>(cy) + dy + 2 * side) % side;
                const float h = 0.9F / texels * r * squash * std::sqrt(inside);
                if (h <= look.displacement(x, y))
                    continue;
                look.displacement(x, y) = h;
                look.albedo(x, y) =
                    tinted({150 + 12 * warm, 146 + 2 * warm, 140 - 12 * warm}, shade);
            }
    }
    return look;
}

}  // namespace

Heightfield rolling_ground(int side, unsigned seed) {
    const Noise noise(16, seed);
    Heightfield field{FloatRaster(side, side), 4.0 / side};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const float u = 4.0F * static_cast<float>(x) / static_cast<float>(side);
            const float v = 4.0F * static_cast<float>(y) / static_cast<float>(side);
            field.heights(x, y) =
                0.16F * noise.at(0.9F * u, 0.9F * v) + 0.03F * noise.at(3.0F * u + 5.0F, 3.0F * v);
        }
    return field;
}

DescriptionMap three_strips(double width_m, int side) {
    DescriptionMap map;
    map.cell_size = width_m / side;
    map.ids = Raster<std::uint8_t>(side, side);
    const Noise noise(16, 9);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(side);
            const float v = static_cast<float>(y) / static_cast<float>(side);
            const float at = u + 0.05F * noise.at(9.0F * v, 3.0F * u);
            map.ids(x, y) = at < 0.34F ? 1 : at < 0.67F ? 2 : 7;
        }
    map.materials.resize(3);
    const int ids[3] = {1, 2, 7};
    const char* names[3] = {"sand", "mud", "pebbles"};
    const Soil soils[3] = {kSand, kMud, kPebbles};
    for (std::size_t i = 0; i < 3; ++i) {
        map.materials[i].id = ids[i];
        map.materials[i].name = names[i];
        map.materials[i].soil = soils[i];
    }
    return map;
}

std::vector<MaterialLook> strip_looks(int side) {
    return {sand(side), mud(side), pebbles(side)};
}

FloatRaster groove(const Heightfield& base) {
    const int n = base.heights.width();
    FloatRaster out(n, base.heights.height());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < n; ++x) {
            const double px = (x + 0.5) * base.cell_size;
            const double pz = (y + 0.5) * base.cell_size - 2.3 - 0.35 * std::sin(1.3 * px);
            const double d = std::abs(pz) / 0.13;
            double u = -0.075 * std::exp(-std::pow(d, 6.0));
            u += 0.045 * std::exp(-std::pow((d - 1.5) / 0.4, 2.0));
            u += 0.010 * std::exp(-std::pow(d, 6.0)) * std::sin(px * 60.0 + (pz > 0 ? 8 : -8) * d);
            out(x, y) = static_cast<float>(px < 0.4 || px > 3.6 ? 0.0 : u);
        }
    return out;
}

meshing::TriMesh sphere(int rings) {
    meshing::TriMesh mesh;
    const int around = 2 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int k = 0; k <= around; ++k) {
            const double a = std::numbers::pi * i / rings;
            const double b = 2.0 * std::numbers::pi * k / around;
            const glm::vec3 p(static_cast<float>(std::sin(a) * std::cos(b)),
                              static_cast<float>(std::cos(a)),
                              static_cast<float>(-std::sin(a) * std::sin(b)));
            mesh.positions.push_back(p);
            mesh.normals.push_back(p);
        }
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < around; ++k) {
            const auto a = static_cast<unsigned>(i * (around + 1) + k);
            const auto b = a + static_cast<unsigned>(around) + 1U;
            mesh.triangles.emplace_back(a, b, b + 1U);
            mesh.triangles.emplace_back(a, b + 1U, a + 1U);
        }
    return mesh;
}

meshing::TriMesh box() {
    meshing::TriMesh mesh;
    for (unsigned i = 0; i < 8; ++i)
        mesh.positions.emplace_back((i & 1U) != 0 ? 0.5F : -0.5F, (i & 2U) != 0 ? 0.5F : -0.5F,
                                    (i & 4U) != 0 ? 0.5F : -0.5F);
    const unsigned quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& q : quads) {
        mesh.triangles.emplace_back(q[0], q[1], q[2]);
        mesh.triangles.emplace_back(q[0], q[2], q[3]);
    }
    return mesh;
}

}  // namespace scree::terrain::test
