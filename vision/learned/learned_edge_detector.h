#pragma once

#include "base/options.h"
#include "vision/edge_field.h"
#include "vision/learned/level_fusion.h"
#include "vision/learned/outline_network.h"

#include <memory>

namespace scree::vision {

struct LearnedOptions {
    int levels = 4;        ///< Most scales of the picture at 1, 1/2, 1/4, 1/8.
    bool adapt = true;     ///< Leave a fine scale out where coarse ones show none but big rocks.
    double full = 192;     ///< With adapt: rocks up to this diameter at a scale need it, px.
    double none = 320;     ///< With adapt: from this diameter on the next coarser one will do, px.
    double doubt = 0.35;   ///< The picture at twice its size is looked at, if the fusion reads
                           ///< that, where more than this is open between rock and ground...
    double closest = 1.1;  ///< ...as long as it then has at most so many megapixels.
    int tile = 1024;       ///< Longest side of what the network is given at once, px.
    int margin = 48;       ///< Half of the least overlap of tiles, px.
};

template <class Visitor>
void describe(LearnedOptions& o, Visitor&& field) {
    field("levels", o.levels, FieldInfo{.min = 1, .max = 4, .help = "most scales to look at"});
    field("adapt", o.adapt, FieldInfo{.help = "leave fine scales out where all rocks are big"});
    field("full", o.full,
          FieldInfo{.min = 8, .max = 1e4, .unit = "px", .help = "rocks that need a scale"});
    field("none", o.none,
          FieldInfo{.min = 9, .max = 2e4, .unit = "px", .help = "rocks that do not, above full"});
    field("doubt", o.doubt,
          FieldInfo{.min = 0, .max = 1, .help = "look twice as close where more is unsure"});
    field(
        "closest", o.closest,
        FieldInfo{.min = 0, .max = 1e3, .unit = "MP", .help = "most that is looked at so closely"});
    field("tile", o.tile,
          FieldInfo{.min = 768, .max = 4096, .unit = "px", .help = "longest side of a tile"});
    field("margin", o.margin,
          FieldInfo{.min = 16, .max = 96, .unit = "px", .help = "half of the overlap of tiles"});
}

/// Edge field from a small convolutional network run at several scales; fills all channels.
///
/// The picture at 1, 1/2 and 1/4, and at 1/8 from 2400 px on, coarsest first, is cut into tiles
/// that overlap; a scale whose shorter side would be under 32 px is left out. With `adapt` a scale
/// is not computed where the coarser one shows none but big rocks; that one stands in for it, with
/// a smooth change. Then fuse_levels() makes one field of all. Beside the field it holds its
/// logits, half of them again for coarse scales, and the work of one tile, some 0.3 KB a pixel of
/// it.
///
/// A picture that is small enough, `closest`, is also looked at at twice its size if the fusion
/// reads that: with `adapt` only where its own scales leave open what is rock.
///
/// What lies further from a pixel than 500 px of the coarsest scale in use does not change its
/// values. Tiles change them by what the network sees beyond half the margin, which fades out. So a
/// part of a photograph, cut out at multiples of 32 px of the coarsest scale, gives the same field
/// away from its new sides, unless the part alone is small enough to be looked at more closely.
/// Same bytes for any number of threads.
class LearnedEdgeDetector final : public EdgeDetector {
public:
    /// @throw InvalidOption  a value is outside the range that describe() gives, or none is not
    ///                       above full.
    explicit LearnedEdgeDetector(const LearnedOptions& options = {},
                                 OutlineNetwork network = shipped_network(),
                                 FusionModel fusion = shipped_fusion());

    /// Progress is told, and a stop heeded, at every tile.
    /// @throw InvalidInput  the photograph is empty, or the network cannot be run.
    /// @throw Cancelled     the listener asked for a stop.
    EdgeField detect(const Photo& photo, Progress* progress = nullptr) const override;

private:
    LearnedOptions options_;
    OutlineNetwork network_;
    FusionModel fusion_;
};

}  // namespace scree::vision
