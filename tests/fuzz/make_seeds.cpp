#include "base/whole_file.h"
#include "meshing/gltf/gltf_write.h"
#include "meshing/io/mesh_io.h"
#include "terrain/material/id_text.h"
#include "terrain/material/materials_json.h"
#include "tests/support/las_file.h"
#include "tests/support/tiny_network.h"
#include "vision/data/rockdata_text.h"
#include "vision/data/rocks_json.h"
#include "vision/image_io.h"

#include <cstdint>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace fs = std::filesystem;
using namespace scree;

namespace {

void write(const fs::path& path, const OIIO::ImageSpec& spec) {
    std::vector<std::uint8_t> values(spec.image_bytes(), 0);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<std::uint8_t>(i * 7919 % 61);
    const auto output = OIIO::ImageOutput::create(path.string());
    if (output && output->open(path.string(), spec)) {
        output->write_image(spec.format, values.data());
        output->close();
    }
}

// Small pictures of every format, a few kinds of each.
void image_seeds(const fs::path& folder) {
    fs::create_directories(folder);
    for (const char* ending : {"png", "jpg", "tif", "gif", "bmp", "webp", "ppm", "tga"})
        for (const int n_channels : {1, 3, 4})
            write(folder / ("u8-" + std::to_string(n_channels) + "." + ending),
                  {9, 6, n_channels, OIIO::TypeDesc::UINT8});
    for (const char* ending : {"png", "tif"})
        write(folder / (std::string("u16.") + ending), {9, 6, 3, OIIO::TypeDesc::UINT16});
    for (const char* ending : {"exr", "tif"})
        write(folder / (std::string("float.") + ending), {9, 6, 3, OIIO::TypeDesc::FLOAT});
    vision::write_heights_png(folder / "heights.png", {FloatRaster(5, 4), 0.001});
}

void label_seeds(const fs::path& folder) {
    fs::create_directories(folder);
    LabelMap labels(12, 9);
    for (std::size_t i = 0; i < labels.size(); ++i)
        labels.data()[i] = static_cast<std::uint16_t>(i / 7 % 3 * 300);
    vision::write_labels(folder / "wide.png", labels);
    vision::write_png(folder / "narrow.png", Raster<std::uint8_t>(7, 5, std::uint8_t{2}));
    write(folder / "labels.tif", {9, 6, 1, OIIO::TypeDesc::UINT16});
}

// Few weights, so that most changes hit what the numbers mean.
void model_seeds(const fs::path& folder) {
    fs::create_directories(folder);
    test::TinyNetwork network = test::pointwise_network(3, 1.0F, 0.5F);
    write_whole_file(folder / "pointwise", std::string_view(test::onnx_bytes(network)));
    write_whole_file(folder / "smoothing",
                     std::string_view(test::onnx_bytes(test::smoothing_network(1, 1.0F))));
    network.nodes[0].output = "folded";
    network.nodes.push_back({"Relu", {"folded"}, "positive", {}, {}});
    network.nodes.push_back(
        {"MaxPool", {"positive"}, "small", {{"kernel_shape", {2, 2}}, {"strides", {2, 2}}}, {}});
    network.nodes.push_back(
        {"Resize", {"small", "", "scales"}, "large", {}, {{"mode", "nearest"}}});
    network.weights.push_back({"scales", {4}, {1, 1, 2, 2}});
    network.nodes.push_back({"Add", {"large", "folded"}, "field", {}, {}});
    write_whole_file(folder / "joined", std::string_view(test::onnx_bytes(network)));
}

vision::RockSet rocks(std::size_t n) {
    vision::RockSet set{"a.png", 30, 20, 0.0005, "classical", {}};
    for (std::size_t i = 0; i < n; ++i) {
        vision::Rock rock;
        rock.outline.centre = {8.5 + 9.0 * static_cast<double>(i), 10.25};
        rock.outline.radii.fill(5.0F);
        rock.depth = 5.0F;
        rock.outline.touches_border = i == 1;
        set.rocks.push_back(rock);
    }
    return set;
}

// A tetrahedron with and without copies, packed and plain.
void glb_seeds(const fs::path& folder) {
    fs::create_directories(folder);
    meshing::GltfScene scene;
    scene.name = "seed";
    scene.meshes.push_back({"stone",
                            {{{0, 1, 0}, {1, 0, 0}, {-1, 0, 1}, {-1, 0, -1}},
                             {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, -1}},
                             {{0, 0}, {1, 0}, {0, 1}, {1, 1}},
                             {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}});
    scene.nodes.push_back({"one", 0, {}, {}, {}, {{"confidence", 0.5}}});
    write_staged_file(folder / "plain.glb", meshing::encode_glb(scene));
    scene.nodes.push_back({"many", 0, {}, {{}, {{1, 0, 0}}}, {}, {}});
    write_staged_file(folder / "copies.glb", meshing::encode_glb(scene));
    write_staged_file(folder / "packed.glb", meshing::encode_glb(scene, {.quantise = true}));
}

// A table, rules and strokes over it, and its id file; with all members and with few.
void ground_seeds(const fs::path& folder) {
    for (const char* name : {"id_text", "materials_json", "strokes_json"})
        fs::create_directories(folder / name);
    std::vector<terrain::Material> materials(2);
    materials[0].name = "sand";
    materials[1].id = 7;
    materials[1].name = "wet mud";
    const auto write_tables = [&](const std::string& name) {
        const terrain::MaterialTable table{0.25, "dir/ids.png", "dir/params.exr", materials};
        write_whole_file(folder / "materials_json" / name,
                         std::string_view(terrain::materials_to_json(table, "dir")));
        write_whole_file(folder / "id_text" / name, std::string_view(terrain::ids_to_text(
                                                        {1.0, 2.0, 0.25, materials}, "dir")));
    };
    write_tables("plain");
    materials[1].textures = {"dir/a b.png", "dir/d.exr", "n.png", 0.5, 0.02};
    materials[1].gravel = true;
    materials[1].hat = {0.0, 0.5, 1.0};
    materials[1].colour = glm::u8vec3(1, 2, 3);
    write_tables("full");
    write_whole_file(folder / "materials_json" / "rules",
                     std::string_view(R"({"format": "scree-rules", "version": 1, "water_level": 0.2,
        "rules": [{"material": "sand", "water_distance": {"max": 1, "soft": 0.1},
        "slope_deg": {"min": 3}, "height": {"min": 0}, "curvature": {"max": 2}}],
        "otherwise": 0})"));
    write_whole_file(folder / "materials_json" / "layers",
                     std::string_view(R"({"format": "scree-layers", "version": 1,
        "surface_depth_m": 0.2, "layers": [{"thickness_m": 0.1}, {"thickness_m": 1, "map": "deep"},
        {"thickness_m": 2, "material": "sand"}]})"));
    write_whole_file(folder / "strokes_json" / "all",
                     std::string_view(R"({"format": "scree-strokes", "version": 1, "size": [24, 16],
        "cell_size": 0.25, "ground": "sand", "strokes": [
        {"op": "brush", "at": [1, 1], "radius": 1, "hardness": 0.5, "material": "mud"},
        {"op": "brush", "points": [[1, 1], [5, 3]], "radius": 0.5, "material": 7},
        {"op": "polygon", "points": [[1, 1], [4, 1], [3, 3]], "fade": 0.5, "material": 0},
        {"op": "undo", "count": 1}, {"op": "redo"}, {"op": "fill", "at": [5, 3], "material": 7}]})"));
}

// A scene with every kind of member, and the least one.
void scene_seeds(const fs::path& folder) {
    fs::create_directories(folder);
    write_whole_file(folder / "least", std::string_view(R"({"format": "scree-scene", "version": 1,
        "ground": {"width": 9, "height": 9, "cell_size_m": 0.1}})"));
    write_whole_file(folder / "full", std::string_view(R"({"format": "scree-scene", "version": 1,
        "ground": {"heights": "h.exr", "height_scale": 2, "cell_size_m": 0.5, "shapes": [
            {"kind": "dune", "centre_m": [1, 2], "height_m": 3, "slope_deg": 50}]},
        "materials": [{"id": 4, "name": "clay", "mobility": 0.3}],
        "regions": [{"material": "clay", "disc_m": [1, 2, 3], "ragged_m": 0.1},
                    {"material": "clay", "polygon_m": [[0, 0], [1, 0], [0, 1]]}],
        "bearing_kpa_per_m": {"clay": 900},
        "objects": [{"mass_kg": 12, "force_n": [1, 2, 3], "drag_n": 5, "colour": [0, 1, 0.5],
            "shape": {"kind": "tyre", "lugs": 30},
            "motion": {"ride": "weight", "rolling": {"radius_m": 0.4}, "keys": [
                {"time_s": 0, "position_m": [0, 1, 0], "rotation_deg": [0, 90, 0]},
                {"time_s": 2, "position_m": [4, 1, 0], "quaternion": [0, 0, 0, 1],
                 "scale": 2}]}}],
        "deformer": {"slide": "weight", "time_step": 0.5}, "contact": {"outward": "radial"},
        "frames": 7, "settle": true, "camera": {"eye_m": [0, 1, 2], "target_m": [1, 0, 0]},
        "outputs": {"every": 2}})"));
}

void erosion_seeds(const fs::path& folder) {
    fs::create_directories(folder);
    const std::string head =
        R"({"format":"scree-erosion","version":1,"mesh":{"ground":{"shape":"bend","edge":0.2}},)";
    write_whole_file(
        folder / "water",
        std::string_view(head + R"("fluid":{"kind":"particles","radius":0.1,"gravity":[0,-9,0],
"domain":{"low":[-1,-1,-1],"high":[1,2,1]},"rains":[{"centre":[0,1,0],"width":1,"depth":1,"rate":9}],
"sources":[{"centre":[0,1,0],"velocity":[1,0,0],"radius":0.2,"start":1,"end":2}],
"pools":[{"low":[0,0,0],"high":[1,1,1]}],"sinks":[{"low":[0,0,0],"high":[1,1,1]}]},
"run":{"steps":3,"scheme":"sediment"},"wear":{"rim":"free"},"sediment":{"shear":"full"},
"output":{"width":64}})"));
    write_whole_file(folder / "stream",
                     std::string_view(head + R"("fluid":{"kind":"scripted","seed":2,"streams":[
{"above_bed":0.1,"speed":1},{"path":[[0,0,0],[1,0,0]],"half_width":0.1,"per_metre":5}]}})"));
    write_whole_file(folder / "file", std::string_view(R"({"format":"scree-erosion","version":1,
"mesh":{"file":"a.glb"},"fluid":{"kind":"particles"}})"));
}

