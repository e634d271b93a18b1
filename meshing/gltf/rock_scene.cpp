#include "meshing/gltf/rock_scene.h"

#include "base/error.h"

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <utility>

#include <nlohmann/json.hpp>

namespace scree::meshing {
namespace {

std::vector<double> numbers(const glm::vec3& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}

std::vector<GltfExtra> photograph_extras(const vision::RockSet& set) {
    const double scale = vision::scale_of(set);
    return {{"image", set.image},
            {"method", set.method},
            {"metres_per_pixel", scale},
            {"scale_known", set.metres_per_pixel > 0.0},
            {"size_m", std::vector<double>{set.width * scale, set.height * scale}}};
}

std::vector<GltfExtra> rock_extras(const vision::RockSet& set, const RockMesh& rock) {
    const vision::Rock& source = set.rocks[rock.source];
    const double scale = vision::scale_of(set);
    return {{"label", static_cast<double>(rock.source + 1)},
            {"confidence", double{source.outline.confidence}},
            {"touches_border", source.outline.touches_border},
            {"depth_m", source.depth * scale},
            {"diameter_m", vision::equivalent_diameter(source.outline) * scale},
            {"box_min_m", numbers(rock.box_min)},
            {"box_max_m", numbers(rock.box_max)},
            {"bounding_radius_m", double{rock.bounding_radius}},
            {"inscribed_radius_m", double{rock.inscribed_radius}}};
}

void check_sources(const vision::RockSet& set, const std::vector<RockMesh>& rocks) {
    for (const RockMesh& rock : rocks)
        if (rock.source >= set.rocks.size())
            fail<InvalidInput>("a mesh names rock ", rock.source, ", the set has ",
                               set.rocks.size());
}

void check_chains(const std::vector<RockMesh>& rocks,
                  const std::vector<std::vector<LodLevel>>& chains) {
    const bool whole =
        std::none_of(chains.begin(), chains.end(), [](const auto& chain) { return chain.empty(); });
    if (chains.size() != rocks.size() || !whole)
        fail<InvalidInput>("levels of detail need one chain with a level for each of ",
                           rocks.size(), " rocks, got ", chains.size());
}

const LodLevel& level_of(const std::vector<LodLevel>& chain, std::size_t level) {
    return chain[std::min(level, chain.size() - 1)];
}

// The rock's own mesh is the finest level.
const TriMesh& mesh_of(const RockMesh& rock, const std::vector<LodLevel>& chain,
                       std::size_t level) {
    return level == 0 || chain.size() == 1 ? rock.mesh : level_of(chain, level).mesh;
}

GltfScene empty_scene(const vision::RockSet& set, const char* name,
                      std::vector<std::uint8_t> texture) {
    GltfScene scene;
    scene.name = name;
    scene.texture = std::move(texture);
    scene.extras = photograph_extras(set);
    return scene;
}

void add_rock(GltfScene& scene, const vision::RockSet& set, const RockMesh& rock,
              TriMesh geometry) {
    GltfNode node;
    node.name = rock_name(rock.source);
    node.mesh = static_cast<int>(scene.meshes.size());
    node.transform.translation = rock.position;
    node.extras = rock_extras(set, rock);
    scene.meshes.push_back({node.name, std::move(geometry)});
    scene.nodes.push_back(std::move(node));
}

// A coarser self of the node, which names it.
void add_coarser(GltfScene& scene, std::size_t finest, const TriMesh& geometry) {
    GltfNode node;
    GltfNode& whole = scene.nodes[finest];
    node.name = whole.name + "-lod" + std::to_string(whole.coarser.size() + 1);
    node.mesh = static_cast<int>(scene.meshes.size());
    node.transform = whole.transform;
    whole.coarser.push_back(static_cast<int>(scene.nodes.size()));
    scene.meshes.push_back({node.name, geometry});
    scene.nodes.push_back(std::move(node));
}

nlohmann::ordered_json level_summary(const std::vector<std::vector<LodLevel>>& chains,
                                     std::size_t level, const std::string& file) {
    double error = 0.0;
    std::size_t n_vertices = 0;
    std::size_t n_triangles = 0;
    for (const auto& chain : chains) {
        const LodLevel& own = level_of(chain, level);
        error = std::max(error, own.error);
        n_vertices += own.mesh.positions.size();
        n_triangles += own.mesh.triangles.size();
    }
    return {{"level", level},
            {"file", file},
            {"error_m", error},
            {"vertices", n_vertices},
            {"triangles", n_triangles}};
}

// One line a rock, errors with the digits that mean something: the list stays small.
void write_chain(std::ostream& out, const std::vector<LodLevel>& chain, const std::string& name) {
    std::ostringstream triangles;
    out << R"({"name":")" << name << R"(","error_m":[)";
    for (std::size_t level = 0; level < chain.size(); ++level) {
        char text[32];
        std::snprintf(text, sizeof text, "%.3g", chain[level].error);
        out << (level == 0 ? "" : ",") << text;
        triangles << (level == 0 ? "" : ",") << chain[level].mesh.triangles.size();
    }
    out << R"(],"triangles":[)" << triangles.str() << "]}";
}

}  // namespace

std::string rock_name(std::size_t index) {
    char text[32];
    std::snprintf(text, sizeof text, "rock-%04zu", index + 1);
    return text;
}

GltfScene rock_scene(const vision::RockSet& set, const std::vector<RockMesh>& rocks,
                     std::vector<std::uint8_t> texture) {
    check_sources(set, rocks);
    GltfScene scene = empty_scene(set, "rocks", std::move(texture));
    for (const RockMesh& rock : rocks)
        add_rock(scene, set, rock, rock.mesh);
    return scene;
}

GltfScene rock_scene(const vision::RockSet& set, std::vector<RockMesh>&& rocks,
                     std::vector<std::uint8_t> texture) {
    check_sources(set, rocks);
    GltfScene scene = empty_scene(set, "rocks", std::move(texture));
    for (RockMesh& rock : rocks)
        add_rock(scene, set, rock, std::move(rock.mesh));
    rocks.clear();
    return scene;
}

GltfScene rock_lod_scene(const vision::RockSet& set, const std::vector<RockMesh>& rocks,
                         const std::vector<std::vector<LodLevel>>& chains, std::size_t level,
                         std::vector<std::uint8_t> texture) {
    check_sources(set, rocks);
    check_chains(rocks, chains);
    GltfScene scene = empty_scene(set, "rocks", std::move(texture));
    scene.extras.push_back({"level", static_cast<double>(level)});
    for (std::size_t i = 0; i < rocks.size(); ++i)
        add_rock(scene, set, rocks[i], mesh_of(rocks[i], chains[i], level));
    return scene;
}

GltfScene rock_lods_scene(const vision::RockSet& set, const std::vector<RockMesh>& rocks,
                          const std::vector<std::vector<LodLevel>>& chains,
                          std::vector<std::uint8_t> texture) {
    GltfScene scene = rock_lod_scene(set, rocks, chains, 0, std::move(texture));
    scene.extras.pop_back();  // it holds every level, not one
    for (std::size_t i = 0; i < rocks.size(); ++i)
        for (std::size_t level = 1; level < chains[i].size(); ++level)
            add_coarser(scene, i, chains[i][level].mesh);
    return scene;
}

std::size_t deepest_level(const std::vector<std::vector<LodLevel>>& chains) {
    std::size_t most = 0;
    for (const auto& chain : chains)
        most = std::max(most, chain.size());
    return most;
}

std::string lods_json(const std::vector<RockMesh>& rocks,
                      const std::vector<std::vector<LodLevel>>& chains,
                      const std::vector<std::string>& files) {
    check_chains(rocks, chains);
    if (files.size() != deepest_level(chains))
        fail<InvalidInput>("levels of detail need one file each, got ", files.size(), " for ",
                           deepest_level(chains), " levels");
    std::ostringstream out;
    out << "{\n\"format\":\"scree-lods\",\n\"version\":1,\n\"levels\":[";
    for (std::size_t level = 0; level < files.size(); ++level)
        out << (level == 0 ? "\n" : ",\n") << level_summary(chains, level, files[level]).dump();
    out << "\n],\n\"rocks\":[";
    for (std::size_t i = 0; i < rocks.size(); ++i) {
        out << (i == 0 ? "\n" : ",\n");
        write_chain(out, chains[i], rock_name(rocks[i].source));
    }
    out << "\n]\n}\n";
    return out.str();
}

GltfScene patch_scene(const vision::RockSet& set, const std::vector<RockMesh>& rocks,
                      const RockPatch& patch, std::vector<std::uint8_t> texture) {
    check_sources(set, rocks);
    GltfScene scene = empty_scene(set, "patch", std::move(texture));
    for (GltfExtra& extra : scene.extras)
        if (extra.name == "size_m")
            extra.value = std::vector<double>{patch.size.x, patch.size.y};
    scene.extras.push_back({"coverage", patch.report.coverage});
    for (const std::size_t prototype : patch.prototypes) {
        if (prototype >= rocks.size())
            fail<InvalidInput>("the patch uses mesh ", prototype, ", there are ", rocks.size());
        const RockMesh& rock = rocks[prototype];
        GltfNode node;
        node.name = rock_name(rock.source);
        node.mesh = static_cast<int>(scene.meshes.size());
        node.extras = {{"label", static_cast<double>(rock.source + 1)}};
        scene.meshes.push_back({node.name, rock.mesh});
        scene.nodes.push_back(std::move(node));
    }
    for (const PatchInstance& instance : patch.instances) {
        if (instance.prototype >= scene.nodes.size())
            fail<InvalidInput>("the patch places prototype ", instance.prototype, ", it has ",
                               scene.nodes.size());
        scene.nodes[instance.prototype].instances.push_back(
            {instance.translation, instance.rotation, instance.scale});
    }
    std::erase_if(scene.nodes, [](const GltfNode& node) { return node.instances.empty(); });
    return scene;
}

}  // namespace scree::meshing
