#pragma once

#include "vision/rock_extraction.h"

#include <vector>

namespace scree::vision {

/// What the learned method finds in a photograph.
inline LabelMap found_labels(const Photo& photo) {
    const RockExtraction extraction = extract_rocks(photo, {.method = Method::Learned});
    std::vector<Outline> outlines;
    for (const Rock& rock : extraction.rocks.rocks)
        outlines.push_back(rock.outline);
    return paint_labels(outlines, photo.width(), photo.height());
}

}  // namespace scree::vision
