#pragma once

#include <algorithm>
#include <cstddef>

namespace scree::terrain {

/// A rectangle of grid cells: columns [x, x + width), rows [y, y + height).
struct CellWindow {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;

    bool empty() const { return width <= 0 || height <= 0; }
    bool contains(int cx, int cy) const {
        return cx >= x && cy >= y && cx < x + width && cy < y + height;
    }
    bool operator==(const CellWindow&) const = default;
};

/// The cells that both hold; empty where they do not meet.
inline CellWindow intersection(const CellWindow& a, const CellWindow& b) {
    const int x = std::max(a.x, b.x);
    const int y = std::max(a.y, b.y);
    const int right = std::min(a.x + a.width, b.x + b.width);
    const int bottom = std::min(a.y + a.height, b.y + b.height);
    return {x, y, std::max(0, right - x), std::max(0, bottom - y)};
}

}  // namespace scree::terrain
