#include "terrain/scene/ground_solver.h"

namespace scree::terrain {
namespace {

class CpuSolver : public GroundSolver {
public:
    CpuSolver(const Heightfield& base, const SoilField& soil, const DeformerOptions& options)
        : deformer_(base, soil, options) {}

    DeformerReport step(std::span<const Load> loads) override { return deformer_.step(loads); }
    FloatRaster displacement(const CellWindow& window) const override {
        return deformer_.displacement(window);
    }
    FloatRaster heights(const CellWindow& window) const override {
        return deformer_.heights(window);
    }
    double displaced_volume() const override { return deformer_.displaced_volume(); }
    std::string device() const override { return "cpu"; }

private:
    Deformer deformer_;
};

}  // namespace

SolverChoice make_solver(const Heightfield& base, const SoilField& soil,
                         const DeformerOptions& options, Device device) {
    if (device == Device::Gpu)
        fail<InvalidInput>("this build computes no ground on a graphics device, use --device cpu");
    return {std::make_unique<CpuSolver>(base, soil, options), "computed on the CPU"};
}

}  // namespace scree::terrain
