#include "testdata/synthetic_photo.h"

#include "base/error.h"
#include "base/random.h"
#include "testdata/synthetic_shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree::test {
namespace {

constexpr std::uint64_t kSizeStream = 11;
constexpr std::uint64_t kShapeStream = 12;
constexpr std::uint64_t kPlaceStream = 13;
constexpr int kDartsPerRock = 400;
constexpr int kGrowthSteps = 10;

using Radii = std::array<float, vision::kRadii>;

// Radii of mean 1: an ellipse-like second harmonic and a few lobes that fade with their order.
Radii lobed_shape(const SyntheticOptions& o, std::size_t rock) {
    Rng rng({.seed = o.seed, .stream = kShapeStream, .cell = rock});
    constexpr int kHarmonics = 8;
    std::array<double, kHarmonics> amplitude{};
    std::array<double, kHarmonics> phase{};
    for (std::size_t n = 2; n < kHarmonics; ++n) {
        const double strength = n == 2 ? o.elongation * rng.uniform()
                                       : o.roughness * rng.normal() / static_cast<double>(n - 1);
        amplitude[n] = std::clamp(strength, -0.3, 0.3);
        phase[n] = rng.uniform(0.0, 2.0 * std::numbers::pi);
    }
    Radii radii{};
    for (std::size_t k = 0; k < radii.size(); ++k) {
        const double azimuth = 2.0 * std::numbers::pi * static_cast<double>(k) / vision::kRadii;
        double r = 1.0;
        for (std::size_t n = 2; n < kHarmonics; ++n)
            r += amplitude[n] * std::cos(static_cast<double>(n) * azimuth + phase[n]);
        radii[k] = static_cast<float>(std::max(0.3, r));
    }
    return radii;
}

std::vector<double> draw_diameters(const SyntheticOptions& o) {
    std::vector<double> diameters;
    for (int i = 0; i < o.n_rocks; ++i) {
        Rng rng({.seed = o.seed, .stream = kSizeStream, .cell = static_cast<std::uint64_t>(i)});
        const double d = o.median_diameter * std::exp(o.size_spread * rng.normal());
        diameters.push_back(std::clamp(d, o.least_diameter, o.greatest_diameter));
    }
    std::sort(diameters.begin(), diameters.end(), std::greater<>());
    return diameters;
}

vision::Outline scaled(glm::dvec2 centre, const Radii& shape, double radius, double pad) {
    vision::Outline outline;
    outline.centre = centre;
    for (std::size_t k = 0; k < shape.size(); ++k)
        outline.radii[k] = static_cast<float>(shape[k] * radius + pad);
    outline.confidence = 1.0F;
    return outline;
}

double reach_of(const vision::Outline& outline) {
    return *std::max_element(outline.radii.begin(), outline.radii.end());
}

// The ground with a rim around the picture, so that rocks cut by its edge keep their distance too.
class Ground {
public:
    Ground(const SyntheticOptions& o)
        : margin_(static_cast<int>(std::ceil(1.5 * o.greatest_diameter + o.gap))),
          taken_(o.width + 2 * margin_, o.height + 2 * margin_) {}

    bool is_free(const vision::Outline& outline) const {
        constexpr std::array<double, 5> kRings{1.0, 0.0, 0.5, 0.8, 0.25};
        for (const double ring : kRings)
            for (int k = 0; k < vision::kRadii; k += 10) {
                const glm::dvec2 p = vision::border_point(outline, k);
                if (is_taken(outline.centre + ring * (p - outline.centre)))
                    return false;
            }
        return !any_pixel(outline, [](std::uint8_t& cell) { return cell != 0; });
    }

    void take(const vision::Outline& outline) {
        any_pixel(outline, [](std::uint8_t& cell) {
            cell = 1;
            return false;
        });
    }

private:
    bool is_taken(glm::dvec2 p) const {
        const int x = static_cast<int>(std::floor(p.x)) + margin_;
        const int y = static_cast<int>(std::floor(p.y)) + margin_;
        return taken_.contains(x, y) && taken_(x, y) != 0;
    }

