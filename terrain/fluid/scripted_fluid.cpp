#include "terrain/fluid/scripted_fluid.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "terrain/fluid/triangle_grid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

constexpr std::uint64_t kScatterStream = 0x73636174ULL;
constexpr double kMostParticles = 5e6;
constexpr double kContact = 1.25;  // contact distance, in radii
constexpr double kGolden = 0.6180339887498949;

// A path with the way from its head to each corner.
struct MeasuredPath {
    explicit MeasuredPath(const std::vector<glm::vec3>& path) : corners(path) {
        for (std::size_t i = 1; i < path.size(); ++i)
            ways.push_back(ways.back() + static_cast<double>(glm::distance(path[i - 1], path[i])));
    }
    double length() const { return ways.back(); }

    std::vector<glm::vec3> corners;
    std::vector<double> ways = {0.0};
};

struct PlaceOnPath {
    glm::vec3 point;
    glm::vec3 direction;
};

PlaceOnPath place_at(const MeasuredPath& path, double way) {
    const auto past = std::upper_bound(path.ways.begin(), path.ways.end(), way);
    const auto last = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
        past - path.ways.begin(), 1, static_cast<std::ptrdiff_t>(path.ways.size()) - 1));
    const double span = path.ways[last] - path.ways[last - 1];
    const auto share = static_cast<float>(span > 0.0 ? (way - path.ways[last - 1]) / span : 0.0);
    const glm::vec3 leg = path.corners[last] - path.corners[last - 1];
    const float length = glm::length(leg);
    return {path.corners[last - 1] + leg * share,
            length > 0.0F ? leg / length : glm::vec3(1, 0, 0)};
}

void check_stream(const ScriptedStream& s, std::size_t index) {
    const auto refuse = [&](const char* what) { fail<InvalidInput>("stream ", index, " ", what); };
    if (s.path.size() < 2)
        refuse("has a path of fewer than two places");
    for (const glm::vec3& p : s.path)
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) ||
            glm::length(p) > 1e6F)
            refuse("has a path with a number that is not finite or beyond a million metres");
    if (!(s.speed > 0.0 && s.speed <= 1000.0))
        refuse("has a speed that is not above 0 and at most 1000 m/s");
    if (!(s.half_width >= 0.0 && s.half_height >= 0.0 && s.half_width <= 1e6 &&
          s.half_height <= 1e6))
        refuse("has a half width or half height that is negative or beyond a million metres");
    if (!(s.per_metre > 0.0 && s.per_metre <= kMostParticles))
        refuse("has a number of particles a metre that is not above 0 and at most five million");
    if (!(MeasuredPath(s.path).length() > 0.0))
        refuse("has a path without length");
}

}  // namespace

struct ScriptedFluid::Script {
    struct Lane {
        ScriptedStream stream;
        MeasuredPath path;
        double capacity = 0.0;  // particles on the whole path
    };

    // Particle k of a stream starts at the head when k - capacity have passed, so the path is full
    // from the start.
    std::pair<double, double> particles_at(const Lane& lane, double seconds) const {
        const double passed = seconds * lane.stream.speed * lane.stream.per_metre;
        return {std::ceil(passed), std::floor(passed + lane.capacity)};
    }

    glm::vec3 place_of(const Lane& lane, std::size_t index, double k, double seconds,
                       glm::vec3& velocity) const {
        const double way =
            seconds * lane.stream.speed + lane.path.length() - k / lane.stream.per_metre;
        const PlaceOnPath at = place_at(lane.path, way);
        glm::vec3 side = glm::cross(at.direction, glm::vec3(0, 1, 0));
        const float length = glm::length(side);
        side = length > 1e-6F ? side / length : glm::vec3(0, 0, 1);
        const glm::vec3 up = glm::cross(side, at.direction);
        Rng rng({static_cast<std::uint64_t>(options.seed), kScatterStream + index,
                 static_cast<std::uint64_t>(k), 0});
        const double across = std::fmod(k * kGolden, 1.0);  // even over any stretch of the stream
        velocity = at.direction * static_cast<float>(lane.stream.speed);
        return at.point + side * static_cast<float>((2.0 * across - 1.0) * lane.stream.half_width) +
               up * static_cast<float>(rng.uniform(-1.0, 1.0) * lane.stream.half_height);
    }

