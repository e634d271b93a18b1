#include "terrain/gpu/deformer_gpu.h"

#include "base/error.h"
#include "terrain/gpu/deformer_shaders.h"
#include "terrain/gpu/gl_objects.h"
#include "terrain/gpu/shader_program.h"
#include "terrain/gpu/soil_palette.h"
#include "terrain/grid/literal_step.h"
#include "terrain/grid/sound_step.h"
#include "terrain/grid/whole_quanta.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <epoxy/gl.h>
#include <limits>
#include <vector>

namespace scree::terrain {
namespace {

constexpr int kMostIterations = 4;  // of one dispatch; deformer_shaders.cpp
constexpr int kTile = 16;

struct DeviceReport {
    std::uint32_t greatest_move = 0;
    std::uint32_t compacted_low = 0;
    std::uint32_t compacted_high = 0;
    std::uint32_t unused = 0;
};

GlTexture plane(int width, int height, GLenum format) {
    GlTexture texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.id(), 1, format, width, height);
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

// Loads added up over the window that holds them all.
struct SummedLoad {
    CellWindow window;
    Raster<std::array<float, 3>> cells;  // force x, force z, underside
};

SummedLoad summed(std::span<const Load> loads, const CellWindow& extent) {
    SummedLoad sum;
    int right = 0;
    int bottom = 0;
    for (const Load& load : loads) {
        check_load(load);
        const CellWindow w = intersection(load.window, extent);
        if (w.empty())
            continue;
        const bool first = right == 0;
        sum.window.x = first ? w.x : std::min(sum.window.x, w.x);
        sum.window.y = first ? w.y : std::min(sum.window.y, w.y);
        right = std::max(right, w.x + w.width);
        bottom = std::max(bottom, w.y + w.height);
    }
    sum.window.width = right - sum.window.x;
    sum.window.height = bottom - sum.window.y;
    if (right == 0)
        return {};
    sum.cells = Raster<std::array<float, 3>>(sum.window.width, sum.window.height,
                                             {0.0F, 0.0F, std::numeric_limits<float>::infinity()});
    for (const Load& load : loads) {
        const CellWindow w = intersection(load.window, extent);
        for (int y = w.y; y < w.y + w.height; ++y)
            for (int x = w.x; x < w.x + w.width; ++x) {
                auto& cell = sum.cells(x - sum.window.x, y - sum.window.y);
                const int lx = x - load.window.x;
                const int ly = y - load.window.y;
                cell[0] += load.force_x(lx, ly);
                cell[1] += load.force_z(lx, ly);
                cell[2] = std::min(cell[2], load.underside(lx, ly));
            }
    }
    return sum;
}

// The checks that every deformer of this ground makes.
void check_by_deformer(const Heightfield& base, const SoilField& soil,
                       const DeformerOptions& options) {
    check(options);
    const Deformer checked(base, soil, options);
}

}  // namespace

struct GpuDeformer::State {
    GlContext& context;
    const Heightfield& base;
    DeformerOptions options;
    SoundRule rule;
    int width, height;
    bool literal;  // `moved` then holds base and displacement as one height, as Deformer does
    bool palette = true;
    GlTexture base_heights, soils, loads;
    std::array<GlTexture, 2> moved;
    GlBuffer table, report;
    ShaderProgram tiles, under_loads, literal_cells;
    int now = 0;  // which of `moved` holds the displacements

    State(GlContext& ctx, const Heightfield& ground, const SoilField& soil,
          const DeformerOptions& wanted);
    ~State() { context.make_current(); }

