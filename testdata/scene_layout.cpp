#include "testdata/scene_layout.h"

#include "base/parallel.h"
#include "base/random.h"
#include "testdata/lattice_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>

namespace scree::test {
namespace {

constexpr std::uint64_t kDiameterStream = 35;
constexpr std::uint64_t kPlaceStream = 36;
constexpr std::size_t kMostBodies = 20000;

FloatRaster wavy_ground(const SceneOptions& o, int width, int height) {
    FloatRaster ground(width, height);
    const double swell = 3.0 + 0.06 * o.greatest;
    parallel_for_each_index(0, static_cast<std::size_t>(height), 16, [&](std::size_t row) {
        const auto y = static_cast<int>(row);
        for (int x = 0; x < width; ++x)
            ground(x, y) = static_cast<float>(
                swell * fractal_noise(o.seed * 31 + 5, x, y, 60.0 + o.greatest, 4) +
                1.4 * o.grain * (smooth_noise(o.seed * 31 + 9, x, y, 3.0) - 0.5) +
                0.8 * o.grain * (lattice(o.seed * 31 + 10, x, y) - 0.5));
    });
    return ground;
}

// Diameters in canvas pixels from a power law, until they cover their share of the canvas.
std::vector<double> draw_diameters(double least, double greatest, double area,
                                   const SceneOptions& o, std::uint64_t step) {
    std::vector<double> diameters;
    const double power = 1.0 - o.size_exponent;
    while (area > 0.0 && diameters.size() < kMostBodies) {
        Rng rng(
            {.seed = o.seed, .stream = kDiameterStream, .step = step, .cell = diameters.size()});
        const double u = rng.uniform();
        const double d = std::abs(power) < 1e-6
                             ? least * std::pow(greatest / least, u)
                             : std::pow(std::pow(least, power) + u * (std::pow(greatest, power) -
                                                                      std::pow(least, power)),
                                        1.0 / power);
        diameters.push_back(d);
        area -= 0.25 * std::numbers::pi * d * d;
    }
    return diameters;
}

class Layer {
public:
    Layer(Heap& heap, const SceneOptions& o) : heap_(heap), options_(o) {}

    // Try places, take the lowest, and draw the body there. A body of many pixels is looked at in
    // few of them.
    void drop(Body body, int n_places, std::uint64_t index) {
        Rng rng({.seed = options_.seed,
                 .stream = kPlaceStream,
                 .step = static_cast<std::uint64_t>(body.kind),
                 .cell = index});
        double lowest = 1e30;
        glm::dvec2 best{0.0};
        for (int place = 0; place < n_places; ++place) {
            body.centre = {rng.uniform(0.0, heap_.height.width()),
                           rng.uniform(0.0, heap_.height.height())};
            const double level = resting_level(body);
            if (level < lowest) {
                lowest = level;
                best = body.centre;
            }
        }
        body.centre = best;
        const double sunk = body.kind == BodyKind::Thing
                                ? 0.0
                                : options_.burial * body.thickness * rng.uniform(0.3, 1.7);
        body.level = lowest - sunk;
        draw(body);
    }

private:
    // A body rests on the higher fifth of what lies below it: on single peaks it would roll off.
    double resting_level(const Body& body) const {
        constexpr int kLooks = 40;
        std::array<double, kLooks> contact{};
        std::size_t n = 0;
        for (int k = 0; k < kLooks; ++k) {
            const double radius = std::sqrt((k + 0.5) / kLooks);
            const double angle = 2.399963 * k;  // the golden angle spreads them evenly
            const glm::dvec2 local{radius * std::cos(angle), radius * std::sin(angle)};
            const double top = relative_height(body, local);
            const glm::ivec2 p = on_canvas(body, local);
            if (top < 0.0 || !heap_.height.contains(p.x, p.y))
                continue;
            const double below = body.kind == BodyKind::Thing ? 0.0 : 0.8 * top * body.thickness;
            contact[n++] = heap_.height(p.x, p.y) + below;
        }
        if (n == 0)
            return 1e29;
        const auto fifth = contact.begin() + static_cast<std::ptrdiff_t>(n - 1 - n / 5);
        std::nth_element(contact.begin(), fifth, contact.begin() + static_cast<std::ptrdiff_t>(n));
        return *fifth;
    }

