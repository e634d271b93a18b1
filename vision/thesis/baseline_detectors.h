#pragma once

#include "base/options.h"
#include "vision/edge_field.h"

namespace scree::vision {

/// What the source tried and rejected (`rocks-and-deformer.md` A.4), to compare with.
struct BaselineOptions {
    int working_width = 900;     ///< As in ThesisOptions; 0 leaves the picture.
    double blur = 1.0;           ///< Gaussian before Canny, px.
    double high = 120.0;         ///< Canny's upper threshold on the gradient of bytes.
    double low_share = 1.0 / 3;  ///< Lower threshold over upper.
    double least_depth = 3.0;    ///< Watershed seeds are deeper inside Canny's cells than this, px.
};

template <class Visitor>
void describe(BaselineOptions& o, Visitor&& field) {
    field("working-width", o.working_width, {.min = 0, .max = 8192, .unit = "px"});
    field("blur", o.blur, {.min = 0, .max = 20, .unit = "px"});
    field("high", o.high, {.min = 0, .max = 4000});
    field("low-share", o.low_share, {.min = 0, .max = 1});
    field("least-depth", o.least_depth, {.min = 0, .max = 100, .unit = "px"});
}

/// Canny's edges as the boundary channel.
class CannyDetector final : public EdgeDetector {
public:
    explicit CannyDetector(const BaselineOptions& options = {});
    EdgeField detect(const Photo& photo, Progress* progress = nullptr) const override;

private:
    BaselineOptions options_;
};

/// Watershed lines between the cells that Canny's edges leave, as the boundary channel.
class WatershedDetector final : public EdgeDetector {
public:
    explicit WatershedDetector(const BaselineOptions& options = {});
    EdgeField detect(const Photo& photo, Progress* progress = nullptr) const override;

private:
    BaselineOptions options_;
};

}  // namespace scree::vision
