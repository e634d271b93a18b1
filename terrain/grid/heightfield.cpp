#include "terrain/grid/heightfield.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace scree::terrain {

void check_heightfield(const Heightfield& field) {
    if (field.heights.width() < 2 || field.heights.height() < 2)
        fail<InvalidInput>("the ground has ", field.heights.width(), " x ", field.heights.height(),
                           " cells, at least 2 x 2 are needed");
    if (!(field.cell_size > 0.0) || !std::isfinite(field.cell_size))
        fail<InvalidInput>("the ground's cell size is ", field.cell_size,
                           " m, it must be positive");
    for (int y = 0; y < field.heights.height(); ++y) {
        const float* row = field.heights.row(y);
        for (int x = 0; x < field.heights.width(); ++x)
            if (!std::isfinite(row[x]))
                fail<InvalidInput>("the ground's height in cell (", x, ", ", y,
                                   ") is no finite number");
    }
}

double height_at(const Heightfield& field, double x, double z) {
    const FloatRaster& heights = field.heights;
    const double u = std::clamp(x / field.cell_size - 0.5, 0.0, heights.width() - 1.0);
    const double v = std::clamp(z / field.cell_size - 0.5, 0.0, heights.height() - 1.0);
    const int x0 = std::min(static_cast<int>(u), heights.width() - 2);
    const int y0 = std::min(static_cast<int>(v), heights.height() - 2);
    const double fx = u - x0;
    const double fy = v - y0;
    const double top = (1.0 - fx) * heights(x0, y0) + fx * heights(x0 + 1, y0);
    const double bottom = (1.0 - fx) * heights(x0, y0 + 1) + fx * heights(x0 + 1, y0 + 1);
    return (1.0 - fy) * top + fy * bottom;
}

}  // namespace scree::terrain
