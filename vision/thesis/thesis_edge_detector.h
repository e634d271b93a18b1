#pragma once

#include "vision/edge_field.h"
#include "vision/thesis/grey.h"
#include "vision/thesis/hysteresis.h"
#include "vision/thesis/thesis_options.h"

namespace scree::vision {

/// Every picture of the mask chain (`rocks-and-deformer.md` A.4), all of the same size.
struct EdgeStages {
    GreyRaster grey;
    GreyRaster median;
    FloatRaster accumulation;  ///< I_L.
    Thresholds thresholds;
    Mask thresholded;  ///< I_T.
    Mask linked;       ///< I_E.
};

/// Run the mask chain on a photograph as it is, without scaling it.
/// @throw InvalidOption  an option is out of its range.
/// @throw InvalidInput   the photograph is empty.
EdgeStages detect_thesis_edges(const Photo& photo, const ThesisOptions& options);

/// The source's module EdgeDetector behind the exchangeable interface.
///
/// Works at the working width; the boundary channel is the linked mask, 0 or 1, carried to the
/// photograph's size. The other channels stay empty.
class ThesisEdgeDetector final : public EdgeDetector {
public:
    explicit ThesisEdgeDetector(const ThesisOptions& options = {});
    EdgeField detect(const Photo& photo, Progress* progress = nullptr) const override;

private:
    ThesisOptions options_;
};

}  // namespace scree::vision
