#pragma once

#include "terrain/gpu/gl_context.h"
#include "terrain/grid/deformer.h"

#include <memory>
#include <span>

namespace scree::terrain {

/// Deformer as compute shaders (`rocks-and-deformer.md` C.5, C.8, C.9).
///
/// Frames without loads run in tiles of 16 x 16 cells with a halo as wide as the iterations, up to
/// four of them in one dispatch; under loads every iteration is a dispatch of its own between two
/// buffers. The whole ground is stepped in every frame, and held as 13 bytes a cell (28 where a
/// map has planes of parameters of its own).
///
/// The arithmetic is Deformer's, operation by operation, and what moves is a whole number of its
/// quanta: devices that divide exactly, llvmpipe among them, give its very displacements. Others
/// may round a quotient differently, which shifts single quanta of 2^-18 cell sizes an iteration.
/// The literal reading is a dispatch an iteration; there is nothing whole in it, so devices that
/// round differently drift apart by rounding.
/// Threads: as GlContext.
class GpuDeformer {
public:
    /// @param context  Must outlive the deformer.
    /// @param base     Must outlive the deformer; never written.
    /// @throw InvalidOption  as Deformer.
    /// @throw InvalidInput   as Deformer, and for a ground wider than the device's textures.
    /// @throw DeviceError    the device has not enough memory.
    GpuDeformer(GlContext& context, const Heightfield& base, const SoilField& soil,
                const DeformerOptions& options = {});
    ~GpuDeformer();
    GpuDeformer(GpuDeformer&&) noexcept;
    GpuDeformer& operator=(GpuDeformer&&) noexcept;

    /// As Deformer::step(); `tiles_stepped` counts the tiles of 16 x 16 cells of the whole ground.
    DeformerReport step(std::span<const Load> loads);
    /// As Deformer::settle().
    DeformerReport settle(int max_frames, double tolerance_m = 1e-6);

    /// As Deformer::replace_displacement().
    void replace_displacement(const FloatRaster& displacement);

    FloatRaster displacement(const CellWindow& window) const;
    FloatRaster heights(const CellWindow& window) const;
    CellWindow extent() const;
    double cell_size() const;
    double displaced_volume() const;
    /// Bytes held on the device.
    std::size_t bytes() const;
    /// Its name, see GlContext::device().
    const std::string& device() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace scree::terrain
