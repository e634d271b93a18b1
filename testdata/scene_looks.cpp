#include "base/random.h"
#include "testdata/scene_bodies.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace scree::test {
namespace {

constexpr std::uint64_t kLookStream = 32;
constexpr std::uint64_t kGroundStream = 33;

// Reflectances, linear; a rock takes one of them and varies it.
std::vector<glm::dvec3> colours_of(Palette palette) {
    switch (palette) {
        case Palette::Brown:
            return {{0.30, 0.22, 0.14}, {0.24, 0.19, 0.14}, {0.36, 0.29, 0.21}};
        case Palette::Limestone:
            return {{0.52, 0.50, 0.45}, {0.45, 0.43, 0.39}, {0.58, 0.55, 0.48}};
        case Palette::Beach:
            return {{0.10, 0.12, 0.15}, {0.34, 0.25, 0.15}, {0.26, 0.13, 0.11}, {0.16, 0.19, 0.15},
                    {0.45, 0.44, 0.42}, {0.20, 0.22, 0.26}, {0.42, 0.30, 0.14}};
        case Palette::Granite:
            return {{0.42, 0.25, 0.19}, {0.52, 0.46, 0.41}, {0.30, 0.20, 0.17}};
        case Palette::Quartz:
            return {{0.62, 0.57, 0.42}, {0.60, 0.40, 0.16}, {0.45, 0.26, 0.10}, {0.7, 0.68, 0.6}};
        case Palette::Slate:
            return {{0.12, 0.13, 0.15}, {0.17, 0.18, 0.19}, {0.10, 0.11, 0.11}};
        case Palette::Grey:
            break;
    }
    return {{0.28, 0.28, 0.27}, {0.22, 0.22, 0.23}, {0.36, 0.35, 0.33}};
}

glm::dvec3 mean_colour(const SceneOptions& o) {
    const auto colours = colours_of(o.palette);
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& colour : colours)
        sum += colour;
    return sum / static_cast<double>(colours.size());
}

glm::dvec3 varied(const glm::dvec3& colour, double spread, Rng& rng) {
    const double grey = std::exp(spread * rng.normal());
    const double warm = 0.25 * spread * rng.normal();
    return glm::clamp(colour * grey * glm::dvec3(1.0 + warm, 1.0, 1.0 - warm), 0.015, 0.9);
}

}  // namespace

glm::dvec3 ground_albedo(const SceneOptions& o) {
    Rng rng({.seed = o.seed, .stream = kGroundStream});
    const glm::dvec3 sand = varied({0.42, 0.36, 0.27}, 0.25, rng);
    const glm::dvec3 dark{0.035, 0.03, 0.025};
    const glm::dvec3 own = dark + o.ground * (sand - dark);
    const glm::dvec3 alike = mean_colour(o) * rng.uniform(0.8, 1.15) * (1.0 - 0.4 * o.wetness);
    return own + o.same_colour * (alike - own);
}

Look draw_look(const SceneOptions& o, std::uint64_t index) {
    Rng rng({.seed = o.seed, .stream = kLookStream, .cell = index});
    const auto colours = colours_of(o.palette);
    // One colour for all where the scene has none to spread: the hard case.
    const std::size_t which = o.colour < 0.12 ? 0 : rng.below(colours.size());
    Look look;
    look.albedo = varied(colours[which], o.colour, rng);
    const bool pale = rng.uniform() < 0.5;
    look.second = pale ? glm::mix(look.albedo, glm::dvec3(0.75, 0.73, 0.68), rng.uniform(0.3, 0.9))
                       : look.albedo * rng.uniform(0.25, 0.7);
    look.layers = rng.uniform() < o.bedding ? rng.uniform(0.1, 0.7) : 0.0;
    look.layer_width = 0.06 * std::exp(rng.uniform(0.0, 2.3));
    look.vein = rng.uniform() < o.veins ? rng.uniform(0.4, 1.0) : 0.0;
    look.patches = rng.uniform() < o.lichen ? rng.uniform(0.4, 1.0) : 0.0;
    look.specks = o.speckle * std::min(1.0, 0.5 * std::exp(0.6 * rng.normal()));
    look.speck_width = rng.uniform(1.8, 6.0);
    look.gloss = o.wetness * rng.uniform(0.4, 1.2);
    const double wet = o.wetness * rng.uniform(0.6, 1.0);
    const double grey = (look.albedo.x + look.albedo.y + look.albedo.z) / 3.0;
    look.albedo = glm::clamp((look.albedo + 0.35 * wet * (look.albedo - grey)) * (1.0 - 0.5 * wet),
                             0.01, 0.9);
    return look;
}

}  // namespace scree::test
