#pragma once

#include "vision/classical/field_model.h"
#include "vision/classical/pixel_features.h"
#include "vision/edge_field.h"

namespace scree::vision {

/// Edge field from measured values of each pixel and its surroundings, put together by four small
/// networks, from the coarsest of several scales to the finest.
class ClassicalEdgeDetector : public EdgeDetector {
public:
    /// @param model  What to use; must outlive the detector.
    explicit ClassicalEdgeDetector(const FieldModel& model = trained_field_model())
        : model_(&model) {}

    /// @pre The photograph is not empty.
    /// @throw InvalidInput  it is.
    EdgeField detect(const Photo& photo, Progress* progress = nullptr) const override;

private:
    const FieldModel* model_;
};

/// What a network says at one level: planes boundary, inside, distance without margin.
/// @param progress  Who may ask for a stop; may be null.
Context level_field(const LightLevel& level, const Context& context, const Mlp& mlp,
                    const Progress* progress = nullptr);

/// What the networks of a level and of all coarser ones say, averaged over the phases of each and
/// brought to the next finer level with the margin of its planes; empty without phases.
/// @param level  Number of the level that `phases` are of.
Context coarse_context(const std::vector<PhasedLevel>& phases, const FieldModel& model,
                       std::size_t level);

/// Planes of level 1, brought to level 0 with the margin of its planes.
Context context_from(const Context& coarse);

}  // namespace scree::vision
