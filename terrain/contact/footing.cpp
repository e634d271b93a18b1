#include "terrain/contact/footing.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace scree::terrain {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr int kHalvings = 32;

// Greatest height of the footing above the underside; minus infinity if no cell is below it.
double deepest(const Footing& footing, const Underside& underside) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < underside.heights.size(); ++i)
        if (underside.heights.data()[i] < kNone)
            most = std::max(
                most, static_cast<double>(footing.heights.data()[i]) - underside.heights.data()[i]);
    return most;
}

// A cell that may bear: how far the footing stands above the underside before it is raised.
struct Spring {
    double depth = 0.0;
    double stiffness = 0.0;
};

double support(const std::vector<Spring>& springs, double raise) {
    double sum = 0.0;
    for (const Spring& spring : springs)
        sum += spring.stiffness * std::max(0.0, spring.depth - raise);
    return sum;
}

}  // namespace

void follow(Footing& footing, const Underside& underside, const FloatRaster& heights) {
    Footing next{underside.window, heights};
    const CellWindow kept = intersection(footing.window, next.window);
    for (int y = kept.y; y < kept.y + kept.height; ++y)
        for (int x = kept.x; x < kept.x + kept.width; ++x) {
            const float under = underside.heights(x - next.window.x, y - next.window.y);
            const float before = footing.heights(x - footing.window.x, y - footing.window.y);
            float& now = next.heights(x - next.window.x, y - next.window.y);
            // Pushed down to the underside, or a little off it by rounding: still the object's.
            const bool reached = under < kNone && std::max(now, before) >= under;
            if (reached)
                now = before;
        }
    footing = std::move(next);
}

double raise_to_sink(const Footing& footing, const Underside& underside, double sink_m) {
    return underside.covered == 0 ? 0.0 : deepest(footing, underside) - sink_m;
}

double raise_to_bear(const Footing& footing, const Underside& underside,
                     const FloatRaster& stiffness, double cell_size, double load_n) {
    if (underside.covered == 0)
        return 0.0;
    std::vector<Spring> springs;
    for (std::size_t i = 0; i < underside.heights.size(); ++i)
        if (underside.heights.data()[i] < kNone)
            springs.push_back(
                {static_cast<double>(footing.heights.data()[i]) - underside.heights.data()[i],
                 cell_size * cell_size * stiffness.data()[i]});
    double high = deepest(footing, underside);  // bears nothing
    double step = cell_size;
    double low = high - step;
    // Doubling ends: the support grows with the depth without limit where any stiffness is
    // positive; a ground that bears nothing lets it sink a thousand kilometres.
    while (support(springs, low) < load_n && step < 1e6) {
        step *= 2.0;
        low = high - step;
    }
    std::erase_if(springs, [low](const Spring& spring) { return spring.depth <= low; });
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        if (support(springs, middle) < load_n)
            high = middle;
        else
            low = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace scree::terrain