// A tetrahedron in both forms of every mesh file.
void mesh_seeds(const fs::path& folder) {
    meshing::MeshFile file;
    file.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1.5F, 0}, {0, 0, -1e-3F}};
    file.mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    file.colours = {{1, 2, 3}, {4, 5, 6}, {255, 0, 128}, {9, 9, 9}};
    const std::pair<const char*, meshing::MeshFormat> formats[] = {
        {"obj", meshing::MeshFormat::Obj},
        {"ply", meshing::MeshFormat::Ply},
        {"off", meshing::MeshFormat::Off},
        {"stl", meshing::MeshFormat::Stl}};
    for (const auto& [name, format] : formats) {
        fs::create_directories(folder / name);
        for (const bool text : {false, true})
            write_whole_file(folder / name / (text ? "text" : "binary"),
                             std::string_view(meshing::encode_mesh(file, format, {.text = text})));
    }
    write_whole_file(folder / "obj" / "textured",
                     std::string_view("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                      "f 1/1/1 2/2/1 -1/-1\n"));
}

void las_seeds(const fs::path& folder) {
    fs::create_directories(folder);
    for (const int format : {0, 1, 6, 8})
        write_whole_file(
            folder / std::to_string(format),
            std::string_view(test::las_file({{1, 2, 3}, {4, 5, 6.5}}, {2, 5}, {.format = format})));
}

}  // namespace

int main(int n_words, char** words) {
    if (n_words != 2)
        return 2;
    const fs::path folder = words[1];
    image_seeds(folder / "image");
    label_seeds(folder / "labels");
    model_seeds(folder / "model");
    glb_seeds(folder / "glb");
    mesh_seeds(folder);
    las_seeds(folder / "las");
    ground_seeds(folder);
    scene_seeds(folder / "scene");
    erosion_seeds(folder / "erosion_scene");
    fs::create_directories(folder / "rocks_json");
    fs::create_directories(folder / "rocks_text");
    for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{3}}) {
        const std::string name = "rocks-" + std::to_string(n);
        vision::write_rocks_json(folder / "rocks_json" / name, rocks(n));
        vision::write_rocks_text(folder / "rocks_text" / name, rocks(n));
    }
    return 0;
}
