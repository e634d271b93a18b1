#include "terrain/view/ground_textures.h"

#include "terrain/view/look_layers.h"
#include "terrain/view/view_shaders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <epoxy/gl.h>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

CellWindow united(const CellWindow& a, const CellWindow& b) {
    if (a.empty() || b.empty())
        return a.empty() ? b : a;
    const int x = std::min(a.x, b.x);
    const int y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x,
            std::max(a.y + a.height, b.y + b.height) - y};
}

CellWindow shown_window(const GlContext& context, const TerrainGround& ground) {
    if (ground.base == nullptr)
        fail<InvalidInput>("the ground has no heights");
    check_heightfield(*ground.base);
    const CellWindow all{0, 0, ground.base->heights.width(), ground.base->heights.height()};
    const CellWindow window = ground.window.empty() ? all : intersection(all, ground.window);
    if (window.width < 2 || window.height < 2)
        fail<InvalidInput>("the window to show has ", window.width, " x ", window.height,
                           " cells of the ground, at least 2 x 2 are needed");
    const int limit = context.max_texture_size();
    if (window.width > limit || window.height > limit)
        fail<InvalidInput>("the window to show has ", window.width, " x ", window.height,
                           " cells, ", context.device(), " draws at most ", limit, " x ", limit,
                           ": show a smaller window");
    return window;
}

void clamp_to_edge(const GlTexture& texture, GLint filter) {
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, filter);
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

GlTexture plane(int width, int height, GLenum format, GLint filter) {
    GlTexture texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.id(), 1, format, width, height);
    clamp_to_edge(texture, filter);
    return texture;
}

// What the texels of an array are, on the device and in memory.
struct Texels {
    GLenum stored, format, type;
};

GlTexture repeating_layers(const void* texels, int side, int n_layers, const Texels& form) {
    int n_levels = 1;
    while ((side >> n_levels) > 0)
        ++n_levels;
    GlTexture texture(GL_TEXTURE_2D_ARRAY);
    glTextureStorage3D(texture.id(), n_levels, form.stored, side, side, std::max(1, n_layers));
    if (n_layers > 0)
        glTextureSubImage3D(texture.id(), 0, 0, 0, 0, side, side, n_layers, form.format, form.type,
                            texels);
    glGenerateTextureMipmap(texture.id());
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, GL_REPEAT);
    return texture;
}

void check_ids(const DescriptionMap& map) {
    std::array<bool, 256> known{};
    for (const Material& material : map.materials) {
        if (material.id < 0 || material.id > 255)
            fail<InvalidInput>("material ", material.name, " has id ", material.id,
                               ", it must be in [0, 255]");
        known[static_cast<std::size_t>(material.id)] = true;
    }
    for (int y = 0; y < map.ids.height(); ++y)
        for (int x = 0; x < map.ids.width(); ++x)
            if (!known[map.ids(x, y)])
                fail<InvalidInput>("map cell (", x, ", ", y, ") has id ", int{map.ids(x, y)},
                                   ", no material has it");
}

// The map's table with the looks in the place of its textures: what the blend is made for.
std::vector<Material> shown_materials(const DescriptionMap* map,
                                      const std::vector<MaterialLook>& looks) {
    std::vector<Material> shown(
        std::max<std::size_t>(1, map != nullptr ? map->materials.size() : 0));
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const MaterialLook& look = looks[i];
        Material& one = shown[i];
        one.name = "look " + std::to_string(i);
        if (map != nullptr && i < map->materials.size()) {
            one.id = map->materials[i].id;
            one.hat = map->materials[i].hat;
        }
        one.textures.albedo = look.albedo.empty() ? "" : "albedo";
        one.textures.displacement = look.displacement.empty() ? "" : "displacement";
        one.textures.size_m = look.size_m;
        one.colour = glm::u8vec3(glm::round(glm::clamp(look.colour, 0.0F, 1.0F) * 255.0F));
    }
    return shown;
}

}  // namespace

GroundTextures::GroundTextures(const GlContext& context, const TerrainGround& ground)
    : window_(shown_window(context, ground)),
      cell_size_(static_cast<float>(ground.base->cell_size)),
      origin_(glm::dvec2(window_.x, window_.y) * ground.base->cell_size),
      size_(glm::dvec2(window_.width, window_.height) * ground.base->cell_size),
      surface_program_("the ground's slopes", {{ShaderStage::Compute, surface_compute_glsl()}}),
      sun_program_("the ground's sunlight", {{ShaderStage::Compute, sun_compute_glsl()}}) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    load_heights(*ground.base);
    load_map(context, ground);
    load_looks(context, ground);
    dirty_ = {0, 0, window_.width, window_.height};
    check_gl("loading the ground");
}

