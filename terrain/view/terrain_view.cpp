#include "terrain/view/terrain_view.h"

#include "terrain/view/ground_textures.h"
#include "terrain/view/near_rocks.h"
#include "terrain/view/object_depth.h"
#include "terrain/view/picture_target.h"
#include "terrain/view/tessellation.h"
#include "terrain/view/view_matrices.h"
#include "terrain/view/view_meshes.h"
#include "terrain/view/view_shaders.h"

#include <algorithm>
#include <cmath>
#include <epoxy/gl.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace scree::terrain {
namespace {

// A round number near a twentieth of the span: 1, 2 or 5 times a power of ten.
double round_interval(double span) {
    const double wanted = std::max(span, 1e-9) / 20.0;
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * decade >= wanted)
            return step * decade;
    return 10.0 * decade;
}

int columns_for(const TerrainViewOptions& options, const glm::vec2& size) {
    const double longer = std::max(size.x, size.y);
    const double along =
        options.lattice > 0 ? options.lattice : std::clamp(options.width / 10.0, 24.0, 160.0);
    return std::max(1, static_cast<int>(std::lround(along * size.x / longer)));
}

// Diagonal of an object's bounds, metres.
float object_size(const TerrainObject& object) {
    const ViewBox box = bounds_of({object}, glm::vec3(0.0F));
    return std::max(glm::length(box.high - box.low), 1e-6F);
}

GroundArea area_of(const GroundTextures& ground) {
    return {ground.origin().x, ground.origin().y, ground.size().x, ground.size().y};
}

}  // namespace

struct TerrainView::State {
    GlContext& context;
    TerrainViewOptions options;
    GroundTextures ground;
    PictureTarget target;
    Lattice lattice_shape;
    DrawnMesh lattice, walls;
    ObjectMeshes objects;
    NearRocks rocks;
    GlVertexArray no_corners;
    DepthMap shadow_map, undersides;
    ShaderProgram depth_program, line_program, ground_program, wall_program, object_program,
        shadow_program, rock_program, rock_shadow_program;

    // Of the frame being drawn.
    glm::mat4 clip{1.0F}, shadow{1.0F};
    glm::vec3 sun{0.0F, 1.0F, 0.0F};
    ViewBox objects_box;        // of the objects alone
    float shadow_reach = 0.0F;  // texels of the shadow map this far apart are told apart, metres
    float foot = 0.0F;
    float near_m = 0.0F;  // within it rocks are meshes; 0 where there are none

    State(GlContext& ctx, const TerrainGround& shown, const TerrainViewOptions& wanted)
        : context(ctx),
          options(wanted),
          ground(ctx, shown),
          target(ctx, wanted.width, wanted.height, wanted.supersampling),
          rocks(shown.rocks),
          no_corners(0U),
          shadow_map(std::min(wanted.shadow_size, ctx.max_texture_size()), true),
          undersides(256, false) {
        load_programs();
        const GroundArea area = area_of(ground);
        lattice_shape = make_lattice(area, columns_for(options, ground.size()));
        lattice = upload_lattice(lattice_shape);
        lattice_shape.positions.clear();
        lattice_shape.patches.clear();
        walls = upload_walls(area, std::max(area.width, area.depth) / 512.0);
        check_gl("making the view");
    }
    ~State() { context.make_current(); }

    void load_programs();
    void prepare(const TerrainFrame& frame);
    void set_common(const ShaderProgram& program, const TerrainFrame& frame) const;
    void draw_object_depths(const TerrainFrame& frame);
    void draw_lattice(const TerrainFrame& frame, const ShaderProgram& program) const;
    void draw_ground(const TerrainFrame& frame, ViewMode mode) const;
    void draw_walls(const TerrainFrame& frame) const;
    void draw_rocks(const TerrainFrame& frame);
    void draw_objects(const TerrainFrame& frame);
    TessellationRule rule(const TerrainFrame& frame) const;
};

