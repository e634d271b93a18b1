#pragma once

#include "vision/edge_field.h"

namespace scree::vision {

/// The field itself if all its channels are filled, else a completed copy kept in `storage`.
///
/// A missing inside channel becomes whatever is not boundary; a missing distance channel grows
/// from the boundary and saturates over some ten pixels.
/// @throw InvalidInput  the boundary is empty or a channel is not of the photograph's size.
const EdgeField& complete_field(const Photo& photo, const EdgeField& field, EdgeField& storage);

}  // namespace scree::vision
