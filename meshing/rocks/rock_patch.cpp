#include "meshing/rocks/rock_patch.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "meshing/rocks/silhouette.h"
#include "meshing/rocks/stone_torus.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

namespace scree::meshing {
namespace {

constexpr std::size_t kMostStones = 1'000'000;
constexpr double kMostInstances = 1e7;
constexpr double kFirstDensity = 0.6;  // of discs on ground of free size, before it grows
constexpr double kGrowth = 1.01;
constexpr double kLeastSide = 4.001;  // of the ground, in radii of the largest stone
constexpr std::uint64_t kLastRound = 1U << 20;

enum Stream : std::uint64_t { kYaw = 0x9a7c01, kDart, kRetry, kDraw };

// A stone to be placed.
struct Wanted {
    std::uint32_t prototype;  // index into RockPatch::prototypes
    double scale;
    double yaw;
    Silhouette shape;
};

RandomKey key(const PatchOptions& options, Stream stream, std::uint64_t step, std::size_t cell) {
    return {.seed = static_cast<std::uint64_t>(options.seed),
            .stream = stream,
            .step = step,
            .cell = cell};
}

std::vector<Silhouette> silhouettes_of(const std::vector<RockMesh>& rocks,
                                       const std::vector<std::size_t>& prototypes) {
    std::vector<Silhouette> shapes(prototypes.size());
    parallel_for_each_index(0, prototypes.size(), 8, [&](std::size_t i) {
        shapes[i] = silhouette_of(rocks[prototypes[i]].mesh);
    });
    return shapes;
}

// Turn and scale the stones, largest first.
void prepare(std::vector<Wanted>& stones, const std::vector<Silhouette>& shapes,
             const PatchOptions& options) {
    parallel_for_each_index(0, stones.size(), 64, [&](std::size_t i) {
        Wanted& stone = stones[i];
        Rng rng(key(options, kYaw, 0, i));
        stone.yaw = options.turn ? rng.uniform(0.0, 2.0 * std::numbers::pi) : 0.0;
        stone.shape = placed(shapes[stone.prototype], stone.scale, stone.yaw);
    });
    std::stable_sort(stones.begin(), stones.end(), [](const Wanted& a, const Wanted& b) {
        return a.shape.radius > b.shape.radius;
    });
}

bool has_size(const PatchOptions& options) {
    return options.width > 0.0 || options.depth > 0.0;
}

// The ground asked for; none if the stones decide.
glm::dvec2 wanted_size(const PatchOptions& options) {
    return {options.width > 0.0 ? options.width : options.depth,
            options.depth > 0.0 ? options.depth : options.width};
}

// Ground for dart throwing: what was asked for, or what leaves the discs room to be thrown.
glm::dvec2 first_size(const std::vector<Wanted>& stones, const PatchOptions& options) {
    if (has_size(options))
        return wanted_size(options);
    double discs = 0.0;
    for (const Wanted& stone : stones)
        discs += std::numbers::pi * static_cast<double>(stone.shape.radius * stone.shape.radius);
    const double least = kLeastSide * static_cast<double>(stones.front().shape.radius);
    const double side = std::max(std::sqrt(discs / kFirstDensity), least);
    return {side, side};
}

double coverage_of(const StoneTorus& torus) {
    return torus.covered_area() / (torus.size().x * torus.size().y);
}

glm::dvec2 anywhere(const StoneTorus& torus, Rng& rng) {
    const double x = rng.uniform();
    const double z = rng.uniform();
    return torus.size() * glm::dvec2(x, z);
}

// Poisson-disk dart throwing, the largest first; the ground grows where a stone finds no room.
StoneTorus throw_darts(const std::vector<Wanted>& stones, const PatchOptions& options) {
    const double middle = static_cast<double>(stones[stones.size() / 2].shape.radius);
    StoneTorus torus(first_size(stones, options), 2.0 * middle);
    for (std::uint32_t i = 0; i < stones.size(); ++i) {
        Rng rng(key(options, kDart, 0, i));
        for (int attempt = 1; !torus.add_by_disc({stones[i].shape, anywhere(torus, rng), i});
             ++attempt)
            if (attempt % options.tries == 0)
                torus.grow(kGrowth);
    }
    return torus;
}

// A place for a stone near one that it had, else anywhere.
bool put_near(StoneTorus& torus, StoneTorus::Stone stone, int tries, Rng& rng) {
    if (torus.add_by_silhouette(stone))
        return true;
    const glm::dvec2 home = stone.position;
    const double radius = static_cast<double>(stone.shape.radius);
    for (int attempt = 0; attempt < 2 * tries; ++attempt) {
        const bool near = attempt < tries;
        const double distance = 2.0 * radius * (attempt + 1) / tries;
        const double azimuth = rng.uniform(0.0, 2.0 * std::numbers::pi);
        stone.position = near ? home + distance * glm::dvec2(std::cos(azimuth), std::sin(azimuth))
                              : anywhere(torus, rng);
        if (torus.add_by_silhouette(stone))
            return true;
    }
    return false;
}

// The same stones on less ground, each as near to its old place as there is room.
StoneTorus squeezed(const StoneTorus& torus, glm::dvec2 size, const PatchOptions& options,
                    std::uint64_t round, bool all_or_none) {
    StoneTorus tight(size, torus.cell_size());
    for (std::size_t i = 0; i < torus.n_stones(); ++i) {
        StoneTorus::Stone stone = torus.stone(i);
        stone.position *= size / torus.size();
        Rng rng(key(options, kRetry, round, stone.label));
        if (!put_near(tight, stone, options.tries, rng) && all_or_none)
            break;
    }
    return tight;
}

// Move the stones together, until there is no more room, the ground is as small as asked for, or
// the sweeps are used up.
void close_gaps(StoneTorus& torus, const PatchOptions& options, double least_side) {
    const std::size_t n_stones = torus.n_stones();
    double shrink = 0.9;
    for (int sweep = 0; sweep < options.sweeps; ++sweep) {
        move_into_voids(torus, options.step);
        const glm::dvec2 least = has_size(options) ? wanted_size(options) : glm::dvec2(least_side);
        const glm::dvec2 size = glm::max(torus.size() * shrink, least);
        if (size == torus.size())
            continue;
        StoneTorus tight = squeezed(torus, size, options, static_cast<std::uint64_t>(sweep), true);
        if (tight.n_stones() == n_stones)
            torus = std::move(tight);
        else
            shrink = std::sqrt(shrink);
    }
}

StoneTorus place(const std::vector<Wanted>& stones, const PatchOptions& options,
                 PatchReport& report) {
    StoneTorus torus = throw_darts(stones, options);
    report.coverage_by_darts = coverage_of(torus);
    close_gaps(torus, options, kLeastSide * static_cast<double>(stones.front().shape.radius));
    if (has_size(options) && torus.size() != wanted_size(options))
        torus = squeezed(torus, wanted_size(options), options, kLastRound, false);
    report.left_out = stones.size() - torus.n_stones();
    report.coverage = coverage_of(torus);
    return torus;
}

RockPatch patch_of(const std::vector<RockMesh>& rocks, std::vector<std::size_t> prototypes,
                   std::vector<Wanted> stones, const PatchOptions& options) {
    RockPatch patch;
    patch.prototypes = std::move(prototypes);
    if (stones.empty())
        return patch;
    prepare(stones, silhouettes_of(rocks, patch.prototypes), options);
    const StoneTorus torus = place(stones, options, patch.report);
    patch.size = torus.size();
    patch.instances.reserve(torus.n_stones());
    for (std::size_t i = 0; i < torus.n_stones(); ++i) {
        const StoneTorus::Stone placed = torus.stone(i);
        const Wanted& stone = stones[placed.label];
        const glm::dvec2 at = placed.position - 0.5 * patch.size;
        const double y = static_cast<double>(rocks[patch.prototypes[stone.prototype]].position.y);
        PatchInstance instance;
        instance.prototype = stone.prototype;
        instance.translation = glm::vec3(at.x, y * stone.scale, at.y);
        instance.rotation = glm::quat(static_cast<float>(std::cos(0.5 * stone.yaw)), 0.0F,
                                      static_cast<float>(std::sin(0.5 * stone.yaw)), 0.0F);
        instance.scale = glm::vec3(static_cast<float>(stone.scale));
        patch.instances.push_back(instance);
    }
    std::stable_sort(
        patch.instances.begin(), patch.instances.end(),
        [](const PatchInstance& a, const PatchInstance& b) { return a.prototype < b.prototype; });
    return patch;
}

double fullness(const RockMesh& rock) {
    return static_cast<double>(rock.inscribed_radius / rock.bounding_radius);
}

// One rock for each of n equal ranges of the ranks of size, so that prototypes stand for the whole
// distribution; in its range each is fuller than three in four, for slivers are often mistakes.
std::vector<std::size_t> pick_prototypes(const std::vector<RockMesh>& rocks, int count) {
    std::vector<std::size_t> order(rocks.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return rocks[a].bounding_radius > rocks[b].bounding_radius;
    });
    const std::size_t n = std::min(rocks.size(), static_cast<std::size_t>(count));
    std::vector<std::size_t> picked;
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t first = k * order.size() / n;
        const std::size_t last = (k + 1) * order.size() / n;
        std::vector<std::size_t> range(order.begin() + static_cast<std::ptrdiff_t>(first),
                                       order.begin() + static_cast<std::ptrdiff_t>(last));
        std::stable_sort(range.begin(), range.end(), [&](std::size_t a, std::size_t b) {
            return fullness(rocks[a]) < fullness(rocks[b]);
        });
        picked.push_back(range[range.size() * 3 / 4]);
    }
    return picked;  // ordered by falling size
}