void TerrainView::State::load_programs() {
    depth_program =
        ShaderProgram("the ground's depth",
                      {{ShaderStage::Vertex, ground_vertex_glsl()},
                       {ShaderStage::TessControl, ground_control_glsl()},
                       {ShaderStage::TessEvaluation, ground_evaluation_glsl(ground.shaders())},
                       {ShaderStage::Fragment, shadow_fragment_glsl()}});
    line_program = ShaderProgram(
        "the wires", {{ShaderStage::Vertex, ground_vertex_glsl()},
                      {ShaderStage::TessControl, ground_control_glsl()},
                      {ShaderStage::TessEvaluation, ground_evaluation_glsl(ground.shaders())},
                      {ShaderStage::Fragment, line_fragment_glsl()}});
    ground_program = ShaderProgram(
        "the ground", {{ShaderStage::Vertex, screen_vertex_glsl()},
                       {ShaderStage::Fragment, ground_fragment_glsl(ground.shaders())}});
    wall_program =
        ShaderProgram("the walls", {{ShaderStage::Vertex, wall_vertex_glsl()},
                                    {ShaderStage::Fragment, wall_fragment_glsl(ground.shaders())}});
    object_program =
        ShaderProgram("the objects", {{ShaderStage::Vertex, object_vertex_glsl()},
                                      {ShaderStage::Fragment, object_fragment_glsl()}});
    shadow_program =
        ShaderProgram("the shadows", {{ShaderStage::Vertex, shadow_vertex_glsl()},
                                      {ShaderStage::Fragment, shadow_fragment_glsl()}});
    if (!rocks.empty()) {
        rock_program = ShaderProgram(
            "the rocks", {{ShaderStage::Vertex, near_rock_vertex_glsl()},
                          {ShaderStage::Fragment, near_rock_fragment_glsl(ground.shaders())}});
        rock_shadow_program =
            ShaderProgram("the rocks' shadows", {{ShaderStage::Vertex, near_rock_vertex_glsl()},
                                                 {ShaderStage::Fragment, shadow_fragment_glsl()}});
        GroundTextures::set_samplers(rock_program);
        GroundTextures::set_samplers(rock_shadow_program);
    }
    for (const ShaderProgram* program :
         {&depth_program, &line_program, &ground_program, &wall_program})
        GroundTextures::set_samplers(*program);
}

TessellationRule TerrainView::State::rule(const TerrainFrame& frame) const {
    TessellationRule rule;
    rule.reference = frame.camera.target;
    if (options.refine_at == RefineAt::Object && !frame.objects.empty())
        rule.reference = glm::vec3(frame.objects.front().world_from_object[3]);
    rule.reference.y = ground.base_height(rule.reference.x, rule.reference.z);
    rule.radius = options.refine_radius_m > 0.0 ? static_cast<float>(options.refine_radius_m)
                                                : 0.5F * std::max(ground.size().x, ground.size().y);
    rule.amount = static_cast<float>(options.tessellation);
    return rule;
}

// Matrices, the sun, and the ground as this frame has it.
void TerrainView::State::prepare(const TerrainFrame& frame) {
    if (frame.displacement != nullptr)
        ground.update(*frame.displacement, frame.changed);
    sun = sun_direction(frame.light);
    ground.finish(sun);
    const glm::vec2 low = ground.origin();
    const glm::vec2 high = low + ground.size();
    const float reach = ground.detail_reach();
    foot = ground.lowest() - reach - 0.045F * std::max(ground.size().x, ground.size().y);
    const ViewBox block{{low.x, foot, low.y}, {high.x, ground.highest() + reach, high.y}};
    const glm::vec3 middle = 0.5F * (block.low + block.high);
    objects_box = bounds_of(frame.objects, middle);
    ViewBox scene = block;
    scene.add(objects_box.low);
    scene.add(objects_box.high);
    ViewBox casters = objects_box;
    ViewBox near = rocks.bounds(frame.camera.eye, near_m);
    if (near.low.x <= near.high.x) {
        near.low.y += ground.lowest();
        near.high.y += ground.highest();
        if (frame.objects.empty())
            casters = near;
        casters.add(near.low);
        casters.add(near.high);
    }
    shadow_reach =
        2.0F * glm::distance(casters.low, casters.high) / static_cast<float>(shadow_map.size());
    clip =
        clip_from_world(frame.camera, static_cast<double>(options.width) / options.height, scene);
    shadow = shadow_from_world(sun, casters, block);
}

