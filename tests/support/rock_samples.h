#pragma once

#include "base/random.h"
#include "vision/rock_data.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace scree::test {

/// An outline from a function of azimuth (radians).
template <class Radius>
vision::Outline outline_of(glm::dvec2 centre, Radius&& radius) {
    vision::Outline outline;
    outline.centre = centre;
    outline.confidence = 1.0F;
    for (std::size_t k = 0; k < vision::kRadii; ++k)
        outline.radii[k] =
            static_cast<float>(radius(static_cast<double>(k) * std::numbers::pi / 180.0));
    return outline;
}

/// A rock whose depth is its least radius, as the source takes it.
inline vision::Rock rock_of(const vision::Outline& outline) {
    vision::Rock rock;
    rock.outline = outline;
    rock.depth = *std::min_element(outline.radii.begin(), outline.radii.end());
    return rock;
}

/// Five gentle lobes of random strength and phase: 0.75 to 1.25 times `size`, smooth.
inline vision::Rock lobed_rock(glm::dvec2 centre, double size, std::uint64_t seed) {
    Rng rng({.seed = seed, .stream = 0x10be});
    double strength[5] = {};
    double phase[5] = {};
    for (int m = 0; m < 5; ++m) {
        strength[m] = rng.uniform(0.0, 0.1) / (m + 1);
        phase[m] = rng.uniform(0.0, 2.0 * std::numbers::pi);
    }
    return rock_of(outline_of(centre, [&](double azimuth) {
        double r = 1.0;
        for (int m = 0; m < 5; ++m)
            r += strength[m] * std::cos((m + 2) * azimuth + phase[m]);
        return size * r;
    }));
}

/// Every radius drawn on its own between `least` and `most`: as rough as an outline can be.
inline vision::Rock jagged_rock(glm::dvec2 centre, double least, double most, std::uint64_t seed) {
    Rng rng({.seed = seed, .stream = 0x7a66ed});
    return rock_of(outline_of(centre, [&](double) { return rng.uniform(least, most); }));
}

/// A picture with n rocks of many sizes, lobed ones, scattered without regard to each other.
inline vision::RockSet rock_set(int n, std::uint64_t seed, int width = 900, int height = 600) {
    vision::RockSet set;
    set.image = "synthetic";
    set.width = width;
    set.height = height;
    set.method = "synthetic";
    Rng rng({.seed = seed, .stream = 0x5e7});
    for (int i = 0; i < n; ++i) {
        const double size = 4.0 * std::pow(20.0, rng.uniform() * rng.uniform());
        set.rocks.push_back(lobed_rock({rng.uniform(0.0, width), rng.uniform(0.0, height)}, size,
                                       seed * 1000003U + static_cast<std::uint64_t>(i)));
    }
    return set;
}

}  // namespace scree::test
