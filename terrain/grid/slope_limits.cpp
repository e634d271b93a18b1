#include "terrain/grid/slope_limits.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

namespace scree::terrain {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Rounded up, so that a base that is just kept does not move by rounding.
float base_step(float a, float b) {
    const auto step = static_cast<float>(std::abs(static_cast<double>(a) - static_cast<double>(b)));
    return step == 0.0F ? 0.0F : std::nextafter(step, kInfinity);
}

void set_face(float higher_when_rising, float higher_when_falling, float kept, double cell_size,
              float& rise, float& fall) {
    rise = std::max(kept, static_cast<float>(higher_when_rising * cell_size));
    fall = std::max(kept, static_cast<float>(higher_when_falling * cell_size));
}

double face_excess(double difference, float rise, float fall) {
    return std::max(difference - static_cast<double>(rise),
                    -difference - static_cast<double>(fall));
}

}  // namespace

SlopeLimits slope_limits(const Heightfield& base, const SoilTile& soil, bool keep_base) {
    const int width = base.heights.width();
    const int height = base.heights.height();
    const FloatRaster& tan = soil.tan_repose;
    const FloatRaster none(width, height);
    SlopeLimits limits{none, none, none, none};
    const auto kept = [&](int x, int y, int to_x, int to_y) {
        return keep_base ? base_step(base.heights(x, y), base.heights(to_x, to_y)) : 0.0F;
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (x + 1 < width)
                set_face(tan(x + 1, y), tan(x, y), kept(x, y, x + 1, y), base.cell_size,
                         limits.rise_x(x, y), limits.fall_x(x, y));
            if (y + 1 < height)
                set_face(tan(x, y + 1), tan(x, y), kept(x, y, x, y + 1), base.cell_size,
                         limits.rise_z(x, y), limits.fall_z(x, y));
        }
    return limits;
}

double greatest_excess(const DoubleRaster& heights, const SlopeLimits& limits, double cell_size) {
    double excess = 0.0;
    for (int y = 0; y < heights.height(); ++y)
        for (int x = 0; x < heights.width(); ++x) {
            const double here = heights(x, y);
            if (x + 1 < heights.width())
                excess = std::max(excess, face_excess(heights(x + 1, y) - here, limits.rise_x(x, y),
                                                      limits.fall_x(x, y)));
            if (y + 1 < heights.height())
                excess = std::max(excess, face_excess(heights(x, y + 1) - here, limits.rise_z(x, y),
                                                      limits.fall_z(x, y)));
        }
    return excess / cell_size;
}

DoubleRaster total_heights(const Heightfield& base, const FloatRaster& displacement) {
    DoubleRaster heights(displacement.width(), displacement.height());
    std::transform(
        base.heights.begin(), base.heights.end(), displacement.begin(), heights.begin(),
        [](float b, float u) { return static_cast<double>(b) + static_cast<double>(u); });
    return heights;
}

void store_displacement(const DoubleRaster& before, const DoubleRaster& heights,
                        const Heightfield& base, FloatRaster& displacement) {
    for (std::size_t i = 0; i < heights.size(); ++i)
        if (heights.data()[i] != before.data()[i])
            displacement.data()[i] =
                static_cast<float>(heights.data()[i] - static_cast<double>(base.heights.data()[i]));
}

void check_ground(const Heightfield& base, const FloatRaster& displacement) {
    check_heightfield(base);
    if (displacement.width() != base.heights.width() ||
        displacement.height() != base.heights.height())
        fail<InvalidInput>("the displacement has ", displacement.width(), " x ",
                           displacement.height(), " cells, its base ", base.heights.width(), " x ",
                           base.heights.height(), "; they must agree");
    for (int y = 0; y < displacement.height(); ++y)
        for (int x = 0; x < displacement.width(); ++x)
            if (!std::isfinite(displacement(x, y)))
                fail<InvalidInput>("the displacement of cell (", x, ", ", y, ") is ",
                                   displacement(x, y), ", must be finite");
}

void check_soil_tile(const Heightfield& base, const SoilTile& soil) {
    using Plane = std::pair<const char*, const FloatRaster*>;
    for (const auto& [name, plane] :
         {Plane{"tan_repose", &soil.tan_repose}, Plane{"repose", &soil.repose},
          Plane{"diffusion", &soil.diffusion}}) {
        if (plane->width() != base.heights.width() || plane->height() != base.heights.height())
            fail<InvalidInput>("the soil's ", name, " plane has ", plane->width(), " x ",
                               plane->height(), " cells, the ground ", base.heights.width(), " x ",
                               base.heights.height(), "; they must agree");
        for (int y = 0; y < plane->height(); ++y)
            for (int x = 0; x < plane->width(); ++x)
                if (!((*plane)(x, y) >= 0.0F && (*plane)(x, y) < kInfinity))
                    fail<InvalidInput>("the soil's ", name, " of cell (", x, ", ", y, ") is ",
                                       (*plane)(x, y), ", must be a number of at least 0");
    }
}

}  // namespace scree::terrain
