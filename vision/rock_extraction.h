#pragma once

#include "base/options.h"
#include "base/progress.h"
#include "vision/gravel_likeness.h"
#include "vision/refine/refine_outlines.h"
#include "vision/rock_data.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scree::vision {

/// How the edge field is made and who reads it.
enum class Method {
    Classical,  ///< Statistical edge field, competing candidates; for real photographs.
    Thesis,     ///< The source's level slicing and ray marching.
    Learned,    ///< Edge field of a convolutional network, competing candidates.
};

inline constexpr std::string_view kMethodNames[] = {"classical", "thesis", "learned"};

constexpr std::span<const std::string_view> names_of(Method) {
    return kMethodNames;
}

struct ExtractionOptions {
    Method method = Method::Learned;
    Reading reading = Reading::Sound;  ///< Of the source's method; the classical one has no other.
    double min_size = 8.0;             ///< Least equivalent diameter of a rock, px.
    std::filesystem::path model = {};  ///< Network of the learned method; empty: the one built in.
    bool refine = true;                ///< Fit a generalised ellipsoid to every outline.
    bool keep_stages = false;          ///< Keep a picture of every stage.
};

template <class Visitor>
void describe(ExtractionOptions& o, Visitor&& field) {
    field("method", o.method, FieldInfo{.help = "how outlines are found"});
    field("reading", o.reading,
          FieldInfo{.help = "of the thesis method: what its text must mean, or as printed"});
    field("min-size", o.min_size,
          FieldInfo{
              .min = 3, .max = 10000, .unit = "px", .help = "least equivalent diameter of a rock"});
    field("model", o.model,
          FieldInfo{.help = "ONNX network of the learned method, instead of the one built in"});
    field("refine", o.refine, FieldInfo{.help = "fit a generalised ellipsoid to every outline"});
    field("debug-stages", o.keep_stages, FieldInfo{.help = "keep a picture of every stage"});
}

/// The rocks of a photograph and what finding them took.
struct RockExtraction {
    RockSet rocks;
    RefineReport refinement;
    GravelLikeness likeness;
    FloatRaster boundary;  ///< Of the edge field: relief_signal() reads it again.
    double edge_seconds = 0.0;
    double outline_seconds = 0.0;  ///< Without refinement.
    double refine_seconds = 0.0;
    std::vector<std::pair<std::string, Photo>>
        stages;  ///< Name and picture, in the order of the chain.
};

/// Find the rocks of a photograph: edge field, outlines, refinement.
///
/// @post  Rocks are ordered by decreasing confidence; no equivalent diameter is under min_size.
/// @throw InvalidOption  a value is outside the range that describe() gives, or `model` is given
///                       with another method than the learned one.
/// @throw InvalidInput   the photograph is empty, or `model` is no outline network.
/// @throw Cancelled      the listener asked for a stop.
RockExtraction extract_rocks(const Photo& photo, const ExtractionOptions& options = {},
                             Progress* progress = nullptr);

/// The same chain with a detector and a finder of the caller's; `options.method` is not looked at.
RockExtraction extract_rocks(const Photo& photo, const EdgeDetector& detector,
                             const OutlineFinder& finder, const ExtractionOptions& options = {},
                             Progress* progress = nullptr);

}  // namespace scree::vision