void GroundTextures::load_heights(const Heightfield& base) {
    base_ = plane(window_.width, window_.height, GL_R32F, GL_LINEAR);
    moved_ = plane(window_.width, window_.height, GL_R32F, GL_LINEAR);
    surface_ = plane(window_.width, window_.height, GL_RGBA16F, GL_LINEAR);
    sun_reach_ = plane(window_.width, window_.height, GL_R8, GL_LINEAR);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, base.heights.width());
    glTextureSubImage2D(base_.id(), 0, 0, 0, window_.width, window_.height, GL_RED, GL_FLOAT,
                        base.heights.row(window_.y) + window_.x);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    const float zero = 0.0F;
    glClearTexImage(moved_.id(), 0, GL_RED, GL_FLOAT, &zero);
    base_lowest_ = base_highest_ = base.heights(window_.x, window_.y);
    for (int y = 0; y < window_.height; ++y) {
        const float* row = base.heights.row(window_.y + y) + window_.x;
        const auto [low, high] = std::minmax_element(row, row + window_.width);
        base_lowest_ = std::min(base_lowest_, *low);
        base_highest_ = std::max(base_highest_, *high);
    }
    lowest_ = base_lowest_;
    highest_ = base_highest_;
}

void GroundTextures::load_map(const GlContext& context, const TerrainGround& ground) {
    Raster<std::uint8_t> ids(1, 1, 0);
    if (ground.map != nullptr && !ground.map->ids.empty()) {
        if (!(ground.map->cell_size > 0.0))
            fail<InvalidInput>("the description map's cell size is ", ground.map->cell_size,
                               " m, it must be positive");
        check_ids(*ground.map);
        ids = ground.map->ids;
        map_cells_per_m_ = static_cast<float>(1.0 / ground.map->cell_size);
    }
    const int limit = context.max_texture_size();
    if (ids.width() > limit || ids.height() > limit)
        fail<InvalidInput>("the description map has ", ids.width(), " x ", ids.height(), " cells, ",
                           context.device(), " holds at most ", limit, " x ", limit);
    ids_ = plane(ids.width(), ids.height(), GL_R8UI, GL_NEAREST);
    glTextureSubImage2D(ids_.id(), 0, 0, 0, ids.width(), ids.height(), GL_RED_INTEGER,
                        GL_UNSIGNED_BYTE, ids.data());
}

void GroundTextures::load_looks(const GlContext& context, const TerrainGround& ground) {
    std::vector<MaterialLook> plain;
    const std::size_t n_wanted =
        ground.map != nullptr ? std::max<std::size_t>(1, ground.map->materials.size()) : 1;
    if (ground.looks.empty())
        plain = ground.map != nullptr ? plain_looks(*ground.map) : std::vector<MaterialLook>(1);
    const std::vector<MaterialLook>& looks = ground.looks.empty() ? plain : ground.looks;
    if (looks.size() < n_wanted)
        fail<InvalidInput>("there are ", looks.size(), " looks for ", n_wanted, " materials");
    if (looks.size() > static_cast<std::size_t>(context.max_texture_layers()))
        fail<InvalidInput>("there are ", looks.size(), " looks, ", context.device(),
                           " holds at most ", context.max_texture_layers());
    LookLayers layers = make_look_layers({looks.data(), n_wanted});
    const std::vector<Material> shown = shown_materials(ground.map, looks);
    shaders_ =
        ground_shaders(shown, 1.0 / double{map_cells_per_m_}, {.binding = TextureBinding::Layers});
    side_ = layers.side;
    albedo_ =
        repeating_layers(layers.albedo.data(), side_, static_cast<int>(shaders_.albedo.size()),
                         {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE});
    detail_ = repeating_layers(layers.detail.data(), side_, static_cast<int>(n_wanted),
                               {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE});
    relief_ = repeating_layers(layers.relief.data(), side_,
                               static_cast<int>(shaders_.displacement.size()),
                               {GL_R16F, GL_RED, GL_FLOAT});
    for (std::size_t i = 0; i < n_wanted && !ground.rocks.places.empty(); ++i)
        layers.records[i].kind.x =
            ground.map == nullptr || ground.map->materials[i].gravel ? 1.0F : 0.0F;
    looks_ = GlBuffer(0U);
    glNamedBufferStorage(looks_.id(),
                         static_cast<GLsizeiptr>(layers.records.size() * sizeof(LookRecord)),
                         layers.records.data(), 0);
    for (const LookRecord& record : layers.records) {
        detail_reach_ = std::max(detail_reach_, 0.5F * record.measure.y);
    }
}

