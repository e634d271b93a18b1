#pragma once

#include "base/options.h"
#include "terrain/grid/heightfield.h"
#include "terrain/grid/load.h"
#include "terrain/grid/soil_field.h"

#include <memory>
#include <span>
#include <string_view>

namespace scree::terrain {

/// How the sound form lets soil slide (`rocks-and-deformer.md` C.8).
enum class Slide {
    Excess,  ///< Flux by the slope in excess of repose: settles fast.
    Weight,  ///< Flux by the slope, weighted by its angle above repose (4.4, clamped).
    Gain,    ///< The weight times four before clamping; half the stable step.
};
inline constexpr std::string_view kSlideNames[] = {"excess", "weight", "gain"};
constexpr std::span<const std::string_view> names_of(Slide) {
    return kSlideNames;
}

/// What happens at the rim of the grid.
enum class Border {
    NoFlux,  ///< Nothing leaves: volume is kept to the edge.
    Zero,    ///< Displacement is zero on the rim (4.7).
};
inline constexpr std::string_view kBorderNames[] = {"no-flux", "zero"};
constexpr std::span<const std::string_view> names_of(Border) {
    return kBorderNames;
}

/// Form of the published scheme's flux terms; read by the literal form alone.
enum class LiteralTerms {
    SingleTerm,  ///< (4.9) with the cell's own coefficients, as the author used it.
    ChainRule,   ///< (4.13), with the derivatives of the coefficients.
};
inline constexpr std::string_view kLiteralTermsNames[] = {"single-term", "chain-rule"};
constexpr std::span<const std::string_view> names_of(LiteralTerms) {
    return kLiteralTermsNames;
}

/// How the ground answers.
struct DeformerOptions {
    Reading reading = Reading::Sound;
    Slide slide = Slide::Excess;
    Border border = Border::NoFlux;
    int iterations = 4;      ///< In one frame; the source recommends 3 to 5.
    double time_step = 1.0;  ///< Of one iteration, times the soils' diffusion.
    bool keep_base = true;   ///< Undisturbed ground steeper than its repose stays (C.7).
    LiteralTerms terms = LiteralTerms::SingleTerm;
    bool clamp_weights = false;      ///< Literal form: clamp (4.4) to [0, 1].
    bool literal_plus_sign = false;  ///< Literal form: the force term's sign as printed in (4.9).
};

template <class Visitor>
void describe(DeformerOptions& o, Visitor&& field) {
    field("reading", o.reading, {.help = "the published form or the conservative one"});
    field("slide", o.slide, {.help = "how soil above its repose slides"});
    field("border", o.border, {.help = "what the rim of the ground does"});
    field("iterations", o.iterations, {.min = 1, .max = 64, .help = "iterations in one frame"});
    field("time-step", o.time_step, {.min = 1e-6, .max = 100, .help = "of one iteration"});
    field("keep-base", o.keep_base, {.help = "undisturbed steep ground stays where it is"});
    field("terms", o.terms, {.help = "literal form: flux terms"});
    field("clamp-weights", o.clamp_weights, {.help = "literal form: clamp its weights"});
    field("literal-plus-sign", o.literal_plus_sign,
          {.help = "literal form: sign of the force term as printed"});
}

/// What one frame did.
struct DeformerReport {
    int tiles_stepped = 0;      ///< Tiles that were active.
    double compacted_m3 = 0.0;  ///< Volume pressed together, by the soils' compaction.
    bool at_rest = true;        ///< No tile is still settling.
};

/// A ground that answers loads: base heights that never change, and a dynamic height map of
/// displacements over them (`rocks-and-deformer.md` C.6 to C.9), in tiles that exist only where
/// something moved. A frame costs what its active tiles cost; any number of threads gives the same.
class Deformer {
public:
    /// @param base  Must outlive the deformer; never written.
    /// @throw InvalidOption  a value is out of range, or the explicit step is beyond its bound
    ///                       D * dt <= 1/4 (1/8 for Gain): the message names the largest D.
    /// @throw InvalidInput   the base is no valid heightfield.
    Deformer(const Heightfield& base, const SoilField& soil, const DeformerOptions& options = {});
    ~Deformer();
    Deformer(Deformer&&) noexcept;
    Deformer& operator=(Deformer&&) noexcept;

    /// One frame under `loads` (windows may overlap; they are clipped to the grid).
    DeformerReport step(std::span<const Load> loads);

    /// Frames without loads until nothing moves by more than `tolerance_m`, or `max_frames`.
    DeformerReport settle(int max_frames, double tolerance_m = 1e-6);
    /// New displacements for the whole grid, as settle_to_rest() gives them; the sound form rounds
    /// them by round_to_quanta(). @throw InvalidInput  as check_displacement().
    void replace_displacement(const FloatRaster& displacement);

    /// Displacement of a window, metres; zero where nothing moved.
    FloatRaster displacement(const CellWindow& window) const;
    /// Base plus displacement of a window, metres.
    FloatRaster heights(const CellWindow& window) const;
    CellWindow extent() const;
    double cell_size() const;

    /// Sum of the displacement times the cell area, in double, cubic metres.
    double displaced_volume() const;
    /// Bytes held beyond the base and the soil's map.
    std::size_t bytes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace scree::terrain
