#pragma once

#include "terrain/grid/face_flux.h"
#include "terrain/grid/tile_rows.h"

#include <algorithm>
#include <cmath>

// Pushes over one row; see tile_rows.h.
namespace scree::terrain {

/// Take the loads' push (positive from cell 0 to cell 1) off the flux from cell 1 to cell 0.
[[gnu::always_inline]] inline void push_row(const float* push, const float* share0,
                                            const float* share1, float quantum,
                                            float* __restrict flux) {
    for (int x = 0; x < kPatchWidth; ++x) {
        const float s0 = share0[x];
        const float s1 = share1[x];
        const float share = push[x] > 0.0F ? s0 : s1;
        const float amount = quantised(std::fabs(push[x]) * share, quantum);
        flux[x] -= std::copysign(amount, push[x]);
    }
}

/// What the limiter lets go (C.9), and what is pressed together first, in patch row y.
[[gnu::always_inline]] inline void share_row(const Patch& patch, int y, float quantum,
                                             float* __restrict share, float* __restrict compacted) {
    const float* u = patch.u + y * kPatchWidth;
    const float* base = patch.base.row(y);
    const float* underside = patch.load.underside.row(y);
    const float* outflow = patch.load.outflow.row(y);
    if (patch.load.compaction.values) {
        const float* compaction = patch.load.compaction.row(y);
        for (int x = 0; x < kPatchWidth; ++x) {
            const float penetration = std::max((base[x] + u[x]) - underside[x], 0.0F);
            compacted[x] = quantised(compaction[x] * penetration, quantum);
            share[x] = limited_share(penetration - compacted[x], outflow[x]);
        }
        return;
    }
    for (int x = 0; x < kPatchWidth; ++x)
        share[x] = limited_share(std::max((base[x] + u[x]) - underside[x], 0.0F), outflow[x]);
}

}  // namespace scree::terrain
