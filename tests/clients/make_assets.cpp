// Writes the GLB files that the scripts of this folder load, and what they must find in them:
// expected.json, a mask of the pixels that stones cover from above, and the photograph's colours.
// For the program itself it writes rocks and a photograph; what it makes of them is read as well.

#include "base/whole_file.h"
#include "meshing/bake/height_bake.h"
#include "meshing/bake/mesh_height_bake.h"
#include "meshing/gltf/gltf_write.h"
#include "tests/support/sample_scenes.h"
#include "vision/data/rocks_json.h"
#include "vision/image_io.h"

#include <exception>
#include <filesystem>
#include <iostream>
#include <sstream>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace {

using namespace scree;
namespace fs = std::filesystem;

glm::dmat4 matrix_of(const meshing::GltfTransform& t) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(t.translation)) *
           glm::mat4_cast(glm::dquat(t.rotation)) *
           glm::scale(glm::dmat4(1.0), glm::dvec3(t.scale));
}

std::vector<meshing::PlacedMesh> placed_meshes(const meshing::GltfScene& scene) {
    std::vector<meshing::PlacedMesh> all;
    for (const meshing::GltfNode& node : scene.nodes) {
        const meshing::TriMesh* const mesh =
            &scene.meshes[static_cast<std::size_t>(node.mesh)].geometry;
        const glm::dmat4 world = matrix_of(node.transform);
        if (node.instances.empty())
            all.push_back({mesh, world});
        for (const meshing::GltfTransform& copy : node.instances)
            all.push_back({mesh, world * matrix_of(copy)});
    }
    return all;
}

// Bytes of a mask of what stands above or below the ground: the whole silhouette, so everything is
// lifted first.
std::string silhouettes(const meshing::GltfScene& scene, const meshing::MapFrame& frame) {
    auto placed = placed_meshes(scene);
    for (auto& mesh : placed)
        mesh.world_from_mesh = glm::translate(glm::dmat4(1.0), {0, 1, 0}) * mesh.world_from_mesh;
    const auto heights = meshing::bake_mesh_heights(placed, frame);
    std::string bytes;
    for (const float h : heights.metres)
        bytes.push_back(h > 0.0F ? '\1' : '\0');
    return bytes;
}

// Rocks of many sizes that all lie inside the picture.
vision::RockSet program_rocks() {
    vision::RockSet set = test::empty_picture(480, 360, 0.001);
    set.method = "made up";
    Rng rng({.seed = 8});
    for (int i = 0; i < 48; ++i)
        set.rocks.push_back(test::lobed_rock({30.0 + 60.0 * (i % 8), 30.0 + 60.0 * (i / 8)},
                                             rng.uniform(5.0, 20.0), rng.bits()));
    return set;
}

class Assets {
public:
    explicit Assets(const fs::path& folder) : folder_(folder) {}

    void add(const std::string& name, const meshing::GltfScene& scene,
             const meshing::MapFrame& frame, const meshing::GltfWriteOptions& options) {
        write_whole_file(folder_ / name, meshing::encode_glb(scene, options));
        write_whole_file(folder_ / (name + ".mask"), silhouettes(scene, frame));
        std::size_t n_copies = 0;
        std::size_t n_triangles = 0;
        for (const meshing::GltfNode& node : scene.nodes) {
            const std::size_t shown = std::max<std::size_t>(node.instances.size(), 1);
            n_copies += node.instances.size();
            n_triangles +=
                shown * scene.meshes[static_cast<std::size_t>(node.mesh)].geometry.triangles.size();
        }
        const bool plain = n_copies > 0 && !options.instancing;
        expected_ << (expected_.tellp() > 0 ? ",\n" : "") << "\"" << name
                  << "\": {\"meshes\": " << (plain ? n_copies : scene.nodes.size())
                  << ", \"instances\": " << (plain ? 0 : n_copies)
                  << ", \"triangles\": " << n_triangles << ", \"mask\": \"" << name << ".mask\""
                  << (n_copies == 0 ? ", \"photo\": \"photo.rgb\"" : "")
                  << ", \"view\": {\"width\": " << frame.width << ", \"height\": " << frame.height
                  << ", \"across\": " << frame.width * frame.metres_per_pixel
                  << ", \"along\": " << frame.height * frame.metres_per_pixel << "}}";
    }

    // Rocks for the program, which puts its files into the folder "program".
    void add_program() {
        const vision::RockSet set = program_rocks();
        std::string mask;
        for (const float h : meshing::bake_displacement(set).metres)
            mask.push_back(h > 0.0F ? '\1' : '\0');
        write_whole_file(folder_ / "program.mask", mask);
        write_whole_file(folder_ / "program.json", vision::rocks_to_json(set));
        vision::write_png(folder_ / "program.png", test::sample_photo());
        const char* const view =
            "\"view\": {\"width\": 480, \"height\": 360, \"across\": 0.48, "
            "\"along\": 0.36}";
        expected_ << ",\n\"program/rocks.glb\": {\"meshes\": " << set.rocks.size()
                  << ", \"instances\": 0, \"mask\": \"program.mask\", \"photo\": \"photo.rgb\", "
                  << view << "},\n\"program/patch.glb\": {\"instances\": 2000, " << view << "}";
    }

    void finish() const {
        const Photo photo = test::sample_photo();
        write_whole_file(folder_ / "photo.rgb",
                         {reinterpret_cast<const std::uint8_t*>(photo.data()), 3 * photo.size()});
        write_whole_file(folder_ / "expected.json", "{" + expected_.str() + "}\n");
    }

private:
    fs::path folder_;
    std::ostringstream expected_;
};

void make_all(const fs::path& folder) {
    Assets assets(folder);
    const meshing::MapFrame photo{480, 360, 0.001};
    const meshing::MapFrame square{500, 500, 0.002};
    const meshing::GltfScene rocks = test::rocks_scene(16, 32);
    assets.add("rocks.glb", rocks, photo, {});
    assets.add("rocks-quantised.glb", rocks, photo, {.quantise = true});
    const meshing::GltfScene patch = test::patch_scene(20, 2000);
    assets.add("patch.glb", patch, square, {.quantise = true});
    const meshing::GltfScene small = test::patch_scene(5, 200);
    assets.add("patch-float.glb", small, square, {});
    assets.add("patch-nodes.glb", small, square, {.quantise = true, .instancing = false});
    assets.add_program();
    assets.finish();
    fs::create_directories(folder / "lods");
    for (const int level : {0, 1, 2})
        write_whole_file(folder / "lods" / ("lod" + std::to_string(level) + ".glb"),
                         meshing::encode_glb(test::rocks_scene(16 >> level, 32 >> level)));
    write_whole_file(folder / "lods" / "msft-lod.glb", meshing::encode_glb(test::lod_scene()));
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2) {
        std::cerr << "usage: make_client_assets FOLDER\n";
        return 2;
    }
    fs::create_directories(argv[1]);
    make_all(argv[1]);
    return 0;
} catch (const std::exception& error) {
    std::cerr << "make_client_assets: " << error.what() << '\n';
    return 1;
}
