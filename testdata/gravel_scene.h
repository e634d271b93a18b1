#pragma once

#include "base/options.h"
#include "base/raster.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace scree::test {

/// Which colours the rocks of a scene share.
enum class Palette { Grey, Brown, Limestone, Beach, Granite, Quartz, Slate };
inline constexpr std::string_view kPaletteNames[] = {"grey",    "brown",  "limestone", "beach",
                                                     "granite", "quartz", "slate"};
constexpr std::span<const std::string_view> names_of(Palette) {
    return kPaletteNames;
}

/// A heap of bodies under light. Lengths are pixels, strengths 0 (off) to 1 (strong).
struct SceneOptions {
    int width = 512;           ///< Of the picture.
    int height = 512;          ///< Of the picture.
    double coverage = 1.0;     ///< Area of all rocks laid, relative to the picture's.
    double least = 8;          ///< Diameter of the smallest rock that gets a label.
    double greatest = 120;     ///< Diameter of the largest rock.
    double size_exponent = 2;  ///< Number of rocks of diameter d goes as d to the minus this.
    double angularity = 0.4;   ///< Share of rocks cut by planes, and how sharp their edges are.
    double elongation = 1.4;   ///< Longest over shortest axis, mean of the scene.
    double flatness = 0.6;     ///< Thickness relative to the shorter axis.
    double roughness = 0.3;    ///< Waviness of borders and bumps of surfaces.
    double burial = 0.1;       ///< Share of a rock's thickness that lies under the ground.
    double pebbles = 0.2;      ///< Area of unlabelled clutter laid, relative to the picture's.
    Palette palette = Palette::Grey;
    double colour = 0.3;          ///< Spread of brightness and hue between rocks.
    double texture = 0.4;         ///< Blotches inside rocks.
    double speckle = 0.2;         ///< Mineral grains.
    double bedding = 0.2;         ///< Share of rocks with layers.
    double veins = 0.1;           ///< Share of rocks crossed by veins or cracks.
    double lichen = 0.1;          ///< Share of rocks with patches of another colour.
    double dust = 0.2;            ///< Sand on rocks, near the ground above all.
    double ground = 0.5;          ///< 0: dark deep gaps; 1: light sand.
    double same_colour = 0.0;     ///< How far the ground takes the mean colour of the rocks.
    double grain = 0.5;           ///< Roughness of the ground.
    double light_azimuth = 225;   ///< Degrees, from +x towards +y: where the light comes from.
    double light_elevation = 45;  ///< Degrees above the ground.
    double sun = 0.7;             ///< Share of direct light; the rest comes from the whole sky.
    double softness = 0.1;        ///< Width of penumbras.
    double foreign_shadow = 0.0;  ///< Darkness of shadows cast by what the picture does not show.
    double wetness = 0.0;         ///< Dark, saturated rocks with highlights.
    int n_things = 0;             ///< Cards, rulers, coins, shells, twigs, leaves: no rocks.
    double blur = 0.6;            ///< Standard deviation of the lens, px.
    double sharpening = 0.3;      ///< What the camera's software adds to edges.
    double noise = 0.01;          ///< Standard deviation of the sensor at full light.
    int jpeg_quality = 90;        ///< Of the blocks that compression leaves; 100 leaves none.
    double contrast = 1.0;        ///< About middle grey.
    double exposure = 1.0;        ///< Factor on what the camera meters.
    double warmth = 0.0;          ///< White balance, -1 blue to 1 yellow.
    std::uint64_t seed = 1;       ///< Same seed, same bytes.
};

template <class Visitor>
void describe(SceneOptions& o, Visitor&& field) {
    constexpr FieldInfo kShare{.min = 0, .max = 1};
    field("width", o.width, {.min = 16, .max = 4096, .unit = "px"});
    field("height", o.height, {.min = 16, .max = 4096, .unit = "px"});
    field("coverage", o.coverage, {.min = 0, .max = 3});
    field("least", o.least, {.min = 4, .max = 1000, .unit = "px"});
    field("greatest", o.greatest, {.min = 4, .max = 1000, .unit = "px"});
    field("size-exponent", o.size_exponent, {.min = 0, .max = 5});
    field("angularity", o.angularity, kShare);
    field("elongation", o.elongation, {.min = 1, .max = 4});
    field("flatness", o.flatness, {.min = 0.05, .max = 1.5});
    field("roughness", o.roughness, kShare);
    field("burial", o.burial, kShare);
    field("pebbles", o.pebbles, kShare);
    field("palette", o.palette, {});
    field("colour", o.colour, kShare);
    field("texture", o.texture, kShare);
    field("speckle", o.speckle, kShare);
    field("bedding", o.bedding, kShare);
    field("veins", o.veins, kShare);
    field("lichen", o.lichen, kShare);
    field("dust", o.dust, kShare);
    field("ground", o.ground, kShare);
    field("same-colour", o.same_colour, kShare);
    field("grain", o.grain, kShare);
    field("light-azimuth", o.light_azimuth, {.min = -360, .max = 360, .unit = "deg"});
    field("light-elevation", o.light_elevation, {.min = 5, .max = 90, .unit = "deg"});
    field("sun", o.sun, kShare);
    field("softness", o.softness, kShare);
    field("foreign-shadow", o.foreign_shadow, kShare);
    field("wetness", o.wetness, kShare);
    field("n-things", o.n_things, {.min = 0, .max = 50});
    field("blur", o.blur, {.min = 0, .max = 10, .unit = "px"});
    field("sharpening", o.sharpening, {.min = 0, .max = 3});
    field("noise", o.noise, {.min = 0, .max = 0.5});
    field("jpeg-quality", o.jpeg_quality, {.min = 5, .max = 100});
    field("contrast", o.contrast, {.min = 0.1, .max = 4});
    field("exposure", o.exposure, {.min = 0.1, .max = 4});
    field("warmth", o.warmth, {.min = -1, .max = 1});
}

/// A photograph of a heap, seen from straight above, with the truth about every pixel.
struct GravelScene {
    Photo photo;
    LabelMap labels;     ///< Rocks as far as they are seen; everything else is 0.
    Mask ignore;         ///< 255 where clutter lies that a person would not have labelled.
    FloatRaster height;  ///< Of the surface above the mean ground, px.
};

/// Let rocks fall into the hollows of a heap, the large ones first, and photograph it.
///
/// The upper rock covers the lower one; clutter on a rock counts as the rock. What shows less than
/// a fifth of itself, or fewer than 20
/// pixels, gets no label and is put into `ignore`.
/// @throw InvalidOption  a value is outside its range, or least is greater than greatest.
GravelScene make_gravel_scene(const SceneOptions& options = {});

/// Options of a scene drawn at random: sun or overcast, wet or dry, heaped or buried, of one
/// colour or many, with and without things that are no rocks.
SceneOptions varied_scene(std::uint64_t seed, int width, int height);

}  // namespace scree::test
