#include "apps/rock_assets.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "meshing/bake/ambient_occlusion.h"
#include "meshing/bake/height_bake.h"
#include "meshing/bake/normal_map.h"
#include "meshing/gltf/gltf_write.h"
#include "meshing/gltf/rock_scene.h"
#include "meshing/gltf/texture_atlas.h"
#include "meshing/render/raster_view.h"
#include "meshing/rocks/world_frame.h"
#include "terrain/surface/round_rocks.h"
#include "vision/data/grain_size.h"
#include "vision/data/overlay.h"
#include "vision/data/rocks_json.h"
#include "vision/data/size_plot.h"
#include "vision/image_io.h"
#include "vision/relief_signal.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <thread>

#include <glm/ext/matrix_transform.hpp>

namespace scree::apps {
namespace {

namespace fs = std::filesystem;

constexpr int kTextureQuality = 90;
constexpr int kPatchStones = 2000;
// With more vertices than these the levels are written one after another, to hold one at a time,
// pictures are drawn when they are gone, and the finest level comes last.
constexpr std::size_t kManyVertices = 2'000'000;

using LodChains = std::vector<std::vector<meshing::LodLevel>>;

// A step of the work and the time it took; steps of one list run at the same time.
struct Step {
    std::string name;
    std::function<void()> run;
    double seconds = 0.0;
};

// Everything the steps share. What a step writes no other one touches.
struct Workshop {
    const vision::RockSet& set;
    const Photo* photo;
    FloatRaster boundary;  // empty once the relief is made
    const fs::path& folder;
    const AssetOptions& options;
    OutputBatch& batch;
    Progress* progress;
    std::map<std::string, fs::path> staged = {};
    std::vector<meshing::RockMesh> meshes = {};
    std::vector<std::uint8_t> texture = {};
    vision::HeightImage heights = {};
    LabelMap labels = {};   // painted where the relief asks for them
    LodChains chains = {};  // their finest level is empty: it lies in the meshes
    std::size_t n_levels = 0;
    std::string lod_list = {};
    AssetReport report = {};

    bool has_rocks() const { return !set.rocks.empty(); }
    bool has_many_vertices() const { return report.n_vertices > kManyVertices; }

