#include "meshing/bake/height_bake.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/simd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace scree::meshing {
namespace {

constexpr double kMaxPixels = 200e6;
constexpr int kBandRows = 32;  // rows one task fills; small pictures still make a few tasks

// One rock, ready for the inner loop: pixels across, metres up.
struct Dome {
    float centre_x = 0.0F;
    float centre_y = 0.0F;
    float reach = 0.0F;   // greatest radius
    float height = 0.0F;  // metres
    // Radii at whole degrees, closed, and one more that a rounded-up azimuth of 360 may read.
    std::array<float, vision::kRadii + 2> radii{};
};

// Whole rows of one rock, clipped to the picture.
struct Span {
    int first = 0;
    int last = 0;  // one past the end
};

void check_picture(const vision::RockSet& rocks) {
    const double pixels = static_cast<double>(rocks.width) * rocks.height;
    if (rocks.width < 1 || rocks.height < 1 || pixels > kMaxPixels)
        fail<InvalidInput>("a displacement map of ", rocks.width, " x ", rocks.height,
                           " pixels cannot be baked, it must have 1 to ", kMaxPixels);
    if (!std::isfinite(scale_of(rocks)))
        fail<InvalidInput>("the scale is ", scale_of(rocks), " metres per pixel, not a number");
}

void check_rock(const vision::Rock& rock, std::size_t index) {
    const bool centred =
        std::isfinite(rock.outline.centre.x) && std::isfinite(rock.outline.centre.y) &&
        std::abs(rock.outline.centre.x) < 1e7 && std::abs(rock.outline.centre.y) < 1e7;
    const bool round = std::all_of(rock.outline.radii.begin(), rock.outline.radii.end(),
                                   [](float r) { return r > 1e-6F && r < 1e6F; });
    if (!centred || !round || !(rock.depth >= 0.0F && rock.depth < 1e6F))
        fail<InvalidInput>("rock ", index,
                           " has a centre, radius or depth that is no usable number of pixels");
}

Dome dome_of(const vision::Rock& rock, double metres_per_pixel) {
    Dome dome;
    dome.centre_x = static_cast<float>(rock.outline.centre.x);
    dome.centre_y = static_cast<float>(rock.outline.centre.y);
    const auto& radii = rock.outline.radii;
    std::copy(radii.begin(), radii.end(), dome.radii.begin());
    dome.radii[vision::kRadii] = radii[0];
    dome.radii[vision::kRadii + 1] = radii[1];
    dome.reach = *std::max_element(radii.begin(), radii.end());
    dome.height = static_cast<float>(rock.depth * metres_per_pixel);
    return dome;
}

// Pixels of one axis whose centres may lie within `reach` of `centre`.
Span covered(float centre, float reach, int size) {
    const auto limit = static_cast<double>(size);
    const double first = std::clamp(std::floor(double(centre) - reach - 0.5), 0.0, limit);
    const double last = std::clamp(std::ceil(double(centre) + reach + 0.5), 0.0, limit);
    return {static_cast<int>(first), static_cast<int>(last)};
}

// Azimuth of (x, y) in degrees, 0 to 360, growing from +x to +y; off by less than 1e-4. The
// polynomial interpolates atan(q)/q at nine Chebyshev nodes in q^2, in degrees.
inline float azimuth_degrees(float x, float y) {
    const float along = std::abs(x);
    const float across = std::abs(y);
    const float longer = along > across ? along : across;
    const float shorter = along > across ? across : along;
    const float q = shorter / (longer + 1e-30F);
    const float t = q * q;
    float d = 0.158496370F;
    d = d * t - 0.901334181F;
    d = d * t + 2.414307990F;
    d = d * t - 4.272463100F;
    d = d * t + 6.083878228F;
    d = d * t - 8.134738920F;
    d = d * t + 11.454498918F;
    d = d * t - 19.098423218F;
    d = (d * t + 57.295778470F) * q;
    d = across > along ? 90.0F - d : d;
    d = x < 0.0F ? 180.0F - d : d;
    return y < 0.0F ? 360.0F - d : d;
}

// Part E: y = C_y + h sqrt(1 - (rho / r(phi))^2) where rho < r(phi), here with C_y = 0; the
// greatest over all rocks stays. Written with plain selections, which the compiler can vectorise
// (std::max works on references, and is left scalar).
SCREE_MULTIVERSION void raise_row(const Dome& dome, float dy, int first, int last,
                                  float* __restrict row) {
    const float* const radii = dome.radii.data();
    const float centre = dome.centre_x;
    const float depth = dome.height;
    const float across = dy * dy;
    for (int x = first; x < last; ++x) {
        const float dx = (static_cast<float>(x) + 0.5F) - centre;
        const float degrees = azimuth_degrees(dx, dy);
        const int k = static_cast<int>(degrees);
        const float share = degrees - static_cast<float>(k);
        const float r = radii[k] + share * (radii[k + 1] - radii[k]);
        const float rest = 1.0F - (dx * dx + across) / (r * r);
        const float height = depth * std::sqrt(rest > 0.0F ? rest : 0.0F);
        const float old = row[x];
        row[x] = old > height ? old : height;
    }
}

void raise_band(const std::vector<Dome>& domes, const std::vector<std::size_t>& here, Span rows,
                FloatRaster& metres) {
    for (const std::size_t index : here) {
        const Dome& dome = domes[index];
        const Span own = covered(dome.centre_y, dome.reach, metres.height());
        const int first = std::max(rows.first, own.first);
        const int last = std::min(rows.last, own.last);
        for (int y = first; y < last; ++y) {
            const float dy = (static_cast<float>(y) + 0.5F) - dome.centre_y;
            const float half = std::sqrt(std::max(dome.reach * dome.reach - dy * dy, 0.0F));
            const Span columns = covered(dome.centre_x, half, metres.width());
            raise_row(dome, dy, columns.first, columns.last, metres.row(y));
        }
    }
}

}  // namespace

vision::HeightImage bake_displacement(const vision::RockSet& rocks) {
    check_picture(rocks);
    vision::HeightImage heights{FloatRaster(rocks.width, rocks.height), scale_of(rocks)};
    const auto n_bands = static_cast<std::size_t>((rocks.height + kBandRows - 1) / kBandRows);
    std::vector<Dome> domes;
    domes.reserve(rocks.rocks.size());
    std::vector<std::vector<std::size_t>> by_band(n_bands);
    for (std::size_t i = 0; i < rocks.rocks.size(); ++i) {
        check_rock(rocks.rocks[i], i);
        domes.push_back(dome_of(rocks.rocks[i], heights.metres_per_pixel));
        const Span rows = covered(domes[i].centre_y, domes[i].reach, rocks.height);
        for (int band = rows.first / kBandRows; band * kBandRows < rows.last; ++band)
            by_band[static_cast<std::size_t>(band)].push_back(i);
    }
    parallel_for_each_index(0, n_bands, 1, [&](std::size_t band) {
        const int first = static_cast<int>(band) * kBandRows;
        const Span rows{first, std::min(first + kBandRows, rocks.height)};
        raise_band(domes, by_band[band], rows, heights.metres);
    });
    return heights;
}

}  // namespace scree::meshing
