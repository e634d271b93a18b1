#pragma once

#include "terrain/grid/cell_window.h"

#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::terrain {

/// Cells of a map whose centres may lie within `reach` of the points; coordinates in cells.
CellWindow cells_about(std::span<const glm::dvec2> points, double reach, const CellWindow& map);

/// Values of the cells of a window, row by row; reused from stroke to stroke.
struct WindowValues {
    CellWindow window;
    std::vector<float> values;

    void start(const CellWindow& cells, float value) {
        window = cells;
        values.assign(
            static_cast<std::size_t>(cells.width) * static_cast<std::size_t>(cells.height), value);
    }
    float& at(int x, int y) {
        return values[static_cast<std::size_t>(y - window.y) *
                          static_cast<std::size_t>(window.width) +
                      static_cast<std::size_t>(x - window.x)];
    }
};

/// Lower the values to the distance of the cells' centres from the line through the points (closed
/// if asked for), where that is at most `reach`; in cells.
void lower_to_line(std::span<const glm::dvec2> points, bool closed, double reach,
                   WindowValues& values);

/// Negate the values of the cells whose centres lie inside the polygon, by even-odd crossings.
void negate_inside(std::span<const glm::dvec2> polygon, WindowValues& values);

}  // namespace scree::terrain
