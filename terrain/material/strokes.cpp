#include "terrain/material/strokes.h"

#include "base/error.h"
#include "terrain/material/map_check.h"
#include "terrain/material/stroke_shapes.h"

#include <algorithm>
#include <cmath>

#include <glm/trigonometric.hpp>

namespace scree::terrain {
namespace {

constexpr double kMaxLength = 1e6;  // metres
constexpr float kOutside = 1e30F;   // farther than any fade

[[noreturn]] void refuse(std::size_t place, std::string_view words) {
    fail<InvalidInput>("strokes[", place, "] ", words);
}

void check_stroke(const Stroke& stroke, std::size_t place, const std::array<int, 256>& slots) {
    if (stroke.id < 0 || stroke.id > 255 || slots[static_cast<std::size_t>(stroke.id)] < 0)
        refuse(place, "lays a material that is not in the table");
    const std::size_t least = stroke.kind == StrokeKind::Polygon ? 3 : 1;
    const bool one = stroke.kind == StrokeKind::Fill;
    if (stroke.points.size() < least || stroke.points.size() > (one ? 1 : kMaxStrokePoints))
        refuse(place, one ? "needs one point" : "has too few points or too many");
    for (const glm::dvec2& point : stroke.points)
        if (!(std::abs(point.x) <= kMaxLength && std::abs(point.y) <= kMaxLength))
            refuse(place, "has a point beyond 1e6 m or that is no number");
    if (!(stroke.radius > 0.0 && stroke.radius <= kMaxLength))
        refuse(place, "has a radius outside (0, 1e6] m");
    if (!(stroke.hardness >= 0.0 && stroke.hardness <= 1.0))
        refuse(place, "has a hardness outside [0, 1]");
    if (!(stroke.fade >= 0.0 && stroke.fade <= kMaxLength))
        refuse(place, "has a fade outside [0, 1e6] m");
}

bool is_soft(const Stroke& stroke) {
    return (stroke.kind == StrokeKind::Brush && stroke.hardness < 1.0) ||
           (stroke.kind == StrokeKind::Polygon && stroke.fade > 0.0);
}

void make_planes(DescriptionMap& map) {
    const std::array<int, 256> slots = slots_of_ids(map.materials);
    const auto make = [&](FloatRaster& plane, auto value) {
        if (!plane.empty())
            return;
        plane = FloatRaster(map.ids.width(), map.ids.height());
        for (std::size_t i = 0; i < plane.size(); ++i) {
            const auto slot = static_cast<std::size_t>(slots[map.ids.data()[i]]);
            plane.data()[i] = static_cast<float>(value(map.materials[slot].soil));
        }
    };
    make(map.repose, [](const Soil& s) { return glm::radians(s.repose_deg); });
    make(map.mobility, [](const Soil& s) { return s.mobility; });
    make(map.diffusion, [](const Soil& s) { return s.diffusion; });
}

/// What a stroke lays.
struct Paint {
    std::uint8_t id;
    float repose, mobility, diffusion;
};

class Painter {
public:
    explicit Painter(DescriptionMap& map)
        : map_(map), all_{0, 0, map.ids.width(), map.ids.height()} {}

    void lay(const Stroke& stroke, const Material& material) {
        paint_ = {static_cast<std::uint8_t>(material.id),
                  static_cast<float>(glm::radians(material.soil.repose_deg)),
                  static_cast<float>(material.soil.mobility),
                  static_cast<float>(material.soil.diffusion)};
        points_ = stroke.points;
        for (glm::dvec2& point : points_)
            point /= map_.cell_size;
        if (stroke.kind == StrokeKind::Brush)
            brush(stroke);
        else if (stroke.kind == StrokeKind::Polygon)
            polygon(stroke);
        else
            fill();
    }

private:
    void brush(const Stroke& stroke) {
        const double radius = stroke.radius / map_.cell_size;
        const CellWindow cells = cells_about(points_, radius, all_);
        if (cells.empty())
            return;
        values_.start(cells, kOutside);
        lower_to_line(points_, false, radius, values_);
        const double edge = 0.5 * (1.0 + stroke.hardness) * radius;
        apply(edge, 0.5 * (1.0 - stroke.hardness) * radius);
    }

    void polygon(const Stroke& stroke) {
        const double half = 0.5 * stroke.fade / map_.cell_size;
        const CellWindow cells = cells_about(points_, half, all_);
        if (cells.empty())
            return;
        values_.start(cells, kOutside);
        if (half > 0.0)
            lower_to_line(points_, true, half, values_);
        negate_inside(points_, values_);
        apply(0.0, half);
    }

    // The share of the stroke falls from one to zero over `edge` -+ `half`, smoothly.
    void apply(double edge, double half) {
        const CellWindow& w = values_.window;
        for (int y = w.y; y < w.y + w.height; ++y)
            for (int x = w.x; x < w.x + w.width; ++x) {
                const double inside = edge - double{values_.at(x, y)};
                if (half <= 0.0) {
                    if (inside >= 0.0)
                        blend(x, y, 1.0F);
                    continue;
                }
                const double s = std::clamp(0.5 + 0.5 * inside / half, 0.0, 1.0);
                if (s > 0.0)
                    blend(x, y, static_cast<float>(s * s * (3.0 - 2.0 * s)));
            }
    }

