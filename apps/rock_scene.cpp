#include "apps/rock_scene.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace scree::apps {
namespace {

using meshing::GltfExtra;
using meshing::GltfNode;
using meshing::GltfScene;
using meshing::RockMesh;

std::string rock_name(std::size_t source) {
    std::string number = std::to_string(source + 1);
    return "rock_" + std::string(number.size() < 4 ? 4 - number.size() : 0, '0') + number;
}

std::vector<GltfExtra> rock_extras(const vision::RockSet& set, const RockMesh& rock) {
    const vision::Rock& data = set.rocks.at(rock.source);
    return {{"label", static_cast<double>(rock.source + 1)},
            {"confidence", static_cast<double>(data.outline.confidence)},
            {"bounding_radius_m", static_cast<double>(rock.bounding_radius)},
            {"inscribed_radius_m", static_cast<double>(rock.inscribed_radius)}};
}

GltfScene empty_scene(const vision::RockSet& set, const std::vector<std::uint8_t>& texture) {
    GltfScene scene;
    scene.name = "rocks";
    scene.texture = texture;
    scene.extras = {{"image", set.image},
                    {"metres_per_pixel", vision::scale_of(set)},
                    {"scale_known", set.metres_per_pixel > 0.0 ? 1.0 : 0.0}};
    return scene;
}

GltfNode rock_node(const vision::RockSet& set, const RockMesh& rock, int mesh) {
    GltfNode node;
    node.name = rock_name(rock.source);
    node.mesh = mesh;
    node.transform.translation = rock.position;
    node.extras = rock_extras(set, rock);
    return node;
}

}  // namespace

GltfScene scene_of_rocks(const vision::RockSet& set, const std::vector<RockMesh>& meshes,
                         const std::vector<std::uint8_t>& texture) {
    GltfScene scene = empty_scene(set, texture);
    for (const RockMesh& rock : meshes) {
        scene.nodes.push_back(rock_node(set, rock, static_cast<int>(scene.meshes.size())));
        scene.meshes.push_back({rock_name(rock.source), rock.mesh});
    }
    return scene;
}

std::size_t level_count(const LodChains& chains) {
    std::size_t levels = 0;
    for (const auto& chain : chains)
        levels = std::max(levels, chain.size());
    return levels;
}

GltfScene scene_of_level(const vision::RockSet& set, const std::vector<RockMesh>& meshes,
                         const LodChains& chains, std::size_t level,
                         const std::vector<std::uint8_t>& texture) {
    GltfScene scene = empty_scene(set, texture);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const meshing::LodLevel& chosen = chains[i][std::min(level, chains[i].size() - 1)];
        GltfNode node = rock_node(set, meshes[i], static_cast<int>(scene.meshes.size()));
        node.extras.push_back({"error_m", chosen.error});
        scene.nodes.push_back(std::move(node));
        scene.meshes.push_back({rock_name(meshes[i].source), chosen.mesh});
    }
    return scene;
}

GltfScene scene_of_all_levels(const vision::RockSet& set, const std::vector<RockMesh>& meshes,
                              const LodChains& chains, const std::vector<std::uint8_t>& texture) {
    GltfScene scene = empty_scene(set, texture);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const auto finest = scene.nodes.size();
        for (std::size_t level = 0; level < chains[i].size(); ++level) {
            GltfNode node = rock_node(set, meshes[i], static_cast<int>(scene.meshes.size()));
            node.extras.push_back({"error_m", chains[i][level].error});
            if (level > 0) {
                node.name += "_lod" + std::to_string(level);
                scene.nodes[finest].coarser.push_back(static_cast<int>(scene.nodes.size()));
            }
            scene.meshes.push_back({node.name, chains[i][level].mesh});
            scene.nodes.push_back(std::move(node));
        }
    }
    return scene;
}

std::string lods_json(const LodChains& chains, const std::vector<std::string>& files) {
    nlohmann::ordered_json levels = nlohmann::ordered_json::array();
    for (std::size_t level = 0; level < files.size(); ++level) {
        std::size_t n_triangles = 0;
        double error = 0.0;
        for (const auto& chain : chains) {
            const meshing::LodLevel& chosen = chain[std::min(level, chain.size() - 1)];
            n_triangles += chosen.mesh.triangles.size();
            error = std::max(error, chosen.error);
        }
        levels.push_back(
            {{"file", files[level]}, {"triangles", n_triangles}, {"greatest_error_m", error}});
    }
    return nlohmann::ordered_json{{"format", "scree-lods"}, {"version", 1}, {"levels", levels}}
               .dump(1) +
           "\n";
}

GltfScene scene_of_patch(const meshing::RockPatch& patch, const std::vector<RockMesh>& meshes,
                         const std::vector<std::uint8_t>& texture) {
    GltfScene scene;
    scene.name = "patch";
    scene.texture = texture;
    scene.extras = {{"size_m", std::vector<double>{patch.size.x, patch.size.y}},
                    {"coverage", patch.report.coverage}};
    for (const std::size_t prototype : patch.prototypes) {
        GltfNode node;
        node.name = rock_name(meshes.at(prototype).source);
        node.mesh = static_cast<int>(scene.meshes.size());
        scene.meshes.push_back({node.name, meshes[prototype].mesh});
        scene.nodes.push_back(std::move(node));
    }
    for (const meshing::PatchInstance& stone : patch.instances)
        scene.nodes.at(stone.prototype)
            .instances.push_back({stone.translation, stone.rotation, stone.scale});
    std::erase_if(scene.nodes, [](const GltfNode& node) { return node.instances.empty(); });
    return scene;
}

}  // namespace scree::apps