    static glm::ivec2 on_canvas(const Body& body, glm::dvec2 local) {
        const double c = std::cos(body.azimuth);
        const double s = std::sin(body.azimuth);
        const glm::dvec2 q = local * body.axes;
        return glm::ivec2(
            glm::floor(body.centre + glm::dvec2(c * q.x - s * q.y, s * q.x + c * q.y)));
    }

    void draw(const Body& body) {
        const auto index = static_cast<std::int32_t>(heap_.bodies.size());
        const double reach = 1.3 * std::hypot(body.axes.x, body.axes.y);
        const int left = std::max(0, static_cast<int>(body.centre.x - reach));
        const int top = std::max(0, static_cast<int>(body.centre.y - reach));
        const int right = std::min(heap_.height.width(), static_cast<int>(body.centre.x + reach));
        const int bottom = std::min(heap_.height.height(), static_cast<int>(body.centre.y + reach));
        double area = 0.0;
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) {
                const glm::dvec2 local = to_local(body, {x + 0.5, y + 0.5});
                const double relative = relative_height(body, local);
                if (relative < 0.0)
                    continue;
                area += 1.0;
                const double bump =
                    body.bumps == 0.0 || body.kind == BodyKind::Thing
                        ? 0.0
                        : body.bumps * fractal_noise(body.seed + 3, local.x, local.y, 0.5, 4);
                const double height = body.level + body.thickness * (relative + bump);
                if (height <= heap_.height(x, y))
                    continue;
                heap_.height(x, y) = static_cast<float>(height);
                heap_.owner(x, y) = index;
                if (body.kind != BodyKind::Pebble)
                    heap_.rock(x, y) = index;
            }
        heap_.bodies.push_back(body);
        heap_.laid_area.push_back(area);
    }

    Heap& heap_;
    const SceneOptions& options_;
};

void drop_rocks(Layer& layer, const SceneOptions& o, double canvas_area) {
    std::vector<double> diameters = draw_diameters(
        kOversampling * o.least, kOversampling * o.greatest, o.coverage * canvas_area, o, 0);
    // Mostly the large ones first; a shaken order puts some small ones below large ones.
    std::vector<std::pair<double, double>> order;
    for (std::size_t i = 0; i < diameters.size(); ++i) {
        Rng rng({.seed = o.seed, .stream = kDiameterStream, .step = 7, .cell = i});
        order.emplace_back(-std::log(diameters[i]) + 0.35 * rng.normal(), diameters[i]);
    }
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < order.size(); ++i)
        layer.drop(make_rock(o, order[i].second, i), 24, i);
}

void drop_clutter(Layer& layer, const SceneOptions& o, double canvas_area) {
    const double least = kOversampling * 1.5;
    const double greatest = kOversampling * std::max(2.5, std::min(0.8 * o.least, 9.0));
    const auto diameters = draw_diameters(least, greatest, 0.5 * o.pebbles * canvas_area, o, 1);
    constexpr std::uint64_t kAfterRocks = 1000000;
    for (std::size_t i = 0; i < diameters.size(); ++i) {
        Body body = make_rock(o, diameters[i], kAfterRocks + i);
        body.kind = BodyKind::Pebble;
        layer.drop(body, 12, i);
    }
}

}  // namespace

Heap lay_heap(const SceneOptions& o) {
    const int width = kOversampling * o.width + 2 * kMargin;
    const int height = kOversampling * o.height + 2 * kMargin;
    Heap heap;
    heap.ground = wavy_ground(o, width, height);
    heap.height = heap.ground;
    heap.owner = Raster<std::int32_t>(width, height, -1);
    heap.rock = heap.owner;
    const double area = static_cast<double>(width) * height;
    Layer layer(heap, o);
    drop_rocks(layer, o, area);
    drop_clutter(layer, o, area);
    for (int i = 0; i < o.n_things; ++i)
        layer.drop(make_thing(o, static_cast<std::uint64_t>(i)), 1, static_cast<std::uint64_t>(i));
    return heap;
}

}  // namespace scree::test
