#pragma once

namespace scree::meshing {

/// Fewest segments a ring can have; a rock of this many is two three-sided pyramids.
inline constexpr int kFewestSegments = 3;

/// Segments of a rock by its size among its batch (`rocks-and-deformer.md` eq. 3.13).
///
/// @param largest   Segments of the largest rock of the batch, at least `smallest`.
/// @param share     The rock's greatest radius over the greatest of the batch, 0 to 1.
/// @param smallest  Segments that a vanishing rock keeps; the source has 3.
/// @throw InvalidOption  a value is outside those ranges.
int segments_for_size(int largest, double share, int smallest = kFewestSegments);

/// Share of the largest rock's segments that such a rock gets (eq. 3.15), 0 to 1.
double segment_share(int largest, double share);

/// Rings that go with a number of segments: half of it, and one.
int rings_for_segments(int segments);

}  // namespace scree::meshing
