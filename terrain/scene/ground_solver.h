#pragma once

#include "base/error.h"
#include "terrain/grid/deformer.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace scree::terrain {

/// Where the ground is computed.
enum class Device {
    Auto,  ///< A graphics card where there is one, not a program that imitates one; else the CPU.
    Cpu,
    Gpu,  ///< OpenGL, imitated in software if need be.
};
inline constexpr std::string_view kDeviceNames[] = {"auto", "cpu", "gpu"};
constexpr std::span<const std::string_view> names_of(Device) {
    return kDeviceNames;
}

/// A deformer on some device.
class GroundSolver {
public:
    virtual ~GroundSolver() = default;
    virtual DeformerReport step(std::span<const Load> loads) = 0;
    /// As Deformer::replace_displacement().
    virtual void replace_displacement(const FloatRaster& displacement) = 0;
    virtual FloatRaster displacement(const CellWindow& window) const = 0;
    virtual FloatRaster heights(const CellWindow& window) const = 0;
    /// Of the whole ground, cubic metres.
    virtual double displaced_volume() const = 0;
    /// For people: `cpu`, or the card's name.
    virtual std::string device() const = 0;
};

/// A solver and why it runs where it does, for a log.
struct SolverChoice {
    std::unique_ptr<GroundSolver> solver;
    std::string reason;
};

/// @param base  Must outlive the solver.
/// @throw InvalidOption, InvalidInput  as Deformer; Device::Gpu without a device.
SolverChoice make_solver(const Heightfield& base, const SoilField& soil,
                         const DeformerOptions& options, Device device);

}  // namespace scree::terrain
