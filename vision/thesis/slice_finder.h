#pragma once

#include "vision/thesis/slice_tracer.h"

#include <vector>

namespace scree::vision {

/// Slices of a mask and what became of its samples.
struct SliceSet {
    std::vector<Slice> slices;      ///< In the order in which they were found.
    std::size_t n_samples = 0;      ///< Nodes that lie on no edge.
    std::size_t n_traced = 0;       ///< Samples whose turn came.
    std::size_t n_rejected = 0;     ///< Of those, without a slice.
    std::size_t n_overlapping = 0;  ///< Of those, dropped for lying on earlier slices.
};

/// Trace the samples of the grid one after the other; every finished slice strikes off the samples
/// inside it, a sample always strikes itself off (A.5 to A.11).
///
/// Samples are traced ahead on all threads; which of the results count is decided in visiting
/// order, so the slices are those of the serial loop.
/// @throw InvalidOption  an option is out of its range.
SliceSet find_slices(const Mask& edges, const ThesisOptions& options);

/// The same one sample at a time: the reference for tests and for the speed-up.
SliceSet find_slices_serially(const Mask& edges, const ThesisOptions& options);

}  // namespace scree::vision