    // All particles of the present time, each stream's in turn; ids interleave the streams.
    void place(double seconds) {
        FluidState next;
        next.radius = state.radius;
        next.contact_distance = state.contact_distance;
        next.seconds = seconds;
        next.tally = state.tally;
        struct Entry {
            std::uint64_t id;
            glm::vec3 position, velocity;
        };
        std::vector<Entry> entries;
        std::uint64_t born = 0;
        for (std::size_t l = 0; l < lanes.size(); ++l) {
            const auto [first, last] = particles_at(lanes[l], seconds);
            born += static_cast<std::uint64_t>(last) + 1;
            for (double k = first; k <= last; ++k) {
                const std::uint64_t id = static_cast<std::uint64_t>(k) * lanes.size() + l;
                if (std::binary_search(taken.begin(), taken.end(), id))
                    continue;
                glm::vec3 velocity;
                const glm::vec3 position = place_of(lanes[l], l, k, seconds, velocity);
                entries.push_back({id, position, velocity});
            }
        }
        std::sort(entries.begin(), entries.end(),
                  [](const Entry& a, const Entry& b) { return a.id < b.id; });
        for (const Entry& e : entries) {
            next.positions.push_back(e.position);
            next.velocities.push_back(e.velocity);
            next.ids.push_back(e.id);
            next.next_id = e.id + 1;
        }
        next.next_id = std::max(next.next_id, state.next_id);
        next.contacts.resize(next.size());
        next.tally.emitted = born;
        next.tally.left_domain = born - next.size() - taken.size();
        state = std::move(next);
    }

    void touch() {
        const auto reach = static_cast<float>(state.contact_distance);
        parallel_for_each_index(0, state.size(), 256, [&](std::size_t i) {
            const SurfaceHit hit = mesh.nearest(state.positions[i], reach);
            state.contacts[i] = {hit.triangle, hit.distance};
        });
    }

    std::vector<Lane> lanes;
    ScriptedFluidOptions options;
    std::vector<std::uint64_t> taken;  // ids that restore() found missing, sorted
    FluidState state;
    TriangleGrid mesh;
};

ScriptedFluid::ScriptedFluid(std::vector<ScriptedStream> streams,
                             const ScriptedFluidOptions& options)
    : script_(std::make_unique<Script>()) {
    check(options);
    if (streams.empty())
        fail<InvalidInput>("a scripted fluid has no stream; give it at least one");
    script_->options = options;
    script_->state.radius = options.radius;
    script_->state.contact_distance = kContact * options.radius;
    double all = 0.0;
    for (std::size_t i = 0; i < streams.size(); ++i) {
        check_stream(streams[i], i);
        MeasuredPath path(streams[i].path);
        const double capacity = path.length() * streams[i].per_metre;
        all += capacity;
        script_->lanes.push_back({std::move(streams[i]), std::move(path), capacity});
    }
    if (all > kMostParticles)
        fail<InvalidInput>("the streams hold ", all, " particles, at most ", kMostParticles,
                           " are allowed; lower their number a metre");
    script_->place(0.0);
}

ScriptedFluid::~ScriptedFluid() = default;

void ScriptedFluid::set_mesh(const meshing::TriMesh& mesh) {
    script_->mesh = TriangleGrid(mesh, static_cast<float>(2.0 * script_->options.radius));
    script_->touch();
}

int ScriptedFluid::step(double seconds) {
    if (!(seconds > 0.0) || !std::isfinite(seconds))
        fail<InvalidInput>("a frame of a fluid takes ", seconds, " s; it must be positive");
    const double end = script_->state.seconds + seconds;
    for (const auto& lane : script_->lanes)
        if (end * lane.stream.speed * lane.stream.per_metre > 1e12)
            fail<InvalidInput>("a scripted fluid cannot run to ", end, " s; take shorter frames");
    script_->place(end);
    script_->touch();
    return 1;
}

const FluidState& ScriptedFluid::state() const {
    return script_->state;
}

void ScriptedFluid::restore(const FluidState& state) {
    check_fluid_state(state);
    script_->taken.clear();
    script_->place(state.seconds);
    const FluidState& full = script_->state;
    if (!std::includes(full.ids.begin(), full.ids.end(), state.ids.begin(), state.ids.end()))
        fail<InvalidInput>("a scripted fluid takes no particles that its streams do not have");
    std::set_difference(full.ids.begin(), full.ids.end(), state.ids.begin(), state.ids.end(),
                        std::back_inserter(script_->taken));
    script_->state.tally = state.tally;
    script_->place(state.seconds);
    script_->touch();
}

}  // namespace scree::terrain
