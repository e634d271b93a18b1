#pragma once

#include "base/progress.h"
#include "terrain/material/description_map.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::terrain {

enum class StrokeKind {
    Brush,    ///< A disc, at a point or dragged along a line of points.
    Polygon,  ///< The inside of a closed line, by even-odd crossings.
    Fill,     ///< The cells joined by their sides to that at the point, of the same id.
    Undo,     ///< Take back the last strokes.
    Redo,     ///< Bring back strokes taken back since the last new one.
};

/// One line of a script. Lengths are metres on the ground, x and z.
///
/// Ids have a hard edge; parameters fade over the soft part of a brush or the fade of a polygon,
/// and are half-way where the ids change.
struct Stroke {
    StrokeKind kind = StrokeKind::Brush;
    std::vector<glm::dvec2> points;
    double radius = 0.5;    ///< Of a brush: nothing changes beyond it.
    double hardness = 1.0;  ///< Share of the radius where a brush works fully; 1: no soft part.
    double fade = 0.0;      ///< Width over which a polygon's parameters fade across its edge.
    int id = 0;             ///< Material that is laid.
    int count = 1;          ///< Strokes that Undo and Redo move by.
};

/// A script and the ground that it starts from.
struct StrokeScript {
    int width = 0;  ///< Cells; 0: it paints on a map that is there already.
    int height = 0;
    double cell_size = 1.0;  ///< Metres.
    int ground = 0;          ///< Id everywhere at the start.
    std::vector<Stroke> strokes;
};

inline constexpr std::size_t kMaxStrokes = 4'000'000;
inline constexpr std::size_t kMaxStrokePoints = 10'000;
inline constexpr std::size_t kMaxStrokesBytes = std::size_t{1} << 30;

/// Read a script (docs/description-maps.md). Memory is that of the strokes, whatever the text
/// holds.
/// @throw InvalidInput  names `source` and the JSON path.
StrokeScript strokes_from_json(std::string_view text, const std::string& source,
                               const std::vector<Material>& materials);
/// The script as text that reads back as the same script, materials by id.
std::string strokes_to_json(const StrokeScript& script);

/// @throw IoError, InvalidInput
StrokeScript read_strokes(const std::filesystem::path& path,
                          const std::vector<Material>& materials);

/// The strokes that remain once every undo and redo is carried out, as places in `strokes`.
/// @throw InvalidInput  one moves by more strokes than there are; names its place.
std::vector<std::size_t> standing_strokes(std::span<const Stroke> strokes);

/// Lay the standing strokes in order. Each costs what the box about it covers. Planes are made if
/// any is soft; else none are made, and those that are there take the materials' own values.
/// @throw InvalidInput  the map breaks check_map(), a stroke has no material, no point, a radius,
///                      hardness or fade out of range; names its place.
/// @throw Cancelled
void paint(DescriptionMap& map, std::span<const Stroke> strokes, Progress* progress = nullptr);

/// The map of a script that brings its own ground.
DescriptionMap map_from_strokes(const StrokeScript& script, const std::vector<Material>& materials,
                                Progress* progress = nullptr);

}  // namespace scree::terrain
