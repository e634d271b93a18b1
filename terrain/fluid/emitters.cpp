#include "terrain/fluid/emitters.h"

#include "base/error.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

constexpr std::uint64_t kRainStream = 0x7261696eULL;
constexpr std::uint64_t kJitterStream = 0x6a697474ULL;
constexpr double kJitter = 0.02;  // of a spacing: breaks the lattice, which would stack otherwise

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

template <class... Parts>
void require(bool good, const char* kind, std::size_t index, const Parts&... parts) {
    if (!good)
        fail<InvalidInput>(kind, " ", index, " ", parts...);
}

void check_times(const char* kind, std::size_t index, double start, double end) {
    require(start >= 0.0 && end > start && std::isfinite(start), kind, index, "runs from ", start,
            " s to ", end, " s; it must start at 0 or later and end after that");
}

void check_box(const char* kind, std::size_t index, const FluidBox& box) {
    require(is_finite(box.low) && is_finite(box.high) && box.low.x < box.high.x &&
                box.low.y < box.high.y && box.low.z < box.high.z,
            kind, index, "has no inside; every number of `low` must be below that of `high`");
}

// Two unit vectors across a direction.
void axes_across(const glm::dvec3& direction, glm::dvec3& u, glm::dvec3& v) {
    const glm::dvec3 helper =
        std::abs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    u = glm::normalize(glm::cross(helper, direction));
    v = glm::cross(direction, u);
}

std::vector<glm::dvec3> opening_lattice(const FluidSource& source, double spacing) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(source.velocity));
    glm::dvec3 u, v;
    axes_across(direction, u, v);
    std::vector<glm::dvec3> spots;
    const double half = std::floor(source.radius / spacing);
    for (double j = -half; j <= half; ++j)
        for (double i = -half; i <= half; ++i) {
            const glm::dvec3 offset = (u * i + v * j) * spacing;
            if (glm::length(offset) <= source.radius)
                spots.push_back(glm::dvec3(source.centre) + offset);
        }
    return spots;
}

struct Emission {
    double from, to, spacing;
    std::uint64_t seed;
    std::size_t most;
};

void limit(const Emission& e, double n, const NewParticles& made) {
    if (!(n + static_cast<double>(made.positions.size()) <= static_cast<double>(e.most)))
        fail<InvalidInput>("the emitters give more than ", e.most, " particles in ", e.to - e.from,
                           " s; lower their rates, take larger particles or shorter steps");
}

// A layer of the opening's lattice each time the water has gone on by one spacing.
void emit_source(const FluidSource& source, std::size_t index, const Emission& e,
                 NewParticles& made) {
    const double speed = static_cast<double>(glm::length(source.velocity));
    const double interval = e.spacing / speed;
    const double begin = std::max(e.from, source.start);
    const double stop = std::min(e.to, source.end);
    if (!(begin < stop))
        return;
    const double first = std::ceil((begin - source.start) / interval);
    const double last = std::ceil((stop - source.start) / interval);
    const double across = std::floor(source.radius / e.spacing) + 1.0;
    limit(e, (last - first) * 4.0 * across * across, made);
    const std::vector<glm::dvec3> spots = opening_lattice(source, e.spacing);
    for (double layer = first; layer < last; ++layer) {
        const double age = e.to - (source.start + layer * interval);
        Rng rng({e.seed, kJitterStream + index, static_cast<std::uint64_t>(layer), 0});
        for (const glm::dvec3& spot : spots) {
            const double shake = kJitter * e.spacing;
            const glm::dvec3 jitter(rng.uniform(-shake, shake), rng.uniform(-shake, shake),
                                    rng.uniform(-shake, shake));
            made.positions.emplace_back(spot + jitter + glm::dvec3(source.velocity) * age);
            made.velocities.push_back(source.velocity);
        }
    }
}

