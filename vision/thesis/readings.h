#pragma once

#include <span>
#include <string_view>

namespace scree::vision {

/// How the four inequalities of (3.6) combine (AMB-05).
enum class ChangeMode {
    Any,   ///< One brighter neighbour: the darker side of any edge.
    Pair,  ///< Both neighbours of a row or column: dark lines.
    All,   ///< All four, as printed: dark dots.
    Abs,   ///< Absolute instead of relative difference to the brightest neighbour.
};
inline constexpr std::string_view kChangeModeNames[] = {"any", "pair", "all", "abs"};
constexpr std::span<const std::string_view> names_of(ChangeMode) {
    return kChangeModeNames;
}

/// Where the upper threshold of the hysteresis comes from (AMB-04).
enum class ThresholdRule {
    BrightShare,    ///< The value that a share of the pixels exceeds, a quarter by default.
    FirstQuartile,  ///< As printed: the first quartile over all pixels; marks three quarters.
    ThirdQuartileNonzero,  ///< The third quartile of the pixels that show any change.
    Fixed,                 ///< A value of the caller.
};
inline constexpr std::string_view kThresholdRuleNames[] = {"bright-share", "first-quartile",
                                                           "third-quartile-nonzero", "fixed"};
constexpr std::span<const std::string_view> names_of(ThresholdRule) {
    return kThresholdRuleNames;
}

/// In which order samples are visited (A.5).
enum class VisitOrder {
    RowMajor,      ///< Left to right, top to bottom.
    DeepestFirst,  ///< By falling distance to the nearest edge; ties row-major.
};
inline constexpr std::string_view kVisitOrderNames[] = {"row-major", "deepest-first"};
constexpr std::span<const std::string_view> names_of(VisitOrder) {
    return kVisitOrderNames;
}

/// When a hit is an outlier by its turning angle (3.8); readings of AMB-01 and AMB-02.
enum class TurnRule {
    SignedOutward,  ///< Both inequalities, concave counted positive: outward corners and spikes.
    SignedInward,   ///< Both, convex counted positive: strips the true contour beside an escape.
    UnsignedAnd,    ///< Both, sine as a norm: as printed, joined by "and".
    UnsignedOr,     ///< Either, sine as a norm: as printed, joined by "or".
    CosineOnly,     ///< The first inequality alone.
    Off,            ///< Keep every hit; shows what the filter contributes.
};
inline constexpr std::string_view kTurnRuleNames[] = {
    "signed-outward", "signed-inward", "unsigned-and", "unsigned-or", "cosine-only", "off"};
constexpr std::span<const std::string_view> names_of(TurnRule) {
    return kTurnRuleNames;
}

/// How the severity of the outlier filter is lowered (AMB-03).
enum class SeveritySchedule {
    Restart,  ///< Every severity starts from the full polygon; the first to leave enough is taken.
    Cumulative,  ///< One polygon is peeled on while the severity falls, never below the minimum.
};
inline constexpr std::string_view kSeverityScheduleNames[] = {"restart", "cumulative"};
constexpr std::span<const std::string_view> names_of(SeveritySchedule) {
    return kSeverityScheduleNames;
}

/// What the centre of the retained hits is (AMB-08).
enum class CentroidKind {
    Area,  ///< Centroid of the polygon's area.
    Mean,  ///< Mean of its vertices, as printed.
};
inline constexpr std::string_view kCentroidKindNames[] = {"area", "mean"};
constexpr std::span<const std::string_view> names_of(CentroidKind) {
    return kCentroidKindNames;
}

/// What closes a gap in a contour (AMB-09).
enum class GapFill {
    GuardedBezier,  ///< Cubic with the guards of A.9.
    PlainBezier,    ///< Cubic without guards.
    Chord,          ///< Nothing; shows what the curve contributes.
};
inline constexpr std::string_view kGapFillNames[] = {"guarded-bezier", "plain-bezier", "chord"};
constexpr std::span<const std::string_view> names_of(GapFill) {
    return kGapFillNames;
}

/// Which radii the depth is the least of (AMB-10).
enum class DepthFrom {
    FinalRadii,  ///< The 360 stored ones, after gaps are filled.
    Hits,        ///< The retained hits, before.
};
inline constexpr std::string_view kDepthFromNames[] = {"final-radii", "hits"};
constexpr std::span<const std::string_view> names_of(DepthFrom) {
    return kDepthFromNames;
}

}  // namespace scree::vision
