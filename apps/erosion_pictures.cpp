#include "apps/erosion_pictures.h"

#include "meshing/mesh/bounds.h"
#include "meshing/render/raster_view.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

namespace scree::apps {
namespace {

using meshing::TriMesh;

constexpr int kRamp = 256;  // pixels from dry to most worn, as many again for water
constexpr std::size_t kMostDrawn = 60000;
constexpr glm::vec3 kDry(150, 146, 138), kWorn(190, 60, 40), kWater(70, 125, 190);

// Left half: from dry to worn; right half: water.
Photo colour_ramp() {
    Photo ramp(2 * kRamp, 8);
    for (int y = 0; y < ramp.height(); ++y)
        for (int x = 0; x < ramp.width(); ++x)
            ramp(x, y) = glm::u8vec3(
                x < kRamp ? glm::mix(kDry, kWorn, static_cast<float>(x) / (kRamp - 1)) : kWater);
    return ramp;
}

// Views begin at y = 0, so everything is lifted until it stands there.
meshing::ViewScene stood(const TriMesh& mesh, const TriMesh* water) {
    const meshing::Box box = meshing::bounding_box(mesh);
    const glm::vec3 middle = 0.5F * (box.min + box.max);
    const glm::mat4 lift =
        glm::translate(glm::mat4(1.0F), -glm::vec3(middle.x, box.min.y, middle.z));
    meshing::ViewScene scene;
    scene.objects.push_back({&mesh, lift});
    if (water != nullptr && !water->triangles.empty())
        scene.objects.push_back({water, lift});
    return scene;
}

// An open sheet as the top of a block that reaches down to `base`: walls below its rims.
TriMesh on_a_block(TriMesh mesh, float base) {
    std::vector<std::uint64_t> edges;
    const auto key = [](std::uint32_t a, std::uint32_t b) {
        return static_cast<std::uint64_t>(a) << 32U | b;
    };
    for (const glm::uvec3& t : mesh.triangles)
        for (int c = 0; c < 3; ++c)
            edges.push_back(key(t[c], t[(c + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    for (const std::uint64_t edge : edges) {
        const auto a = static_cast<std::uint32_t>(edge >> 32U);
        const auto b = static_cast<std::uint32_t>(edge);
        if (std::binary_search(edges.begin(), edges.end(), key(b, a)))
            continue;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const std::uint32_t end : {a, b}) {
            const glm::vec3 top = mesh.positions[end];
            mesh.positions.push_back(top);
            mesh.positions.emplace_back(top.x, base, top.z);
            mesh.texcoords.resize(mesh.texcoords.empty() ? 0 : mesh.texcoords.size() + 2,
                                  glm::vec2(0.0F, 0.5F));
        }
        mesh.triangles.emplace_back(first + 2, first, first + 1);
        mesh.triangles.emplace_back(first + 2, first + 1, first + 3);
    }
    return mesh;
}

meshing::ViewOptions camera(const terrain::ErosionOutput& view) {
    return {.width = view.width, .azimuth = view.azimuth, .elevation = view.elevation};
}

// Small octahedra, as many as can be told apart.
TriMesh drops(const terrain::FluidState& fluid) {
    TriMesh mesh;
    const std::size_t stride = fluid.size() / kMostDrawn + 1;
    const auto r = static_cast<float>(0.8 * fluid.radius);
    for (std::size_t i = 0; i < fluid.size(); i += stride) {
        const auto base = static_cast<unsigned>(mesh.positions.size());
        const glm::vec3 c = fluid.positions[i];
        for (int axis = 0; axis < 3; ++axis)
            for (const float sign : {1.0F, -1.0F}) {
                glm::vec3 p = c;
                p[axis] += sign * r;
                mesh.positions.push_back(p);
                mesh.texcoords.emplace_back(0.9F, 0.5F);
            }
        for (unsigned octant = 0; octant < 8; ++octant) {
            const unsigned x = octant & 1U, y = 2 + (octant >> 1U & 1U), z = 4 + (octant >> 2U);
            const bool even = (x + (y - 2) + (z - 4)) % 2 == 0;
            mesh.triangles.emplace_back(base + x, base + (even ? y : z), base + (even ? z : y));
        }
    }
    return mesh;
}

}  // namespace

Photo picture_of_ground(const TriMesh& mesh, float base, const terrain::ErosionOutput& view) {
    TriMesh shown;
    shown.positions = mesh.positions;
    shown.triangles = mesh.triangles;
    shown = on_a_block(std::move(shown), base);
    return meshing::draw_view(stood(shown, nullptr), camera(view)).clay;
}

Photo picture_of_erosion(const TriMesh& mesh, const std::vector<glm::vec3>& before, float base,
                         const terrain::FluidState& fluid, const terrain::ErosionOutput& view) {
    TriMesh shown;
    shown.positions = mesh.positions;
    shown.triangles = mesh.triangles;
    shown.texcoords.assign(mesh.positions.size(), glm::vec2(0.0F, 0.5F));
    if (before.size() == mesh.positions.size()) {
        float most = 0.0F;
        for (std::size_t i = 0; i < before.size(); ++i)
            most = std::max(most, glm::distance(before[i], mesh.positions[i]));
        for (std::size_t i = 0; most > 0.0F && i < before.size(); ++i)
            shown.texcoords[i].x = 0.48F * glm::distance(before[i], mesh.positions[i]) / most;
    }
    shown = on_a_block(std::move(shown), base);
    const TriMesh water = drops(fluid);
    const Photo ramp = colour_ramp();
    meshing::ViewScene scene = stood(shown, &water);
    scene.photo = &ramp;
    return meshing::draw_view(scene, camera(view)).textured;
}

}  // namespace scree::apps
