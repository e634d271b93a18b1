#pragma once

#include "meshing/gltf/gltf_scene.h"
#include "tests/support/placed_rocks.h"
#include "vision/image_io.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

namespace scree::test {

/// A picture whose red grows to the right, green downwards, with blue chequers: no turn or mirror
/// image of it looks the same.
inline Photo sample_photo() {
    Photo photo(480, 360);
    for (int y = 0; y < photo.height(); ++y)
        for (int x = 0; x < photo.width(); ++x)
            photo(x, y) =
                glm::u8vec3(50 + x / 3, 50 + y / 3, (x / 24 + y / 24) % 2 == 0 ? 60 : 140);
    return photo;
}

/// The same as a JPEG file.
inline std::vector<std::uint8_t> sample_texture() {
    return vision::encode_jpeg(sample_photo(), 85);
}

/// An icosahedron split `levels` times, pushed out to the unit sphere: level 4 has 2,562 vertices.
inline meshing::TriMesh icosphere(int levels) {
    const float t = 1.618034F;
    meshing::TriMesh mesh;
    mesh.positions = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                      {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
    mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto found = middles.try_emplace(
                std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
            if (found.second)
                mesh.positions.push_back(0.5F * (mesh.positions[a] + mesh.positions[b]));
            return found.first->second;
        };
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& f : mesh.triangles) {
            const std::uint32_t ab = middle(f.x, f.y);
            const std::uint32_t bc = middle(f.y, f.z);
            const std::uint32_t ca = middle(f.z, f.x);
            finer.insert(finer.end(), {{f.x, ab, ca}, {f.y, bc, ab}, {f.z, ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
    }
    for (glm::vec3& p : mesh.positions)
        p = glm::normalize(p);
    return mesh;
}

/// A stone of `radius` metres from an icosphere: squashed and dented, with normals and texture
/// coordinates.
inline meshing::TriMesh stone(int levels, float radius, std::uint64_t seed) {
    Rng rng({.seed = seed, .stream = 77});
    const glm::vec3 squash(1.0F, rng.uniform(0.5, 0.8), rng.uniform(0.7, 1.0));
    const auto dent = static_cast<float>(rng.uniform(0.02, 0.08));
    const auto turn = static_cast<float>(rng.uniform(0.0, 6.0));
    meshing::TriMesh mesh = icosphere(levels);
    for (glm::vec3& p : mesh.positions) {
        mesh.normals.push_back(glm::normalize(p / squash));
        mesh.texcoords.emplace_back(0.5F + 0.45F * p.x, 0.5F + 0.45F * p.z);
        p *= radius * squash * (1.0F + dent * std::sin(4.0F * p.x + 3.0F * p.z + turn));
    }
    return mesh;
}

/// Forty-eight rocks on a grid, each a named node, textured: what rocks.glb looks like.
inline meshing::GltfScene rocks_scene(int rings, int segments) {
    vision::RockSet set = empty_picture(480, 360, 0.001);
    meshing::GltfScene scene;
    scene.name = "rocks";
    scene.texture = sample_texture();
    scene.extras = {{"metres_per_pixel", 0.001}, {"image", std::string("sample.jpg")}};
    Rng rng({.seed = 5});
    for (int i = 0; i < 48; ++i) {
        const glm::dvec2 centre(30.0 + 60.0 * (i % 8), 30.0 + 60.0 * (i / 8));
        set.rocks.push_back(lobed_rock(centre, rng.uniform(10.0, 20.0), rng.bits()));
        const auto& rock = set.rocks.back();
        scene.meshes.push_back(
            {"rock-" + std::to_string(i), rock_surface(rock, set, rings, segments)});
        meshing::GltfNode node;
        node.name = "rock-" + std::to_string(i);
        node.mesh = i;
        node.transform.translation = rock_place(rock, set);
        node.extras = {{"depth_m", double{rock.depth} * 0.001},
                       {"box_m", std::vector<double>{0.03, 0.02, 0.03}}};
        scene.nodes.push_back(std::move(node));
    }
    return scene;
}

/// The same rocks with two coarser stand-ins each.
inline meshing::GltfScene lod_scene() {
    meshing::GltfScene scene = rocks_scene(16, 32);
    const int n_rocks = static_cast<int>(scene.nodes.size());
    for (const int shift : {1, 2}) {
        const meshing::GltfScene coarser = rocks_scene(16 >> shift, 32 >> shift);
        for (int i = 0; i < n_rocks; ++i) {
            const auto k = static_cast<std::size_t>(i);
            scene.meshes.push_back(coarser.meshes[k]);
            scene.nodes.push_back(coarser.nodes[k]);
            scene.nodes.back().name += "-lod" + std::to_string(shift);
            scene.nodes.back().mesh = static_cast<int>(scene.meshes.size()) - 1;
            scene.nodes[k].coarser.push_back(static_cast<int>(scene.nodes.size()) - 1);
        }
    }
    return scene;
}

/// `n_copies` stones on a square of one metre, copies of `n_rocks` rocks of 2,562 vertices.
inline meshing::GltfScene patch_scene(int n_rocks, int n_copies) {
    meshing::GltfScene scene;
    scene.name = "patch";
    scene.texture = sample_texture();
    for (int i = 0; i < n_rocks; ++i) {
        scene.meshes.push_back(
            {"rock-" + std::to_string(i), stone(4, 0.01F, static_cast<std::uint64_t>(i))});
        meshing::GltfNode node;
        node.name = "rock-" + std::to_string(i);
        node.mesh = i;
        scene.nodes.push_back(std::move(node));
    }
    const int side = static_cast<int>(std::ceil(std::sqrt(n_copies)));
    Rng rng({.seed = 9});
    for (int i = 0; i < n_copies; ++i) {
        meshing::GltfTransform t;
        t.translation = {(i % side + 0.5) / side - 0.5, 0.0, (i / side + 0.5) / side - 0.5};
        const double half = rng.uniform(0.0, std::numbers::pi);
        t.rotation = {static_cast<float>(std::cos(half)), 0.0F, static_cast<float>(std::sin(half)),
                      0.0F};
        t.scale = glm::vec3(static_cast<float>(rng.uniform(0.5, 1.0)));
        scene.nodes[static_cast<std::size_t>(i % n_rocks)].instances.push_back(t);
    }
    return scene;
}

}  // namespace scree::test