void TerrainView::State::set_common(const ShaderProgram& program, const TerrainFrame& frame) const {
    ground.set_uniforms(program);
    program.set("clip_from_world", clip);
    program.set("shadow_from_world", shadow);
    program.set("sun_direction", sun);
    program.set("light_strength", glm::vec2(frame.light.strength, frame.light.sky));
    program.set("eye", frame.camera.eye);
    program.set("near_m", near_m);
}

// The objects' and the near rocks' depth from the sun, and the objects' from straight below.
void TerrainView::State::draw_object_depths(const TerrainFrame& frame) {
    // The map's matrix ends at 0 to 1; clip space wants -1 to 1.
    glm::mat4 clip_from_map(2.0F);
    clip_from_map[3] = glm::vec4(-1.0F, -1.0F, -1.0F, 1.0F);
    const auto draw = [&](const glm::mat4& map_from_world) {
        shadow_program.use();
        for (const TerrainObject& object : frame.objects) {
            const DrawnMesh& mesh = objects.get(object);
            shadow_program.set("shadow_from_object",
                               clip_from_map * map_from_world * object.world_from_object);
            glBindVertexArray(mesh.array.id());
            glDrawArrays(GL_TRIANGLES, 0, mesh.n_drawn);
        }
    };
    shadow_map.fill([&] {
        draw(shadow);
        if (!(near_m > 0.0F))
            return;
        set_common(rock_shadow_program, frame);
        rock_shadow_program.set("clip_from_world", clip_from_map * shadow);
        rocks.draw(rock_shadow_program, frame.camera.eye, near_m);
    });
    undersides.fill([&] { draw(under_from_world(objects_box)); });
}

void TerrainView::State::draw_lattice(const TerrainFrame& frame,
                                      const ShaderProgram& program) const {
    const TessellationRule refined = rule(frame);
    const double pixel =
        2.0 * std::tan(glm::radians(frame.camera.field_of_view_deg / 2.0)) / options.height;
    const double far_m = options.far_m > 0.0 ? options.far_m : 8.0 * ground.cell_size() / pixel;
    set_common(program, frame);
    program.set("reference", refined.reference);
    program.set("per_radius2", per_radius2(refined));
    program.set("amount", refined.amount);
    program.set("lattice_step", static_cast<float>(lattice_shape.step));
    program.set("slack", ground.highest() - ground.lowest() + ground.detail_reach());
    program.set("far_m", static_cast<float>(far_m));
    program.use();
    glBindVertexArray(lattice.array.id());
    glPatchParameteri(GL_PATCH_VERTICES, 6);
    glDrawElements(GL_PATCHES, lattice.n_drawn, GL_UNSIGNED_INT, nullptr);
}

