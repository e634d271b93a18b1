#pragma once

#include "testdata/gravel_scene.h"

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace scree::test {

inline constexpr int kOversampling = 2;  ///< Canvas pixels to a picture's pixel.
inline constexpr int kMargin = 48;       ///< Canvas pixels around the picture: for light and falls.

enum class BodyKind : std::uint8_t { Rock, Pebble, Thing };
enum class ThingKind : std::uint8_t { Ruler, Card, Coin, Shell, Twig, Leaf };
inline constexpr int kThingKinds = 6;

/// What the surface of a body looks like.
struct Look {
    glm::dvec3 albedo{0.3};
    glm::dvec3 second{0.3};  ///< Of layers, veins and patches.
    double layers = 0.0;     ///< Strength of bedding.
    double layer_width = 6.0;
    double vein = 0.0;
    double patches = 0.0;
    double specks = 0.0;
    double speck_width = 3.0;  ///< Canvas pixels.
    double gloss = 0.0;
};

/// A body on the canvas; local coordinates are relative to its half axes, in [-1, 1].
struct Body {
    BodyKind kind = BodyKind::Rock;
    ThingKind thing = ThingKind::Card;
    glm::dvec2 centre{0.0};   ///< Canvas pixels.
    glm::dvec2 axes{1.0};     ///< Half axes, canvas pixels.
    double azimuth = 0.0;     ///< Of the first axis, radians.
    double thickness = 1.0;   ///< Height of the top above the widest section, canvas pixels.
    double level = 0.0;       ///< Height of the widest section.
    double fullness = 2.0;    ///< Exponent of the dome: 2 round, 4 flat-topped.
    double squareness = 2.0;  ///< Exponent of the outline: 2 an ellipse.
    double bevel = 0.1;       ///< Rounding of edges between planes.
    double waviness = 0.1;
    double bumps = 0.02;
    std::vector<glm::dvec4> planes;  ///< x, y, z, d: kept where x u + y v + z w <= d.
    Look look;
    std::uint64_t seed = 0;
};

/// Local coordinates of a canvas point.
glm::dvec2 to_local(const Body& body, glm::dvec2 p);

/// Height of the upper side over a local point relative to the thickness; negative outside.
double relative_height(const Body& body, glm::dvec2 local);

/// A rock of the scene's style and a given diameter (canvas pixels); `index` names it.
Body make_rock(const SceneOptions& options, double diameter, std::uint64_t index);

/// A thing that is no rock; `index` names it.
Body make_thing(const SceneOptions& options, std::uint64_t index);

/// Colour of a thing at a local point, linear.
glm::dvec3 thing_albedo(const Body& body, glm::dvec2 local);

/// Height of a thing over a local point relative to its thickness; negative outside.
double thing_height(const Body& body, glm::dvec2 local);

/// Mean colour of the palette's rocks and of the ground between them, linear.
glm::dvec3 ground_albedo(const SceneOptions& options);

/// Colour, layers, veins and patches of one rock.
Look draw_look(const SceneOptions& options, std::uint64_t index);

}  // namespace scree::test
