#pragma once

#include "base/options.h"
#include "terrain/prepare/ground_lattice.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::terrain {

/// Across a bed.
enum class BedProfile {
    Flat,   ///< Level for `width`, then straight banks.
    Round,  ///< A parabola from bank to bank.
};
inline constexpr std::string_view kBedProfileNames[] = {"flat", "round"};
constexpr std::span<const std::string_view> names_of(BedProfile) {
    return kBedProfileNames;
}

struct BedOptions {
    double width = 4.0;  ///< Of the bottom, metres.
    double depth = 1.0;  ///< Of its lowest line below the land, metres.
    double bank = 1.0;   ///< Of the bank on each side, seen from above, metres.
    BedProfile profile = BedProfile::Flat;
    bool falling = true;  ///< The bed never rises on its way, whatever the land does.
};

template <class Visitor>
void describe(BedOptions& o, Visitor&& field) {
    field("width", o.width, {.min = 0, .max = 1e5, .unit = "m", .help = "of the bed's bottom"});
    field("depth", o.depth, {.min = 0, .max = 1e4, .unit = "m", .help = "below the land"});
    field("bank", o.bank, {.min = 0, .max = 1e5, .unit = "m", .help = "of the bank on each side"});
    field("profile", o.profile, {.help = "across the bed"});
    field("falling", o.falling, {.help = "the bed never rises on its way"});
}

/// A bed and where it runs.
struct RiverBed {
    std::vector<glm::dvec2> line;  ///< x and z of its middle, metres.
    BedOptions options;
};

/// What a cut did.
struct BedReport {
    std::size_t n_lowered = 0;  ///< Places of the lattice.
    double deepest = 0.0;       ///< Metres.
    double length = 0.0;        ///< Of the line over the ground, metres.
};

/// Lower the ground along a line (`mesh-erosion.md` 12).
///
/// The bed's height at a point of the line is the land's there less `depth`; with `falling` no
/// higher than anywhere before, from the higher end of the line on. A place at distance d from the
/// line goes to bed + rise(d) * (land - bed), rise being 0 in the middle and 1 where the banks end,
/// and never up. Unknown places stay unknown.
/// @throw InvalidOption  a value is outside the range that describe() gives.
/// @throw InvalidInput   the line has fewer than 2 points or more than 2000, one that is no number,
///                       or lies nowhere over the ground; bed and banks have no width.
BedReport cut_bed(GroundLattice& ground, const RiverBed& bed);

/// Read beds from a file's text (docs/terrain-preparation.md). Strict: an unknown member is an
/// error.
/// @param source  What to call the text in messages.
/// @throw InvalidInput  names the source, the place in it and what would be accepted.
std::vector<RiverBed> beds_from_json(std::string_view text, const std::string& source);

}  // namespace scree::terrain
