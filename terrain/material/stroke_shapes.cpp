#include "terrain/material/stroke_shapes.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

constexpr double kFar = 1e9;  // cells; beyond any map

int cell_of(double place) {
    return static_cast<int>(std::clamp(std::floor(place), -kFar, kFar));
}

double distance_to_segment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 along = b - a;
    const double length2 = glm::dot(along, along);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p - (a + t * along));
}

void lower_to_segment(glm::dvec2 a, glm::dvec2 b, double reach, WindowValues& values) {
    const glm::dvec2 ends[] = {a, b};
    const CellWindow cells = cells_about(ends, reach, values.window);
    for (int y = cells.y; y < cells.y + cells.height; ++y)
        for (int x = cells.x; x < cells.x + cells.width; ++x) {
            const double distance = distance_to_segment({x + 0.5, y + 0.5}, a, b);
            if (distance <= reach)
                values.at(x, y) = std::min(values.at(x, y), static_cast<float>(distance));
        }
}

}  // namespace

CellWindow cells_about(std::span<const glm::dvec2> points, double reach, const CellWindow& map) {
    glm::dvec2 low = points.front();
    glm::dvec2 high = points.front();
    for (const glm::dvec2& point : points) {
        low = {std::min(low.x, point.x), std::min(low.y, point.y)};
        high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
    const int x = cell_of(low.x - reach);
    const int y = cell_of(low.y - reach);
    return intersection({x, y, cell_of(high.x + reach) - x + 1, cell_of(high.y + reach) - y + 1},
                        map);
}

void lower_to_line(std::span<const glm::dvec2> points, bool closed, double reach,
                   WindowValues& values) {
    if (points.size() == 1)
        lower_to_segment(points[0], points[0], reach, values);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        lower_to_segment(points[i], points[i + 1], reach, values);
    if (closed)
        lower_to_segment(points.back(), points.front(), reach, values);
}

void negate_inside(std::span<const glm::dvec2> polygon, WindowValues& values) {
    const CellWindow& window = values.window;
    // Crossings of every row's centre line, gathered edge by edge: an edge meets few rows.
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(window.height));
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        glm::dvec2 a = polygon[i];
        glm::dvec2 b = polygon[(i + 1) % polygon.size()];
        if (a.y > b.y)
            std::swap(a, b);
        const int first = std::max(window.y, cell_of(a.y - 0.5));
        const int last = std::min(window.y + window.height - 1, cell_of(b.y + 0.5));
        for (int y = first; y <= last; ++y) {
            const double line = y + 0.5;
            if (a.y <= line && line < b.y)
                crossings[static_cast<std::size_t>(y - window.y)].push_back(
                    a.x + (b.x - a.x) * ((line - a.y) / (b.y - a.y)));
        }
    }
    for (int y = window.y; y < window.y + window.height; ++y) {
        std::vector<double>& row = crossings[static_cast<std::size_t>(y - window.y)];
        std::sort(row.begin(), row.end());
        for (std::size_t k = 0; k + 1 < row.size(); k += 2) {
            const int first = std::max(window.x, cell_of(std::ceil(row[k] - 0.5)));
            const int end = std::min(window.x + window.width, cell_of(std::ceil(row[k + 1] - 0.5)));
            for (int x = first; x < end; ++x)
                values.at(x, y) = -values.at(x, y);
        }
    }
}

}  // namespace scree::terrain
