#pragma once

#include "base/options.h"
#include "terrain/gpu/gl_context.h"
#include "terrain/view/material_look.h"
#include "terrain/view/terrain_frame.h"

#include <memory>

namespace scree::terrain {

/// What a picture shows.
enum class ViewMode {
    Textured,  ///< As it looks: materials, light, shadows.
    Wire,      ///< The tessellated mesh over dimmed ground.
    Height,    ///< Colours by height with contour lines.
    Material,  ///< One flat colour for each material id, lit.
};
inline constexpr std::string_view kViewModeNames[] = {"textured", "wire", "height", "material"};
constexpr std::span<const std::string_view> names_of(ViewMode) {
    return kViewModeNames;
}

/// Where the ground is tessellated finest (`rocks-and-deformer.md` C.10).
enum class RefineAt {
    Camera,  ///< Round the point that the camera looks at.
    Object,  ///< Round the first object of the frame; the camera's point where there is none.
};
inline constexpr std::string_view kRefineAtNames[] = {"camera", "object"};
constexpr std::span<const std::string_view> names_of(RefineAt) {
    return kRefineAtNames;
}

struct TerrainViewOptions {
    int width = 960;               ///< px
    int height = 600;              ///< px
    int supersampling = 2;         ///< Samples along each side of a pixel.
    int lattice = 0;               ///< Patches along the longer side; 0 follows the picture.
    double tessellation = 4.0;     ///< T of (4.14): a patch at the reference has T + 1 parts.
    double refine_radius_m = 0.0;  ///< k of (4.14); 0 takes half the longer side.
    RefineAt refine_at = RefineAt::Camera;
    double near_m = 0.0;       ///< r1 of C.12: within it rocks are meshes; 0: nowhere.
    double far_m = 0.0;        ///< r2 of C.12; 0: where a cell is an eighth of a pixel.
    double contour_m = 0.0;    ///< Between contour lines; 0 picks a round number.
    int shadow_size = 2048;    ///< Side of the shadow map, texels.
    bool ground_block = true;  ///< Close the ground's sides down to a flat underside.
};

template <class Visitor>
void describe(TerrainViewOptions& o, Visitor&& field) {
    field("width", o.width, {.min = 16, .max = 8192, .unit = "px", .help = "width of the picture"});
    field("height", o.height,
          {.min = 16, .max = 8192, .unit = "px", .help = "height of the picture"});
    field("supersampling", o.supersampling,
          {.min = 1, .max = 4, .help = "samples along each side of a pixel"});
    field("lattice", o.lattice,
          {.min = 0, .max = 2048, .help = "patches along the longer side; 0 follows the picture"});
    field("tessellation", o.tessellation,
          {.min = 0, .max = 64, .help = "parts that the finest patches are cut into"});
    field("refine-radius", o.refine_radius_m,
          {.min = 0, .max = 1e6, .unit = "m", .help = "radius of the refined ground; 0 is half"});
    field("refine-at", o.refine_at, {.help = "what the ground is refined round"});
    field("near", o.near_m,
          {.min = 0, .max = 1e6, .unit = "m", .help = "within it rocks are meshes, not pictures"});
    field("far", o.far_m,
          {.min = 0, .max = 1e6, .unit = "m", .help = "beyond it normals alone; 0 picks it"});
    field("contour", o.contour_m,
          {.min = 0, .max = 1e4, .unit = "m", .help = "between contour lines; 0 picks it"});
    field("shadow-size", o.shadow_size,
          {.min = 64, .max = 8192, .unit = "px", .help = "side of the shadow map"});
    field("ground-block", o.ground_block, {.help = "close the ground's sides"});
}

/// Draws a ground that changes, without a display (`rocks-and-deformer.md` C.10 to C.12).
///
/// The ground is loaded once and stays on the device; a frame uploads the displacements that
/// changed. On one device the same calls give the same pictures. Threads: as GlContext.
class TerrainView {
public:
    /// @param context  Must outlive the view.
    /// @throw InvalidOption  an option is out of its range.
    /// @throw InvalidInput   the base is no heightfield; a map's id has no material; a look's
    ///                       pictures are no numbers; the window is wider than the device's
    ///                       textures: names the value and the limit.
    /// @throw DeviceError    the device has not enough memory.
    TerrainView(GlContext& context, const TerrainGround& ground,
                const TerrainViewOptions& options = {});
    ~TerrainView();
    TerrainView(TerrainView&&) noexcept;
    TerrainView& operator=(TerrainView&&) noexcept;

    /// Draw one frame.
    /// @throw InvalidInput  a broken mesh, a displacement of another size than its window, a
    ///                      camera at its own target.
    Photo draw(const TerrainFrame& frame, ViewMode mode = ViewMode::Textured);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace scree::terrain
