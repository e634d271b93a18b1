#include "base/whole_file.h"
#include "meshing/gltf/gltf_write.h"
#include "meshing/io/mesh_io.h"
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

}  // namespace

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

int main(int n_words, char** words) {
    if (n_words != 2)
        return 2;
    const fs::path folder = words[1];
    image_seeds(folder / "image");
    label_seeds(folder / "labels");
    model_seeds(folder / "model");
    glb_seeds(folder / "glb");
    mesh_seeds(folder);
    fs::create_directories(folder / "rocks_json");
    fs::create_directories(folder / "rocks_text");
    for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{3}}) {
        const std::string name = "rocks-" + std::to_string(n);
        vision::write_rocks_json(folder / "rocks_json" / name, rocks(n));
        vision::write_rocks_text(folder / "rocks_text" / name, rocks(n));
    }
    return 0;
}
