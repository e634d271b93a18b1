#include "testdata/gravel_scene.h"

#include "base/error.h"
#include "base/random.h"
#include "testdata/scene_layout.h"
#include "testdata/scene_light.h"

#include <algorithm>
#include <cmath>

namespace scree::test {
namespace {

constexpr std::uint64_t kVarietyStream = 38;

FloatRaster seen_height(const Heap& heap, const SceneOptions& o) {
    FloatRaster height(o.width, o.height);
    for (int y = 0; y < o.height; ++y)
        for (int x = 0; x < o.width; ++x) {
            float sum = 0.0F;
            for (int j = 0; j < kOversampling; ++j)
                for (int i = 0; i < kOversampling; ++i)
                    sum += heap.height(kMargin + kOversampling * x + i,
                                       kMargin + kOversampling * y + j);
            height(x, y) = sum / (kOversampling * kOversampling * kOversampling);
        }
    return height;
}

void vary_sizes(SceneOptions& o, Rng& rng) {
    const double smallest_picture = std::min(o.width, o.height);
    o.least = 6.0 * std::exp(rng.uniform(0.0, 1.3));
    const double most = std::min(300.0, 0.6 * smallest_picture);
    o.greatest =
        std::clamp(o.least * std::exp(rng.uniform(0.5, 3.4)), o.least, std::max(o.least, most));
    o.size_exponent = rng.uniform(1.0, 2.8);
    o.angularity = rng.uniform() < 0.4 ? rng.uniform(0.6, 1.0) : rng.uniform(0.0, 0.5);
    o.elongation = rng.uniform(1.1, 2.0);
    o.flatness = rng.uniform(0.3, 1.0);
    o.roughness = rng.uniform(0.05, 0.8);
    // A heap, rocks in sand, or rocks that a matrix holds.
    const double kind = rng.uniform();
    o.coverage = kind < 0.5 ? rng.uniform(1.0, 1.9) : rng.uniform(0.25, 1.0);
    o.burial = kind < 0.5 ? rng.uniform(0.0, 0.3) : rng.uniform(0.1, 0.9);
    o.pebbles = rng.uniform() < 0.7 ? rng.uniform(0.0, 0.7) : 0.0;
}

void vary_surfaces(SceneOptions& o, Rng& rng) {
    o.palette = static_cast<Palette>(rng.below(std::size(kPaletteNames)));
    const double kind = rng.uniform();
    o.colour = kind < 0.3 ? rng.uniform(0.02, 0.1) : rng.uniform(0.12, 0.5);
    o.ground = rng.uniform() < 0.4 ? rng.uniform(0.0, 0.2) : rng.uniform(0.3, 1.0);
    o.same_colour = rng.uniform() < 0.35 ? rng.uniform(0.6, 1.0) : 0.0;
    o.texture = rng.uniform(0.05, 0.9);
    o.speckle = rng.uniform() < 0.5 ? rng.uniform(0.0, 0.9) : 0.05;
    o.bedding = rng.uniform() < 0.5 ? rng.uniform(0.0, 0.6) : 0.0;
    o.veins = rng.uniform(0.0, 0.35);
    o.lichen = rng.uniform() < 0.5 ? rng.uniform(0.0, 0.6) : 0.0;
    o.dust = rng.uniform() < 0.6 ? rng.uniform(0.0, 0.8) : 0.0;
    o.grain = rng.uniform(0.1, 1.0);
    o.wetness = rng.uniform() < 0.3 ? rng.uniform(0.3, 1.0) : 0.0;
    o.n_things = rng.uniform() < 0.45 ? 1 + static_cast<int>(rng.below(4)) : 0;
}

void vary_light(SceneOptions& o, Rng& rng) {
    o.light_azimuth = rng.uniform(0.0, 360.0);
    o.light_elevation = rng.uniform(18.0, 80.0);
    o.sun = rng.uniform() < 0.35 ? rng.uniform(0.0, 0.3) : rng.uniform(0.4, 0.95);
    o.softness = rng.uniform() < 0.5 ? rng.uniform(0.0, 0.08) : rng.uniform(0.1, 0.6);
    o.foreign_shadow = rng.uniform() < 0.25 ? rng.uniform(0.3, 0.95) : 0.0;
    o.blur = rng.uniform() < 0.8 ? rng.uniform(0.25, 0.9) : rng.uniform(0.9, 1.8);
    o.blur = std::min(o.blur, 0.08 * o.least);  // what cannot be told apart teaches nothing
    o.sharpening = rng.uniform(0.0, 1.0);
    o.noise = rng.uniform(0.0, 0.04);
    o.jpeg_quality = static_cast<int>(rng.uniform(45.0, 100.0));
    o.contrast = rng.uniform(0.8, 1.35);
    o.exposure = std::exp(rng.uniform(-0.4, 0.5));
    o.warmth = rng.uniform(-0.7, 0.7);
}

}  // namespace

GravelScene make_gravel_scene(const SceneOptions& options) {
    check(options);
    if (options.least > options.greatest)
        fail<InvalidOption>("least is ", options.least, " px, must not be above greatest, ",
                            options.greatest, " px");
    const Heap heap = lay_heap(options);
    Visible visible = label_heap(heap, options);
    return {develop(light_heap(heap, options), options), std::move(visible.labels),
            std::move(visible.ignore), seen_height(heap, options)};
}

SceneOptions varied_scene(std::uint64_t seed, int width, int height) {
    SceneOptions options;
    options.width = width;
    options.height = height;
    options.seed = seed;
    Rng rng({.seed = seed, .stream = kVarietyStream});
    vary_sizes(options, rng);
    vary_surfaces(options, rng);
    vary_light(options, rng);
    return options;
}

}  // namespace scree::test