    void stage(const std::string& name) {
        staged[name] = batch.stage(folder / name);
        report.files.push_back(name);
    }
};

// Messages name the file that was meant, not the temporary one.
[[noreturn]] void fail_with_target(const IoError& error, const Workshop& shop) {
    std::string text = error.what();
    for (const auto& [name, temporary] : shop.staged) {
        const auto at = text.find(temporary.string());
        if (at != std::string::npos)
            text.replace(at, temporary.string().size(), (shop.folder / name).string());
    }
    throw IoError(text);
}

void run_steps(std::vector<Step> steps, std::string_view stage, Workshop& shop) {
    const auto caller = std::this_thread::get_id();
    std::atomic<std::size_t> n_done{0};
    report_progress(shop.progress, stage, 0.0);
    parallel_for_each_index(0, steps.size(), 1, [&](std::size_t i) {
        if (shop.progress != nullptr && shop.progress->cancelled())
            fail<Cancelled>("stopped during ", stage);
        Stopwatch watch;
        try {
            steps[i].run();
        } catch (const IoError& error) {
            fail_with_target(error, shop);
        }
        steps[i].seconds = watch.lap();
        const std::size_t done = ++n_done;
        if (std::this_thread::get_id() == caller)
            report_progress(shop.progress, stage,
                            static_cast<double>(done) / static_cast<double>(steps.size()));
    });
    for (const Step& step : steps)
        shop.report.seconds.emplace_back(step.name, step.seconds);
}

void build_meshes(Workshop& shop) {
    Stopwatch watch;
    shop.meshes = meshing::build_rock_meshes(shop.set, {.max_segments = shop.options.max_segments});
    terrain::round_rocks(shop.meshes, shop.options.weather, shop.progress);
    shop.report.mesh_seconds = watch.lap();
    for (const meshing::RockMesh& rock : shop.meshes) {
        shop.report.n_vertices += rock.mesh.positions.size();
        shop.report.n_triangles += rock.mesh.triangles.size();
    }
}

std::string level_name(std::size_t level) {
    return "lods/rocks_lod" + std::to_string(level) + ".glb";
}

// The finest level is the mesh in the GPU's order: it takes the mesh's place.
void build_chains(Workshop& shop) {
    shop.chains = meshing::build_lod_chains(shop.meshes);
    shop.n_levels = meshing::deepest_level(shop.chains);
    std::vector<std::string> files = {"rocks.glb"};
    for (std::size_t level = 1; level < shop.n_levels; ++level)
        files.push_back(level_name(level));
    if (shop.has_rocks())
        shop.lod_list = meshing::lods_json(shop.meshes, shop.chains, files);
    for (std::size_t i = 0; i < shop.meshes.size(); ++i)
        shop.meshes[i].mesh = std::move(shop.chains[i][0].mesh);
}

void write_preview(const Workshop& shop) {
    const meshing::GroundRegion region = meshing::region_of(shop.set);
    meshing::ViewScene scene;
    scene.photo = shop.photo;
    scene.ground_size = {region.width, region.depth};
    for (const meshing::RockMesh& rock : shop.meshes)
        scene.objects.push_back({&rock.mesh, glm::translate(glm::mat4(1.0F), rock.position)});
    const meshing::ViewPictures view = meshing::draw_view(scene);
    vision::write_png(
        shop.staged.at("preview.png"),
        view.textured.empty() ? view.clay : meshing::side_by_side(view.textured, view.clay));
}

void write_glb(meshing::GltfScene scene, const fs::path& path,
               const meshing::GltfWriteOptions& options) {
    StagedFile file(path);
    meshing::encode_glb(std::move(scene), options,
                        [&](std::span<const std::uint8_t> bytes) { file.write(bytes); });
    file.close();
}

void write_rocks(const Workshop& shop) {
    write_glb(shop.options.msft_lod
                  ? meshing::rock_lods_scene(shop.set, shop.meshes, shop.chains, shop.texture)
                  : meshing::rock_scene(shop.set, shop.meshes, shop.texture),
              shop.staged.at("rocks.glb"), {.quantise = shop.options.quantise, .reorder = false});
}

// Seen from further away, a level needs half the texture of the one before.
void write_level(const Workshop& shop, std::size_t level) {
    std::vector<std::uint8_t> texture;
    if (shop.photo != nullptr)
        texture =
            vision::encode_jpeg(meshing::reduced_photo(*shop.photo, 1 << level), kTextureQuality);
    write_glb(meshing::rock_lod_scene(shop.set, shop.meshes, shop.chains, level, texture),
              shop.staged.at(level_name(level)),
              {.quantise = shop.options.quantise, .reorder = false});
}

// Whoever reads the instancing extension reads quantised vertices too, so those are packed anyway.
void write_patch(const Workshop& shop) {
    const auto patch =
        meshing::scatter_rocks(shop.meshes, kPatchStones, {.seed = shop.options.seed});
    meshing::GltfScene scene = meshing::patch_scene(shop.set, shop.meshes, patch);
    if (shop.photo != nullptr)
        meshing::use_texture_atlas(scene, *shop.photo);
    write_glb(std::move(scene), shop.staged.at("patch.glb"),
              {.quantise = shop.options.quantise || !shop.options.plain_nodes,
               .instancing = !shop.options.plain_nodes});
}

void write_sizes(const Workshop& shop) {
    const vision::GrainSizeCurve curve = vision::grain_size_curve(shop.set);
    write_staged_file(shop.staged.at("sizes.csv"), vision::sizes_to_csv(curve));
    vision::write_png(shop.staged.at("sizes.png"), vision::draw_size_plot(curve));
}

LabelMap paint_set(const vision::RockSet& set) {
    std::vector<vision::Outline> outlines;
    for (const vision::Rock& rock : set.rocks)
        outlines.push_back(rock.outline);
    return vision::paint_labels(outlines, set.width, set.height);
}

void bake_heights(Workshop& shop) {
    const double detail = shop.options.relief.detail;
    if (shop.photo == nullptr || !shop.has_rocks() || detail == 0.0) {
        shop.heights = meshing::bake_displacement(shop.set);
        return;
    }
    const double radius = std::clamp(meshing::typical_radius(shop.set), 1.0, 1e5);
    const FloatRaster signal = vision::relief_signal(*shop.photo, shop.boundary, radius);
    shop.boundary = {};
    shop.labels = paint_set(shop.set);
    shop.heights = meshing::bake_displacement(shop.set, {signal, shop.labels}, shop.options.relief);
}

// What other steps read.
std::vector<Step> first_steps(Workshop& shop) {
    std::vector<Step> steps;
    steps.push_back({"heights", [&] { bake_heights(shop); }});
    steps.push_back({"meshes", [&] {
                         build_meshes(shop);
                         build_chains(shop);
                     }});
    if (shop.photo != nullptr && shop.has_rocks())
        steps.push_back(
            {"texture", [&] { shop.texture = vision::encode_jpeg(*shop.photo, kTextureQuality); }});
    return steps;
}

void stage_files(Workshop& shop) {
    std::vector<std::string> names = {"rocks.json", "labels.png"};
    if (shop.photo != nullptr)
        names.emplace_back("overlay.png");
    else
        shop.report.left_out.emplace_back("overlay.png: there is no photograph");
    names.emplace_back("preview.png");
    if (shop.has_rocks()) {
        names.emplace_back("rocks.glb");
        for (std::size_t level = 1; level < shop.n_levels; ++level)
            names.push_back(level_name(level));
        names.emplace_back("lods.json");
        names.emplace_back("patch.glb");
    } else {
        for (const char* name : {"rocks.glb", "lods.json", "patch.glb"})
            shop.report.left_out.push_back(name + std::string(": there are no rocks"));
    }
    for (const char* name :
         {"displacement.exr", "displacement.png", "normal.png", "ao.png", "sizes.csv", "sizes.png"})
        names.emplace_back(name);
    for (const std::string& name : names)
        shop.stage(name);
}

// The coarsest first, and each goes when it is written; rocks.glb comes at the very end, when
// little else is held.
void write_levels_one_by_one(Workshop& shop) {
    for (std::size_t level = shop.n_levels; --level > 0;) {
        write_level(shop, level);
        if (!shop.options.msft_lod)
            for (auto& chain : shop.chains)
                if (level < chain.size())
                    chain[level].mesh = {};
    }
}

void write_rocks_last(Workshop& shop) {
    if (shop.options.msft_lod)
        write_rocks(shop);
    else
        write_glb(meshing::rock_scene(shop.set, std::move(shop.meshes), std::move(shop.texture)),
                  shop.staged.at("rocks.glb"),
                  {.quantise = shop.options.quantise, .reorder = false});
}

void add_mesh_steps(Workshop& shop, std::vector<Step>& steps) {
    if (shop.has_many_vertices()) {
        steps.push_back({"lods", [&shop] { write_levels_one_by_one(shop); }});
    } else {
        steps.push_back({"rocks", [&shop] { write_rocks(shop); }});
        for (std::size_t level = 1; level < shop.n_levels; ++level)
            steps.push_back(
                {"lod " + std::to_string(level), [&shop, level] { write_level(shop, level); }});
    }
    steps.push_back(
        {"lod list", [&shop] { write_staged_file(shop.staged.at("lods.json"), shop.lod_list); }});
}

Step preview_step(const Workshop& shop) {
    return {"preview", [&shop] { write_preview(shop); }};
}

void add_overlay_step(const Workshop& shop, std::vector<Step>& steps) {
    if (shop.photo != nullptr)
        steps.push_back({"overlay", [&shop] {
                             vision::write_png(shop.staged.at("overlay.png"),
                                               vision::draw_overlay(*shop.photo, shop.set));
                         }});
}

// The longest first, so that no thread waits long at the end.
std::vector<Step> last_steps(Workshop& shop) {
    const auto path = [&shop](const char* name) { return shop.staged.at(name); };
    std::vector<Step> steps;
    if (shop.has_rocks())
        steps.push_back({"patch", [&] { write_patch(shop); }});
    if (!shop.has_many_vertices()) {
        steps.push_back(preview_step(shop));
        add_overlay_step(shop, steps);
    }
    steps.push_back({"normals", [&, path] {
                         vision::write_data_png(path("normal.png"),
                                                meshing::normal_map(shop.heights));
                     }});
    steps.push_back({"occlusion", [&, path] {
                         vision::write_png(path("ao.png"),
                                           meshing::ambient_occlusion(shop.heights));
                     }});
    if (shop.has_rocks())
        add_mesh_steps(shop, steps);
    steps.push_back({"displacement exr", [&, path] {
                         vision::write_heights_exr(path("displacement.exr"), shop.heights);
                     }});
    steps.push_back({"displacement png", [&, path] {
                         vision::write_heights_png(path("displacement.png"), shop.heights);
                     }});
    steps.push_back({"labels", [&, path] {
                         vision::write_labels(path("labels.png"), shop.labels.empty()
                                                                      ? paint_set(shop.set)
                                                                      : shop.labels);
                     }});
    steps.push_back({"rocks.json", [&, path] {
                         write_staged_file(path("rocks.json"), vision::rocks_to_json(shop.set));
                     }});
    steps.push_back({"sizes", [&] { write_sizes(shop); }});
    return steps;
}

// What was put off to hold less: the preview needs the meshes that the last file takes away.
void finish_thriftily(Workshop& shop) {
    shop.heights = {};
    shop.labels = {};
    run_steps({preview_step(shop)}, "drawing pictures", shop);
    std::vector<Step> steps;
    steps.push_back({"rocks", [&shop] { write_rocks_last(shop); }});
    add_overlay_step(shop, steps);
    run_steps(std::move(steps), "writing meshes", shop);
}

}  // namespace

AssetReport write_rock_assets(const vision::RockSet& set, RockPicture picture,
                              const fs::path& folder, const AssetOptions& options,
                              OutputBatch& batch, Progress* progress) {
    check(options);
    vision::check_rock_set(set, "the set of rocks");
    const Photo* photo = picture.photo;
    if (photo != nullptr && (photo->width() != set.width || photo->height() != set.height))
        fail<InvalidInput>("the photograph has ", photo->width(), " x ", photo->height(),
                           " pixels, its rocks were found on ", set.width, " x ", set.height);
    Workshop shop{set, photo, std::move(picture.boundary), folder, options, batch, progress};
    run_steps(first_steps(shop), "building meshes", shop);
    stage_files(shop);
    run_steps(last_steps(shop), "writing files", shop);
    if (shop.has_many_vertices())
        finish_thriftily(shop);
    return shop.report;
}

}  // namespace scree::apps