void emit_rain(const FluidRain& rain, std::size_t index, const Emission& e, NewParticles& made) {
    const double begin = std::max(e.from, rain.start);
    const double stop = std::min(e.to, rain.end);
    if (!(begin < stop))
        return;
    const double first = std::ceil((begin - rain.start) * rain.rate);
    const double last = std::ceil((stop - rain.start) * rain.rate);
    limit(e, last - first, made);
    for (double drop = first; drop < last; ++drop) {
        Rng rng({e.seed, kRainStream + index, static_cast<std::uint64_t>(drop), 0});
        const double x = rng.uniform(-0.5, 0.5) * rain.width;
        const double z = rng.uniform(-0.5, 0.5) * rain.depth;
        const double age = e.to - (rain.start + drop / rain.rate);
        made.positions.emplace_back(glm::dvec3(rain.centre) + glm::dvec3(x, 0.0, z) +
                                    glm::dvec3(rain.velocity) * age);
        made.velocities.push_back(rain.velocity);
    }
}

void fill_pool(const FluidBox& box, std::size_t index, const Emission& e, NewParticles& made) {
    // The little more takes a box of exactly n spacings for one, however its floats are rounded.
    const glm::dvec3 n =
        glm::max(glm::floor((glm::dvec3(box.high) - glm::dvec3(box.low)) / e.spacing + 1e-4),
                 glm::dvec3(1.0));
    limit(e, n.x * n.y * n.z, made);
    Rng rng({e.seed, kJitterStream, ~std::uint64_t{0}, index});
    const double shake = kJitter * e.spacing;
    for (double y = 0; y < n.y; ++y)
        for (double z = 0; z < n.z; ++z)
            for (double x = 0; x < n.x; ++x) {
                const glm::dvec3 jitter(rng.uniform(-shake, shake), rng.uniform(-shake, shake),
                                        rng.uniform(-shake, shake));
                made.positions.emplace_back(glm::dvec3(box.low) +
                                            (glm::dvec3(x, y, z) + 0.5) * e.spacing + jitter);
                made.velocities.emplace_back(0.0F);
            }
}

}  // namespace

void check_emitters(const FluidEmitters& emitters) {
    for (std::size_t i = 0; i < emitters.sources.size(); ++i) {
        const FluidSource& s = emitters.sources[i];
        require(is_finite(s.centre) && is_finite(s.velocity), "source", i,
                "has a number that is not finite");
        require(s.radius > 0.0 && s.radius < 1e6, "source", i, "has radius ", s.radius,
                " m; it must be positive");
        const float speed = glm::length(s.velocity);
        require(speed >= 1e-3F && speed <= 1e3F, "source", i, "flows at ", speed,
                " m/s; take 0.001 to 1000");
        check_times("source", i, s.start, s.end);
    }
    for (std::size_t i = 0; i < emitters.rains.size(); ++i) {
        const FluidRain& r = emitters.rains[i];
        require(is_finite(r.centre) && is_finite(r.velocity), "rain", i,
                "has a number that is not finite");
        require(r.width > 0.0 && r.depth > 0.0 && r.width < 1e6 && r.depth < 1e6, "rain", i,
                "covers ", r.width, " x ", r.depth, " m; both must be positive");
        require(r.rate > 0.0 && r.rate <= 1e7, "rain", i, "has a rate of ", r.rate,
                " drops a second; take more than 0, at most 1e7");
        require(glm::length(r.velocity) <= 1e3F, "rain", i, "falls at ", glm::length(r.velocity),
                " m/s; take at most 1000");
        check_times("rain", i, r.start, r.end);
    }
    for (std::size_t i = 0; i < emitters.pools.size(); ++i)
        check_box("pool", i, emitters.pools[i]);
    for (std::size_t i = 0; i < emitters.sinks.size(); ++i)
        check_box("sink", i, emitters.sinks[i]);
}

NewParticles emitted_between(const FluidEmitters& emitters, double from, double to, double spacing,
                             std::uint64_t seed, std::size_t most) {
    NewParticles made;
    const Emission e{from, to, spacing, seed, most};
    if (from == 0.0)
        for (std::size_t i = 0; i < emitters.pools.size(); ++i)
            fill_pool(emitters.pools[i], i, e, made);
    for (std::size_t i = 0; i < emitters.sources.size(); ++i)
        emit_source(emitters.sources[i], i, e, made);
    for (std::size_t i = 0; i < emitters.rains.size(); ++i)
        emit_rain(emitters.rains[i], i, e, made);
    return made;
}

std::vector<glm::vec3> opening_places(const FluidSource& source, double spacing) {
    std::vector<glm::vec3> places;
    for (const glm::dvec3& spot : opening_lattice(source, spacing))
        places.emplace_back(spot);
    return places;
}

}  // namespace scree::terrain