// One of the three prototypes nearest in size; they are ordered by falling size.
std::uint32_t near_in_size(const std::vector<RockMesh>& rocks,
                           const std::vector<std::size_t>& prototypes, float radius, Rng& rng) {
    const auto found =
        std::lower_bound(prototypes.begin(), prototypes.end(), radius,
                         [&](std::size_t p, float r) { return rocks[p].bounding_radius > r; });
    const auto n = static_cast<std::int64_t>(prototypes.size());
    const auto wide = std::min<std::int64_t>(3, n);
    const auto first = std::clamp<std::int64_t>(found - prototypes.begin() - 1, 0, n - wide);
    return static_cast<std::uint32_t>(first) +
           static_cast<std::uint32_t>(rng.below(static_cast<std::uint64_t>(wide)));
}

}  // namespace

RockPatch repeat_rocks(const std::vector<RockMesh>& rocks, glm::dvec2 patch_size, int columns,
                       int rows) {
    const bool positive = patch_size.x > 0.0 && patch_size.y > 0.0 && columns > 0 && rows > 0;
    const double count = static_cast<double>(rocks.size()) * columns * rows;
    if (!positive || !(count <= kMostInstances))
        fail<InvalidOption>("a grid of ", columns, " x ", rows, " patches of ", patch_size.x, " x ",
                            patch_size.y, " m with ", rocks.size(),
                            " rocks: sizes and counts must be positive, at most ", kMostInstances,
                            " instances");
    RockPatch patch;
    patch.size = patch_size * glm::dvec2(columns, rows);
    patch.prototypes.resize(rocks.size());
    std::iota(patch.prototypes.begin(), patch.prototypes.end(), std::size_t{0});
    const auto copies = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    patch.instances.resize(rocks.size() * copies);
    parallel_for_each_index(0, rocks.size(), 16, [&](std::size_t i) {
        for (std::size_t copy = 0; copy < copies; ++copy) {
            const auto column = static_cast<double>(copy % static_cast<std::size_t>(columns));
            const auto row = static_cast<double>(copy / static_cast<std::size_t>(columns));
            const glm::dvec2 shift =
                (glm::dvec2(column, row) + 0.5) * patch_size - 0.5 * patch.size;
            PatchInstance& instance = patch.instances[i * copies + copy];
            instance.prototype = static_cast<std::uint32_t>(i);
            instance.translation =
                glm::vec3(glm::dvec3(rocks[i].position) + glm::dvec3(shift.x, 0.0, shift.y));
        }
    });
    return patch;
}