    void load_soils(const SoilField& soil, bool weighted);
    void load_programs(bool weighted);
    void set_rule(const ShaderProgram& program) const;
    void set_literal_rule() const;
    void step_loaded(const ShaderProgram& program, const SummedLoad& load);
    void bind() const;
    void dispatch(const ShaderProgram& program);
    DeformerReport run(std::span<const Load> given, float& greatest_move);
    CellWindow extent() const { return {0, 0, width, height}; }
};

GpuDeformer::State::State(GlContext& ctx, const Heightfield& ground, const SoilField& soil,
                          const DeformerOptions& wanted)
    : context(ctx),
      base(ground),
      options(wanted),
      rule(sound_rule(ground, wanted)),
      width(ground.heights.width()),
      height(ground.heights.height()),
      literal(wanted.reading == Reading::Literal) {
    const int limit = context.max_texture_size();
    if (width > limit || height > limit)
        fail<InvalidInput>("the ground has ", width, " x ", height, " cells, ", context.device(),
                           " steps at most ", limit, " x ", limit);
    const bool weighted = literal || options.slide != Slide::Excess;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    base_heights = plane(width, height, GL_R32F);
    glTextureSubImage2D(base_heights.id(), 0, 0, 0, width, height, GL_RED, GL_FLOAT,
                        ground.heights.data());
    const float zero = 0.0F;
    for (GlTexture& texture : moved) {
        texture = plane(width, height, GL_R32F);
        glClearTexImage(texture.id(), 0, GL_RED, GL_FLOAT, &zero);
        if (literal)
            glTextureSubImage2D(texture.id(), 0, 0, 0, width, height, GL_RED, GL_FLOAT,
                                ground.heights.data());
    }
    report = GlBuffer(0U);
    glNamedBufferStorage(report.id(), sizeof(DeviceReport), nullptr, GL_DYNAMIC_STORAGE_BIT);
    load_soils(soil, weighted);
    load_programs(weighted);
    check_gl("loading the deformer");
}

void GpuDeformer::State::load_programs(bool weighted) {
    const DeformerShaderForm form{weighted, palette};
    if (literal) {
        literal_cells =
            ShaderProgram("the literal deformer", {{ShaderStage::Compute, literal_glsl(form)}});
        set_literal_rule();
        return;
    }
    tiles = ShaderProgram("the deformer", {{ShaderStage::Compute, sound_tiles_glsl(form)}});
    under_loads =
        ShaderProgram("the deformer's loads", {{ShaderStage::Compute, sound_loads_glsl(form)}});
    set_rule(tiles);
    set_rule(under_loads);
}

void GpuDeformer::State::load_soils(const SoilField& soil, bool weighted) {
    const SoilPalette found = soil_palette(soil, width, height, weighted);
    palette = found.fits;
    soils = plane(width, height, palette ? GL_R8UI : GL_RGBA32F);
    if (palette) {
        glTextureSubImage2D(soils.id(), 0, 0, 0, width, height, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
                            found.index.data());
        table = GlBuffer(0U);
        glNamedBufferStorage(table.id(),
                             static_cast<GLsizeiptr>(found.table.size() * sizeof(SoilRecord)),
                             found.table.data(), 0);
    } else {
        glTextureSubImage2D(soils.id(), 0, 0, 0, width, height, GL_RGBA, GL_FLOAT,
                            found.cells.data());
    }
}

void GpuDeformer::State::set_rule(const ShaderProgram& program) const {
    program.set("time_step", rule.time_step);
    program.set("cell_size", rule.cell_size);
    program.set("per_cell_size", rule.per_cell_size);
    program.set("gain", rule.gain);
    program.set("quantum", rule.quantum);
    program.set("keep_base", rule.keep_base ? 1 : 0);
    program.set("zero_border", rule.border == Border::Zero ? 1 : 0);
}

void GpuDeformer::State::set_literal_rule() const {
    const LiteralRule wanted = literal_rule(base, options);
    const ShaderProgram& program = literal_cells;
    program.set("time_step", wanted.time_step);
    program.set("to_grid", wanted.steps * wanted.steps / wanted.cell_size);
    program.set("push_scale",
                (wanted.plus_sign ? 1.0F : -1.0F) * (wanted.half ? 0.5F : 1.0F) * wanted.cell_size);
    program.set("clamp_weights", wanted.clamp_weights ? 1 : 0);
    program.set("chain_rule", wanted.terms == LiteralTerms::ChainRule ? 1 : 0);
    program.set("zero_border", wanted.border == Border::Zero ? 1 : 0);
}

void GpuDeformer::State::bind() const {
    glBindTextureUnit(0, base_heights.id());
    glBindTextureUnit(2, soils.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, table.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, report.id());
}

void GpuDeformer::State::dispatch(const ShaderProgram& program) {
    const auto next = static_cast<std::size_t>(1 - now);
    glBindTextureUnit(1, moved[static_cast<std::size_t>(now)].id());
    glBindImageTexture(0, moved[next].id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
    program.use();
    glDispatchCompute(static_cast<GLuint>((width + kTile - 1) / kTile),
                      static_cast<GLuint>((height + kTile - 1) / kTile), 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    now = 1 - now;
}

// Every iteration is a dispatch of its own.
void GpuDeformer::State::step_loaded(const ShaderProgram& program, const SummedLoad& load) {
    const CellWindow& w = load.window;
    loads = plane(std::max(1, w.width), std::max(1, w.height), GL_RGB32F);
    if (!w.empty())
        glTextureSubImage2D(loads.id(), 0, 0, 0, w.width, w.height, GL_RGB, GL_FLOAT,
                            load.cells.data());
    glBindTextureUnit(3, loads.id());
    program.set("load_window", glm::ivec4(w.x, w.y, w.width, w.height));
    for (int k = 0; k < options.iterations; ++k)
        dispatch(program);
}

DeformerReport GpuDeformer::State::run(std::span<const Load> given, float& greatest_move) {
    const SummedLoad load = summed(given, extent());
    context.make_current();
    DeviceReport zero;
    glNamedBufferSubData(report.id(), 0, sizeof zero, &zero);
    bind();
    if (load.window.empty() && !literal) {
        for (int left = options.iterations; left > 0; left -= kMostIterations) {
            tiles.set("iterations", std::min(left, kMostIterations));
            dispatch(tiles);
        }
    } else {
        step_loaded(literal ? literal_cells : under_loads, load);
    }
    DeviceReport got;
    glGetNamedBufferSubData(report.id(), 0, sizeof got, &got);
    check_gl("a step of the deformer");
    greatest_move = std::bit_cast<float>(got.greatest_move);
    const double quanta = 4294967296.0 * got.compacted_high + got.compacted_low;
    DeformerReport result;
    result.tiles_stepped = ((width + kTile - 1) / kTile) * ((height + kTile - 1) / kTile);
    result.compacted_m3 = quanta * double{rule.quantum} * base.cell_size * base.cell_size;
    result.at_rest = got.greatest_move == 0;
    return result;
}

GpuDeformer::GpuDeformer(GlContext& context, const Heightfield& base, const SoilField& soil,
                         const DeformerOptions& options) {
    check_by_deformer(base, soil, options);
    context.make_current();
    state_ = std::make_unique<State>(context, base, soil, options);
}
GpuDeformer::~GpuDeformer() = default;
GpuDeformer::GpuDeformer(GpuDeformer&&) noexcept = default;
GpuDeformer& GpuDeformer::operator=(GpuDeformer&&) noexcept = default;

DeformerReport GpuDeformer::step(std::span<const Load> loads) {
    float greatest_move = 0.0F;
    return state_->run(loads, greatest_move);
}

DeformerReport GpuDeformer::settle(int max_frames, double tolerance_m) {
    DeformerReport report;
    for (int frame = 0; frame < max_frames; ++frame) {
        float greatest_move = 0.0F;
        report = state_->run({}, greatest_move);
        report.at_rest = report.at_rest || double{greatest_move} <= tolerance_m;
        if (report.at_rest)
            break;
    }
    return report;
}

void GpuDeformer::replace_displacement(const FloatRaster& displacement) {
    State& s = *state_;
    check_displacement(displacement, s.width, s.height);
    FloatRaster held = displacement;
    if (s.literal)
        std::transform(held.begin(), held.end(), s.base.heights.begin(), held.begin(),
                       [](float u, float b) { return b + u; });
    else
        round_to_quanta(held, s.rule.quantum);
    s.context.make_current();
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(s.moved[static_cast<std::size_t>(s.now)].id(), 0, 0, 0, s.width, s.height,
                        GL_RED, GL_FLOAT, held.data());
    check_gl("writing displacements");
}

FloatRaster GpuDeformer::displacement(const CellWindow& window) const {
    if (window.width < 0 || window.height < 0 ||
        (!window.empty() && intersection(window, extent()) != window))
        fail<InvalidInput>("the window of ", window.width, " x ", window.height, " cells at (",
                           window.x, ", ", window.y, ") reaches outside the ground of ",
                           state_->width, " x ", state_->height, " cells");
    FloatRaster result(window.width, window.height);
    if (window.empty())
        return result;
    state_->context.make_current();
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureSubImage(state_->moved[static_cast<std::size_t>(state_->now)].id(), 0, window.x,
                         window.y, 0, window.width, window.height, 1, GL_RED, GL_FLOAT,
                         static_cast<GLsizei>(result.size() * sizeof(float)), result.data());
    check_gl("reading displacements");
    for (int y = 0; y < window.height && state_->literal; ++y)
        for (int x = 0; x < window.width; ++x)
            result(x, y) -= state_->base.heights(window.x + x, window.y + y);
    return result;
}

FloatRaster GpuDeformer::heights(const CellWindow& window) const {
    FloatRaster result = displacement(window);
    for (int y = 0; y < window.height; ++y)
        for (int x = 0; x < window.width; ++x)
            result(x, y) += state_->base.heights(window.x + x, window.y + y);
    return result;
}

CellWindow GpuDeformer::extent() const {
    return state_->extent();
}

double GpuDeformer::cell_size() const {
    return state_->base.cell_size;
}

double GpuDeformer::displaced_volume() const {
    double sum = 0.0;
    for (const float u : displacement(extent()))
        sum += u;
    return sum * cell_size() * cell_size();
}

std::size_t GpuDeformer::bytes() const {
    const std::size_t cells = state_->base.heights.size();
    return cells * (3U * sizeof(float) + (state_->palette ? 1U : sizeof(SoilRecord)));
}

const std::string& GpuDeformer::device() const {
    return state_->context.device();
}

}  // namespace scree::terrain