// The ground's depth, then its colours and the sky's from that.
void TerrainView::State::draw_ground(const TerrainFrame& frame, ViewMode mode) const {
    target.bind_depth();
    if (mode == ViewMode::Wire) {
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(1.0F, 2.0F);
    }
    draw_lattice(frame, depth_program);
    glDisable(GL_POLYGON_OFFSET_FILL);

    target.bind_colours();
    glBindTextureUnit(kDepthUnit, target.depth_texture());
    const float span = std::max(ground.highest() - ground.lowest(), 1e-9F);
    const double contour = options.contour_m > 0.0 ? options.contour_m : round_interval(span);
    set_common(ground_program, frame);
    ground_program.set("mode", static_cast<int>(mode));
    ground_program.set("world_from_clip", glm::inverse(clip));
    ground_program.set("sample_size",
                       2.0F / glm::vec2(target.samples_across(), target.samples_down()));
    ground_program.set("height_scale",
                       glm::vec3(ground.lowest(), 1.0F / span, static_cast<float>(contour)));
    const ViewBox& under = objects_box;
    const glm::vec3 size = glm::max(under.high - under.low, glm::vec3(1e-6F));
    ground_program.set("under_area",
                       glm::vec4(under.low.x, under.low.z, 1.0F / size.x, 1.0F / size.z));
    ground_program.set("under_range", glm::vec2(under.low.y, size.y));
    ground_program.set("under_size",
                       frame.objects.empty() ? 0.0F : object_size(frame.objects.front()));
    ground_program.use();
    glBindVertexArray(no_corners.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);

    target.bind_both();
    if (mode != ViewMode::Wire)
        return;
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    draw_lattice(frame, line_program);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void TerrainView::State::draw_walls(const TerrainFrame& frame) const {
    if (!options.ground_block)
        return;
    set_common(wall_program, frame);
    wall_program.set("foot", foot);
    wall_program.use();
    glBindVertexArray(walls.array.id());
    glDrawArrays(GL_TRIANGLES, 0, walls.n_drawn);
}

void TerrainView::State::draw_rocks(const TerrainFrame& frame) {
    if (!(near_m > 0.0F))
        return;
    set_common(rock_program, frame);
    rock_program.set("normal_reach", shadow_reach);
    rocks.draw(rock_program, frame.camera.eye, near_m);
}

void TerrainView::State::draw_objects(const TerrainFrame& frame) {
    set_common(object_program, frame);
    object_program.use();
    for (const TerrainObject& object : frame.objects) {
        const DrawnMesh& mesh = objects.get(object);
        glm::vec3 colour;
        for (int i = 0; i < 3; ++i)
            colour[i] = std::pow(std::clamp(object.colour[i], 0.0F, 1.0F), 2.2F);
        const float size = object_size(object);
        object_program.set("object_colour", colour);
        object_program.set("object_roughness", std::clamp(object.roughness, 0.05F, 1.0F));
        object_program.set("object_size", size);
        object_program.set("normal_reach", 0.004F * size);
        object_program.set("world_from_object", object.world_from_object);
        object_program.set("normal_from_object",
                           glm::transpose(glm::inverse(object.world_from_object)));
        glBindVertexArray(mesh.array.id());
        glDrawArrays(GL_TRIANGLES, 0, mesh.n_drawn);
    }
    objects.end_frame();
}

TerrainView::TerrainView(GlContext& context, const TerrainGround& ground,
                         const TerrainViewOptions& options) {
    check(options);
    context.make_current();
    state_ = std::make_unique<State>(context, ground, options);
}
TerrainView::~TerrainView() = default;
TerrainView::TerrainView(TerrainView&&) noexcept = default;
TerrainView& TerrainView::operator=(TerrainView&&) noexcept = default;

Photo TerrainView::draw(const TerrainFrame& frame, ViewMode mode) {
    State& s = *state_;
    s.context.make_current();
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    s.near_m = mode == ViewMode::Textured && !s.rocks.empty() ? static_cast<float>(s.options.near_m)
                                                              : 0.0F;
    s.prepare(frame);
    s.ground.bind();
    s.draw_object_depths(frame);
    glBindTextureUnit(kShadowUnit, s.shadow_map.texture());
    glBindTextureUnit(kUnderUnit, s.undersides.texture());
    s.draw_ground(frame, mode);
    s.draw_walls(frame);
    s.draw_rocks(frame);
    s.draw_objects(frame);
    return s.target.read();
}

}  // namespace scree::terrain