void GroundTextures::update(const FloatRaster& displacement, const CellWindow& changed) {
    const CellWindow cells = changed.empty() ? window_ : changed;
    if (displacement.width() != cells.width || displacement.height() != cells.height)
        fail<InvalidInput>("the displacement has ", displacement.width(), " x ",
                           displacement.height(), " cells, its window ", cells.width, " x ",
                           cells.height);
    const CellWindow shown = intersection(cells, window_);
    if (shown.empty())
        return;
    for (int y = shown.y; y < shown.y + shown.height; ++y) {
        const float* row = displacement.row(y - cells.y) + (shown.x - cells.x);
        for (int x = 0; x < shown.width; ++x)
            if (!std::isfinite(row[x]))
                fail<InvalidInput>("the displacement of cell (", shown.x + x, ", ", y,
                                   ") is no finite number");
        const auto [low, high] = std::minmax_element(row, row + shown.width);
        lowest_ = std::min(lowest_, base_lowest_ + *low);
        highest_ = std::max(highest_, base_highest_ + *high);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, cells.width);
    glTextureSubImage2D(moved_.id(), 0, shown.x - window_.x, shown.y - window_.y, shown.width,
                        shown.height, GL_RED, GL_FLOAT,
                        displacement.row(shown.y - cells.y) + (shown.x - cells.x));
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    dirty_ = united(dirty_, {shown.x - window_.x, shown.y - window_.y, shown.width, shown.height});
}

void GroundTextures::run(const ShaderProgram& program, const GlTexture& out, unsigned format,
                         const CellWindow& cells) const {
    program.set("window_origin", glm::ivec2(cells.x, cells.y));
    program.set("window_size", glm::ivec2(cells.width, cells.height));
    program.set("cell_size", cell_size_);
    program.use();
    glBindImageTexture(0, out.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, format);
    glDispatchCompute(static_cast<GLuint>((cells.width + 15) / 16),
                      static_cast<GLuint>((cells.height + 15) / 16), 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void GroundTextures::finish(const glm::vec3& sun_direction) {
    const CellWindow all{0, 0, window_.width, window_.height};
    const bool new_sun = sun_direction != sun_;
    if (dirty_.empty() && !new_sun)
        return;
    glBindTextureUnit(kBaseUnit, base_.id());
    glBindTextureUnit(kMovedUnit, moved_.id());
    constexpr int kSkyReach = 20;  // cells that open_sky() looks away
    if (!dirty_.empty())
        run(surface_program_, surface_, GL_RGBA16F,
            intersection(all, {dirty_.x - kSkyReach, dirty_.y - kSkyReach,
                               dirty_.width + 2 * kSkyReach, dirty_.height + 2 * kSkyReach}));
    // A shadow of the changed cells falls away from the sun, no farther than their height allows.
    const float flat = std::max(glm::length(glm::vec2(sun_direction.x, sun_direction.z)), 1e-6F);
    const float longest = (highest_ - lowest_) * flat / std::max(sun_direction.y, 1e-3F);
    const int reach = static_cast<int>(std::min(longest / cell_size_,
                                                static_cast<float>(all.width + all.height))) +
                      2;
    sun_program_.set("sun_direction", sun_direction);
    sun_program_.set("highest", highest_);
    run(sun_program_, sun_reach_, GL_R8,
        new_sun ? all
                : intersection(all, {dirty_.x - reach, dirty_.y - reach, dirty_.width + 2 * reach,
                                     dirty_.height + 2 * reach}));
    sun_ = sun_direction;
    dirty_ = {};
}

float GroundTextures::base_height(float x, float z) const {
    const auto cell = [&](float at, float origin, int count) {
        return static_cast<int>(
            std::clamp((at - origin) / cell_size_, 0.0F, static_cast<float>(count - 1)));
    };
    float height = 0.0F;
    glGetTextureSubImage(base_.id(), 0, cell(x, origin_.x, window_.width),
                         cell(z, origin_.y, window_.height), 0, 1, 1, 1, GL_RED, GL_FLOAT,
                         sizeof height, &height);
    return height;
}

void GroundTextures::bind() const {
    const std::array<const GlTexture*, 7> units{&base_, &moved_,  &surface_, &sun_reach_,
                                                &ids_,  &albedo_, &detail_};
    for (std::size_t i = 0; i < units.size(); ++i)
        glBindTextureUnit(static_cast<GLuint>(i), units[i]->id());
    glBindTextureUnit(kReliefUnit, relief_.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, looks_.id());
}

void GroundTextures::set_samplers(const ShaderProgram& program) {
    program.set("scree_ids", int{kIdUnit});
    program.set("scree_albedo", int{kAlbedoUnit});
    program.set("scree_displacement", int{kReliefUnit});
}

void GroundTextures::set_uniforms(const ShaderProgram& program) const {
    program.set("ground_origin", origin_);
    program.set("per_ground_size", 1.0F / size_);
    program.set("cell_size", cell_size_);
    program.set("detail_texels", static_cast<float>(side_));
    program.set("patch_size", 0.13F * std::max(size_.x, size_.y));
}

}  // namespace scree::terrain
