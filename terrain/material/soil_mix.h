#pragma once

#include "terrain/material/soil.h"

#include <cmath>
#include <numbers>

namespace scree::terrain {

/// The soil of a mixture: parameters interpolated by share, the angle of repose by its tangent,
/// which is the coefficient of friction.
class SoilMix {
public:
    void add(const Soil& soil, double share) {
        total_ += share;
        tangent_ += share * std::tan(soil.repose_deg * (std::numbers::pi / 180.0));
        mobility_ += share * soil.mobility;
        diffusion_ += share * soil.diffusion;
        compaction_ += share * soil.compaction;
    }

    bool empty() const { return !(total_ > 0.0); }
    double repose() const { return std::atan(tangent_ / total_); }  ///< Radians.
    double mobility() const { return mobility_ / total_; }
    double diffusion() const { return diffusion_ / total_; }
    double compaction() const { return compaction_ / total_; }

private:
    double total_ = 0.0;
    double tangent_ = 0.0;
    double mobility_ = 0.0;
    double diffusion_ = 0.0;
    double compaction_ = 0.0;
};

}  // namespace scree::terrain
