#pragma once

#include "vision/thesis/grey.h"
#include "vision/thesis/thesis_options.h"

namespace scree::vision {

/// Accumulation image I_L of the local-change test (3.6) over L levels, in [0, 1], in steps 1/L.
///
/// A pixel is compared with its four neighbours at `offset`, those beyond the picture taken from
/// its border. Closed form of `rocks-and-deformer.md` A.4.2; no loop over levels.
FloatRaster accumulate_changes(const GreyRaster& grey, const ThesisOptions& options);

/// The same by running through all L levels as the source prints it; slow, the oracle of tests.
FloatRaster accumulate_changes_by_levels(const GreyRaster& grey, const ThesisOptions& options);

}  // namespace scree::vision
