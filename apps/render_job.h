#pragma once

#include "base/options.h"
#include "terrain/view/terrain_view.h"

#include <filesystem>
#include <string>

namespace scree::apps {

/// What `scree render` draws and from where.
struct RenderOptions {
    terrain::ViewMode view = terrain::ViewMode::Textured;
    double azimuth = 25.0;          ///< Of the eye, degrees.
    double elevation = 35.0;        ///< Of the eye, degrees.
    double zoom = 1.0;              ///< 2 brings the eye to half its distance.
    double light_azimuth = -55.0;   ///< Of the sun, degrees.
    double light_elevation = 38.0;  ///< Of the sun, degrees.
    double width_m = 0.0;           ///< Of the ground; 0: what the file says.
    double height_m = 0.0;          ///< Of white; 0: what the file says.
};

template <class Visitor>
void describe(RenderOptions& o, Visitor&& field) {
    field("view", o.view, {.help = "what the picture shows"});
    field("azimuth", o.azimuth,
          {.min = -360, .max = 360, .unit = "deg", .help = "where the eye stands; 0: bottom edge"});
    field("elevation", o.elevation,
          {.min = 5, .max = 90, .unit = "deg", .help = "height of the eye above the ground"});
    field("zoom", o.zoom, {.min = 0.1, .max = 100, .help = "2 brings the eye twice as close"});
    field("light-azimuth", o.light_azimuth,
          {.min = -360, .max = 360, .unit = "deg", .help = "where the sun stands"});
    field("light-elevation", o.light_elevation,
          {.min = 1, .max = 90, .unit = "deg", .help = "height of the sun"});
    field("width-m", o.width_m,
          {.min = 0, .max = 1e6, .unit = "m", .help = "width of the ground; 0: as the file says"});
    field("height-m", o.height_m,
          {.min = 0, .max = 1e5, .unit = "m", .help = "height of white; 0: as the file says"});
}

struct RenderJob {
    std::filesystem::path heights, displacement, map, rocks, output;
    RenderOptions options;
    terrain::TerrainViewOptions view;
    bool software = false;
};

/// Draw a ground from files. Returns the name of the device that drew it.
/// @throw IoError, InvalidInput, InvalidOption, DeviceError
std::string run_render_job(const RenderJob& job);

}  // namespace scree::apps
