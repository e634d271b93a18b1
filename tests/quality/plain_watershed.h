#pragma once

#include "base/raster.h"
#include "vision/edge_field.h"

namespace scree::test {

/// Plain marker watershed of an edge field, the simplest reading of it and so the one that every
/// stage of the toolkit is measured against.
///
/// Markers are the peaks of the blurred distance channel that stand out by 0.12; they flood
/// boundary - distance / 2 over all pixels that are rather inside than not. The same as regions()
/// in vision/training/train_folds.py.
/// @pre  All channels are filled and have one size.
LabelMap plain_watershed(const vision::EdgeField& field);

}  // namespace scree::test
