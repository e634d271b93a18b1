#pragma once

#include "base/options.h"

namespace scree::apps {

/// What `scree scatter` makes.
struct ScatterOptions {
    int count = 2000;          ///< Stones to place.
    double size_m = 0.0;       ///< Edge of the square patch, metres; 0: what the stones need.
    int grid = 0;              ///< Instead: so many copies of the photograph along each side.
    int max_segments = 30;     ///< Of the largest rock's mesh.
    bool quantise = false;     ///< Pack vertices of plain nodes too, by KHR_mesh_quantization.
    bool plain_nodes = false;  ///< Write plain nodes instead of EXT_mesh_gpu_instancing.
};

template <class Visitor>
void describe(ScatterOptions& o, Visitor&& field) {
    field("count", o.count, {.min = 1, .max = 1e6, .help = "stones to place"});
    field(
        "size-m", o.size_m,
        {.min = 0, .max = 1e6, .unit = "m", .help = "edge of the square patch; 0: what they need"});
    field("grid", o.grid,
          {.min = 0,
           .max = 1000,
           .help = "instead: N x N copies of the photograph's rocks as they "
                   "lie; 0 for none"});
    field("max-segments", o.max_segments,
          {.min = 3, .max = 720, .help = "segments of the largest rock's mesh"});
    field("quantise", o.quantise,
          {.help = "pack vertices of plain nodes too, with KHR_mesh_quantization"});
    field("plain-nodes", o.plain_nodes,
          {.help = "write plain nodes, for viewers without EXT_mesh_gpu_instancing"});
}

}  // namespace scree::apps