    void blend(int x, int y, float share) {
        if (share >= 0.5F)
            map_.ids(x, y) = paint_.id;
        const auto mix = [&](FloatRaster& plane, float value) {
            if (plane.empty())
                return;
            float& cell = plane(x, y);
            cell = share >= 1.0F ? value : cell + share * (value - cell);
        };
        mix(map_.repose, paint_.repose);
        mix(map_.mobility, paint_.mobility);
        mix(map_.diffusion, paint_.diffusion);
    }

    // Row by row: a span of the old id is laid at once, its neighbours above and below wait.
    void fill() {
        const int x0 = static_cast<int>(std::floor(points_[0].x));
        const int y0 = static_cast<int>(std::floor(points_[0].y));
        if (!map_.ids.contains(x0, y0) || map_.ids(x0, y0) == paint_.id)
            return;
        const std::uint8_t old = map_.ids(x0, y0);
        std::vector<glm::ivec2> waiting{{x0, y0}};
        while (!waiting.empty()) {
            const glm::ivec2 seed = waiting.back();
            waiting.pop_back();
            if (map_.ids(seed.x, seed.y) != old)
                continue;
            int left = seed.x;
            while (left > 0 && map_.ids(left - 1, seed.y) == old)
                --left;
            int end = left;
            for (; end < map_.ids.width() && map_.ids(end, seed.y) == old; ++end)
                blend(end, seed.y, 1.0F);
            for (const int y : {seed.y - 1, seed.y + 1})
                if (y >= 0 && y < map_.ids.height())
                    for (int x = left; x < end; ++x)
                        if (map_.ids(x, y) == old && (x == left || map_.ids(x - 1, y) != old))
                            waiting.emplace_back(x, y);
        }
    }

    DescriptionMap& map_;
    CellWindow all_;
    Paint paint_{};
    std::vector<glm::dvec2> points_;  // in cells
    WindowValues values_;
};

}  // namespace

std::vector<std::size_t> standing_strokes(std::span<const Stroke> strokes) {
    std::vector<std::size_t> standing;
    std::vector<std::size_t> undone;
    for (std::size_t i = 0; i < strokes.size(); ++i) {
        const StrokeKind kind = strokes[i].kind;
        if (kind != StrokeKind::Undo && kind != StrokeKind::Redo) {
            standing.push_back(i);
            undone.clear();
            continue;
        }
        const bool undo = kind == StrokeKind::Undo;
        std::vector<std::size_t>& from = undo ? standing : undone;
        std::vector<std::size_t>& to = undo ? undone : standing;
        if (strokes[i].count < 1 || static_cast<std::size_t>(strokes[i].count) > from.size())
            fail<InvalidInput>("strokes[", i, "] ", undo ? "takes" : "brings", " back ",
                               strokes[i].count, " strokes, of ", from.size(), " that there are");
        for (int n = 0; n < strokes[i].count; ++n) {
            to.push_back(from.back());
            from.pop_back();
        }
    }
    return standing;
}

void paint(DescriptionMap& map, std::span<const Stroke> strokes, Progress* progress) {
    check_map(map, "the map to paint on");
    const std::array<int, 256> slots = slots_of_ids(map.materials);
    const std::vector<std::size_t> standing = standing_strokes(strokes);
    bool soft = false;
    for (const std::size_t place : standing) {
        check_stroke(strokes[place], place, slots);
        soft = soft || is_soft(strokes[place]);
    }
    if (soft)
        make_planes(map);
    Painter painter(map);
    for (std::size_t i = 0; i < standing.size(); ++i) {
        if (i % 256 == 0)
            report_progress(progress, "painting",
                            static_cast<double>(i) / static_cast<double>(standing.size()));
        const Stroke& stroke = strokes[standing[i]];
        const auto slot = static_cast<std::size_t>(slots[static_cast<std::size_t>(stroke.id)]);
        painter.lay(stroke, map.materials[slot]);
    }
}

DescriptionMap map_from_strokes(const StrokeScript& script, const std::vector<Material>& materials,
                                Progress* progress) {
    check_materials(materials, "the table of materials");
    check_map_size(script.width, script.height, "the script's ground");
    if (script.ground < 0 || script.ground > 255)
        fail<InvalidInput>("the script's ground has the id ", script.ground, ", ids are 0 to 255");
    DescriptionMap map;
    map.cell_size = script.cell_size;
    map.materials = materials;
    map.ids =
        Raster<std::uint8_t>(script.width, script.height, static_cast<std::uint8_t>(script.ground));
    paint(map, script.strokes, progress);
    return map;
}

}  // namespace scree::terrain
