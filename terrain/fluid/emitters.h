#pragma once

#include "terrain/fluid/fluid.h"

#include <cstdint>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace scree::terrain {

/// A round opening from which water flows.
struct FluidSource {
    glm::vec3 centre{0.0F};       ///< Metres.
    glm::vec3 velocity{1, 0, 0};  ///< Metres a second; across the opening. Must not be zero.
    double radius = 0.2;          ///< Of the opening, metres.
    double start = 0.0;           ///< Seconds.
    double end = 1e30;            ///< Seconds.
};

/// Drops that fall from a level rectangle.
struct FluidRain {
    glm::vec3 centre{0.0F};        ///< Metres.
    double width = 1.0;            ///< Along x, metres.
    double depth = 1.0;            ///< Along z, metres.
    double rate = 100.0;           ///< Drops a second.
    glm::vec3 velocity{0, -2, 0};  ///< Metres a second.
    double start = 0.0;            ///< Seconds.
    double end = 1e30;             ///< Seconds.
};

/// A box; what it means is said where it is used.
struct FluidBox {
    glm::vec3 low{0.0F};
    glm::vec3 high{0.0F};

    bool holds(const glm::vec3& p) const {
        return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y &&
               p.z <= high.z;
    }
};

/// Where particles come from and go.
struct FluidEmitters {
    std::vector<FluidSource> sources;
    std::vector<FluidRain> rains;
    std::vector<FluidBox> pools;  ///< Filled once, at the start.
    std::vector<FluidBox> sinks;  ///< Take every particle inside.
};

/// Throw InvalidInput, naming the emitter, unless all numbers are finite, lengths and rates
/// positive, boxes not empty, and a source can be told apart from a still one.
void check_emitters(const FluidEmitters& emitters);

/// Particles that came into being.
struct NewParticles {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> velocities;
};

/// What the emitters give between two times; a pure function of them, the seed and the times.
/// Neighbouring particles are `spacing` apart.
/// @throw InvalidInput  more than `most` particles: the rate is too high.
NewParticles emitted_between(const FluidEmitters& emitters, double from, double to, double spacing,
                             std::uint64_t seed, std::size_t most);

/// Places of an opening where particles come out.
std::vector<glm::vec3> opening_places(const FluidSource& source, double spacing);

}  // namespace scree::terrain
