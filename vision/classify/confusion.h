#pragma once

#include "base/raster.h"
#include "vision/classify/ground_classes.h"

#include <string>

namespace scree::vision {

/// How often what is there was called what: counts[truth][found], in pixels.
struct ConfusionMatrix {
    std::array<std::array<double, kGroundClasses>, kGroundClasses> counts{};
};

/// Add a picture: values of both rasters are GroundClass.
/// @throw InvalidInput  the rasters have different sizes or hold values of no class.
void add_to_confusion(ConfusionMatrix& matrix, const Raster<std::uint8_t>& truth,
                      const Raster<std::uint8_t>& found);

/// Share of all pixels that were called what they are; 0 of an empty matrix.
double accuracy(const ConfusionMatrix& matrix);
/// Share of the pixels of a class that were found; 0 if it has none.
double recall(const ConfusionMatrix& matrix, GroundClass kind);
/// Share of the pixels called a class that are of it; 0 if none were.
double precision(const ConfusionMatrix& matrix, GroundClass kind);
/// Mean over the classes of truth of intersection over union.
double mean_overlap(const ConfusionMatrix& matrix);

/// A table in Markdown: rows are the truth, per cent of the row, with recall and precision.
std::string confusion_table(const ConfusionMatrix& matrix);

}  // namespace scree::vision
