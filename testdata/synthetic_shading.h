#pragma once

#include "testdata/synthetic_photo.h"

namespace scree::test {

/// Photograph the outlines from above under the light that the options describe.
Photo shade_rocks(const std::vector<vision::Outline>& outlines, const LabelMap& labels,
                  const SyntheticOptions& options);

}  // namespace scree::test
