#include "terrain/scene/ground_solver.h"

#include "terrain/gpu/deformer_gpu.h"

namespace scree::terrain {
namespace {

class CpuSolver : public GroundSolver {
public:
    CpuSolver(const Heightfield& base, const SoilField& soil, const DeformerOptions& options)
        : deformer_(base, soil, options) {}

    DeformerReport step(std::span<const Load> loads) override { return deformer_.step(loads); }
    void replace_displacement(const FloatRaster& displacement) override {
        deformer_.replace_displacement(displacement);
    }
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

class GpuSolver : public GroundSolver {
public:
    GpuSolver(std::unique_ptr<GlContext> context, const Heightfield& base, const SoilField& soil,
              const DeformerOptions& options)
        : context_(std::move(context)), deformer_(*context_, base, soil, options) {}

    DeformerReport step(std::span<const Load> loads) override { return deformer_.step(loads); }
    void replace_displacement(const FloatRaster& displacement) override {
        deformer_.replace_displacement(displacement);
    }
    FloatRaster displacement(const CellWindow& window) const override {
        return deformer_.displacement(window);
    }
    FloatRaster heights(const CellWindow& window) const override {
        return deformer_.heights(window);
    }
    double displaced_volume() const override { return deformer_.displaced_volume(); }
    std::string device() const override { return deformer_.device(); }

private:
    std::unique_ptr<GlContext> context_;  // outlives the deformer
    GpuDeformer deformer_;
};

SolverChoice on_cpu(const Heightfield& base, const SoilField& soil, const DeformerOptions& options,
                    const std::string& why) {
    return {std::make_unique<CpuSolver>(base, soil, options), "computed on the CPU: " + why};
}

}  // namespace

SolverChoice make_solver(const Heightfield& base, const SoilField& soil,
                         const DeformerOptions& options, Device device) {
    if (device == Device::Cpu)
        return on_cpu(base, soil, options, "as asked");
    GlContext::Attempt attempt = GlContext::try_make();
    if (attempt.context == nullptr) {
        if (device == Device::Gpu)
            fail<InvalidInput>("no graphics device can compute the ground: ", attempt.reason);
        return on_cpu(base, soil, options, attempt.reason);
    }
    if (device == Device::Auto && attempt.context->is_software())
        return on_cpu(base, soil, options,
                      attempt.context->device() + " is no graphics card but draws in software");
    const std::string name = attempt.context->device();
    try {
        return {std::make_unique<GpuSolver>(std::move(attempt.context), base, soil, options),
                "computed on " + name};
    } catch (const DeviceError& error) {
        if (device == Device::Gpu)
            throw;
        return on_cpu(base, soil, options, error.what());
    } catch (const InvalidInput& error) {  // wider than its textures, perhaps
        if (device == Device::Gpu)
            throw;
        return on_cpu(base, soil, options, error.what());
    }
}

}  // namespace scree::terrain
