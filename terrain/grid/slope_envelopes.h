#pragma once

#include "terrain/grid/slope_limits.h"

namespace scree::terrain {

/// What bring_within_limits() did.
struct EnvelopeReport {
    int passes = 0;  ///< Over all cells; the lower and the upper envelope count as one each.
    int areas = 0;   ///< Connected areas that were changed.
};

/// Bring ground that is nearly at rest within its limits, exactly up to rounding.
///
/// The lower envelope is the highest ground at rest that is nowhere above `heights`, the upper one
/// the lowest that is nowhere below. Limits form a convex set, so a mean of both with one weight
/// for a connected area where they differ is at rest too; the weight is the one that keeps the
/// area's volume. Far from rest the result is at rest as well, but soil has jumped across its
/// area.
EnvelopeReport bring_within_limits(DoubleRaster& heights, const SlopeLimits& limits,
                                   double cell_size);

}  // namespace scree::terrain