    template <class Visit>
    bool any_pixel(const vision::Outline& outline, Visit&& visit) const {
        const double reach = reach_of(outline);
        const auto low = [&](double c) { return static_cast<int>(std::floor(c - reach)); };
        const auto high = [&](double c) { return static_cast<int>(std::ceil(c + reach)); };
        for (int y = low(outline.centre.y); y <= high(outline.centre.y); ++y)
            for (int x = low(outline.centre.x); x <= high(outline.centre.x); ++x) {
                const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - outline.centre;
                if (!taken_.contains(x + margin_, y + margin_) ||
                    std::hypot(d.x, d.y) > vision::radius_at(outline, std::atan2(d.y, d.x)))
                    continue;
                if (visit(taken_(x + margin_, y + margin_)))
                    return true;
            }
        return false;
    }

    int margin_;
    mutable Mask taken_;
};

bool is_whole(const vision::Outline& outline, const SyntheticOptions& o) {
    for (int k = 0; k < vision::kRadii; ++k) {
        const glm::dvec2 p = vision::border_point(outline, k);
        if (p.x < 1 || p.y < 1 || p.x > o.width - 1 || p.y > o.height - 1)
            return false;
    }
    return true;
}

struct Placed {
    vision::Outline outline;
    std::size_t shape = 0;
    double radius = 0.0;
};

std::vector<Placed> throw_darts(const SyntheticOptions& o, const std::vector<Radii>& shapes,
                                const std::vector<double>& diameters) {
    Ground ground(o);
    std::vector<Placed> placed;
    for (std::size_t rock = 0; rock < diameters.size(); ++rock) {
        Rng rng({.seed = o.seed, .stream = kPlaceStream, .cell = rock});
        const double radius = 0.5 * diameters[rock];
        for (int dart = 0; dart < kDartsPerRock; ++dart) {
            const glm::dvec2 centre{rng.uniform(0.0, o.width), rng.uniform(0.0, o.height)};
            const auto outline = scaled(centre, shapes[rock], radius, 0.0);
            if ((o.whole_rocks && !is_whole(outline, o)) || !ground.is_free(outline))
                continue;
            ground.take(scaled(centre, shapes[rock], radius, o.gap));
            placed.push_back({outline, rock, radius});
            break;
        }
    }
    return placed;
}

// A rock may grow while it touches no neighbour; one map of owners would not do, since its own
// pixels must not stop it, so the others are painted per rock inside its reach.
bool collides(const std::vector<Placed>& rocks, std::size_t self, const vision::Outline& grown,
              double gap) {
    const double reach = reach_of(grown);
    for (std::size_t i = 0; i < rocks.size(); ++i) {
        if (i == self)
            continue;
        const vision::Outline& other = rocks[i].outline;
        const glm::dvec2 between = other.centre - grown.centre;
        const double distance = std::hypot(between.x, between.y);
        if (distance > reach + reach_of(other) + gap)
            continue;
        for (int k = 0; k < vision::kRadii; k += 2) {
            const glm::dvec2 a = vision::border_point(grown, k) - other.centre;
            const glm::dvec2 b = vision::border_point(other, k) - grown.centre;
            if (std::hypot(a.x, a.y) < vision::radius_at(other, std::atan2(a.y, a.x)) + gap ||
                std::hypot(b.x, b.y) < vision::radius_at(grown, std::atan2(b.y, b.x)) + gap)
                return true;
        }
    }
    return false;
}

void grow_rocks(const SyntheticOptions& o, const std::vector<Radii>& shapes,
                std::vector<Placed>& rocks) {
    for (std::size_t i = 0; i < rocks.size(); ++i)
        for (int step = 1; step <= kGrowthSteps; ++step) {
            const double factor = 1.0 + o.growth * step / kGrowthSteps;
            const auto grown = scaled(rocks[i].outline.centre, shapes[rocks[i].shape],
                                      factor * rocks[i].radius, 0.0);
            if ((o.whole_rocks && !is_whole(grown, o)) || collides(rocks, i, grown, o.gap))
                break;
            rocks[i].outline = grown;
        }
}

// Centres of a honeycomb as wide as the median diameter, shaken.
std::vector<glm::dvec2> honeycomb(const SyntheticOptions& o) {
    const double step = o.median_diameter + o.gap;
    const double row_step = step * std::sqrt(0.75);
    std::vector<glm::dvec2> centres;
    for (int j = -1; j * row_step < o.height + row_step; ++j)
        for (int i = -1; i * step < o.width + step; ++i) {
            const auto cell = static_cast<std::uint64_t>((j + 1) * 100000 + i + 1);
            Rng rng({.seed = o.seed, .stream = kPlaceStream, .cell = cell});
            const glm::dvec2 shake{rng.uniform(-0.18, 0.18), rng.uniform(-0.18, 0.18)};
            centres.push_back(glm::dvec2((i + 0.5 * (j & 1)) * step, j * row_step) + shake * step);
        }
    return centres;
}

// The cell of a centre, drawn back by half the gap. A power mean of the distances to its sides is
// never above the least of them and rounds the corners.
vision::Outline cell_outline(const std::vector<glm::dvec2>& centres, std::size_t self,
                             const SyntheticOptions& o) {
    constexpr double kPower = 10.0;
    vision::Outline outline;
    outline.centre = centres[self];
    outline.confidence = 1.0F;
    for (std::size_t k = 0; k < outline.radii.size(); ++k) {
        const double azimuth = std::numbers::pi / 180.0 * static_cast<double>(k);
        double sum = 0.0;
        for (std::size_t j = 0; j < centres.size(); ++j) {
            const glm::dvec2 way = centres[j] - centres[self];
            const double distance = std::hypot(way.x, way.y);
            if (j == self || distance > 2.5 * (o.median_diameter + o.gap))
                continue;
            const double along = (way.x * std::cos(azimuth) + way.y * std::sin(azimuth)) / distance;
            const double side = 0.5 * (distance - o.gap) / std::max(1e-3, along);
            sum += along > 0.0 ? std::pow(side, -kPower) : 0.0;
        }
        outline.radii[k] = static_cast<float>(std::pow(sum, -1.0 / kPower));
    }
    return outline;
}

std::vector<Placed> fill_cells(const SyntheticOptions& o) {
    const auto centres = honeycomb(o);
    std::vector<Placed> placed;
    for (std::size_t i = 0; i < centres.size(); ++i) {
        const glm::dvec2 c = centres[i];
        if (c.x < 0.0 || c.y < 0.0 || c.x > o.width || c.y > o.height)
            continue;
        const auto outline = cell_outline(centres, i, o);
        if (static_cast<int>(placed.size()) < o.n_rocks && (!o.whole_rocks || is_whole(outline, o)))
            placed.push_back({outline, 0, 0.0});
    }
    return placed;
}

std::vector<Placed> lay_by_darts(const SyntheticOptions& o) {
    const std::vector<double> diameters = draw_diameters(o);
    std::vector<Radii> shapes;
    for (std::size_t rock = 0; rock < diameters.size(); ++rock)
        shapes.push_back(lobed_shape(o, rock));
    std::vector<Placed> rocks = throw_darts(o, shapes, diameters);
    grow_rocks(o, shapes, rocks);
    return rocks;
}

void check_diameters(const SyntheticOptions& o) {
    if (o.least_diameter > o.median_diameter || o.median_diameter > o.greatest_diameter)
        fail<InvalidOption>("median-diameter is ", o.median_diameter, ", must be in [",
                            o.least_diameter, ", ", o.greatest_diameter,
                            "], between the least and the greatest");
}

}  // namespace

SyntheticPhoto make_synthetic_photo(const SyntheticOptions& options) {
    check(options);
    check_diameters(options);

    std::vector<Placed> rocks =
        options.layout == Layout::Cells ? fill_cells(options) : lay_by_darts(options);
    SyntheticPhoto result;
    for (Placed& rock : rocks) {
        rock.outline.touches_border = !is_whole(rock.outline, options);
        result.outlines.push_back(rock.outline);
    }
    result.labels = vision::paint_labels(result.outlines, options.width, options.height);
    result.photo = shade_rocks(result.outlines, result.labels, options);
    return result;
}

}  // namespace scree::test