RockPatch rearrange_rocks(const std::vector<RockMesh>& rocks, int copies,
                          const PatchOptions& options) {
    check(options);
    if (copies < 1)
        fail<InvalidOption>("copies is ", copies, ", must be at least 1");
    if (rocks.size() > kMostStones / static_cast<std::size_t>(copies))
        fail<InvalidInput>("a patch holds ", kMostStones, " stones at most, ", rocks.size(),
                           " rocks were asked for ", copies, " times");
    std::vector<std::size_t> prototypes(rocks.size());
    std::iota(prototypes.begin(), prototypes.end(), std::size_t{0});
    std::vector<Wanted> stones;
    stones.reserve(rocks.size() * static_cast<std::size_t>(copies));
    for (int copy = 0; copy < copies; ++copy)
        for (std::uint32_t i = 0; i < rocks.size(); ++i)
            stones.push_back({i, 1.0, 0.0, {}});
    return patch_of(rocks, std::move(prototypes), std::move(stones), options);
}

RockPatch scatter_rocks(const std::vector<RockMesh>& rocks, int count,
                        const PatchOptions& options) {
    check(options);
    if (count < 1 || static_cast<std::size_t>(count) > kMostStones)
        fail<InvalidOption>("count is ", count, ", must be in [1, ", kMostStones, "]");
    if (rocks.empty())
        fail<InvalidInput>("there are no rocks to scatter");
    std::vector<std::size_t> prototypes = pick_prototypes(rocks, options.prototypes);
    std::vector<Wanted> stones;
    stones.reserve(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        Rng rng(key(options, kDraw, 0, i));
        const float radius = rocks[rng.below(rocks.size())].bounding_radius;
        const std::uint32_t prototype = near_in_size(rocks, prototypes, radius, rng);
        const double scale = static_cast<double>(radius) /
                             static_cast<double>(rocks[prototypes[prototype]].bounding_radius);
        stones.push_back({prototype, scale, 0.0, {}});
    }
    return patch_of(rocks, std::move(prototypes), std::move(stones), options);
}

}  // namespace scree::meshing
