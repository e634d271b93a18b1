#include "meshing/space/self_intersection.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/simd.h"
#include "meshing/space/vertex_star.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

constexpr std::size_t kStarGrain = 1024;
constexpr std::size_t kLeafGrain = 64;

// Coordinates as 16-bit steps over the mesh's box.
class Grid {
public:
    static constexpr std::int16_t kBeyond = 16383;  // further out than any step

    explicit Grid(const TriMesh& mesh) {
        glm::vec3 low(std::numeric_limits<float>::max());
        glm::vec3 high = -low;
        for (const glm::vec3& p : mesh.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        const glm::dvec3 size = glm::dvec3(high) - glm::dvec3(low);
        const double reach = std::max({size.x, size.y, size.z});
        origin_ = glm::dvec3(low);
        scale_ = reach > 0.0 ? 2.0 * kReach / reach : 0.0;
    }

    std::int16_t below(const glm::vec3& p, int axis) const {
        return static_cast<std::int16_t>(std::floor(at(p, axis) - kSlack));
    }
    std::int16_t above(const glm::vec3& p, int axis) const {
        return static_cast<std::int16_t>(std::ceil(at(p, axis) + kSlack));
    }

private:
    static constexpr double kReach = 16000.0;  // differences fit 16 bits
    static constexpr double kSlack = 1e-6;     // far above rounding

    double at(const glm::vec3& p, int axis) const {
        return (static_cast<double>(p[axis]) - origin_[axis]) * scale_ - kReach;
    }

    glm::dvec3 origin_{0.0};
    double scale_ = 0.0;
};

// Eight numbers in one register, as gcc and clang have them on every processor.
using Steps = std::int16_t __attribute__((vector_size(16)));
using Names = std::uint32_t __attribute__((vector_size(32)));
using Bytes = std::int8_t __attribute__((vector_size(8)));

// Bit k is set where lane k of a comparison holds.
template <class Lanes>
inline unsigned bits_of(const Lanes& holds) {
    const Bytes bytes = __builtin_convertvector(holds, Bytes);
    std::uint64_t word = 0;
    std::memcpy(&word, &bytes, sizeof word);
    return static_cast<unsigned>(((word & 0x8040201008040201ULL) * 0x0101010101010101ULL) >> 56);
}

// A triangle's plane in double, to rule pairs out quickly.
class Plane {
public:
    Plane(const TriMesh& mesh, const glm::uvec3& t) : origin_(mesh.positions[t.x]) {
        const glm::dvec3 u = glm::dvec3(mesh.positions[t.y]) - origin_;
        const glm::dvec3 v = glm::dvec3(mesh.positions[t.z]) - origin_;
        normal_ = glm::cross(u, v);
        const double reach = std::max(reach_of(u), reach_of(v));
        // Rounding of a distance stays under 64 half ulps of reach^2 times the other vector.
        margin_ = 1e-13 * reach * reach;
    }

    // The other triangle lies on one side, beyond all rounding.
    bool clears(const TriMesh& mesh, const glm::uvec3& t) const {
        const int first = side(glm::dvec3(mesh.positions[t.x]));
        return first != 0 && side(glm::dvec3(mesh.positions[t.y])) == first &&
               side(glm::dvec3(mesh.positions[t.z])) == first;
    }

private:
    static double reach_of(const glm::dvec3& v) {
        return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    }
    int side(const glm::dvec3& p) const {
        const glm::dvec3 d = p - origin_;
        const double distance = glm::dot(normal_, d);
        const double margin = margin_ * reach_of(d);
        return distance > margin ? 1 : distance < -margin ? -1 : 0;
    }

    glm::dvec3 origin_;
    glm::dvec3 normal_;
    double margin_;
};

}  // namespace

void SelfIntersectionFinder::order_triangles(const TriMesh& mesh) {
    const std::size_t n = mesh.triangles.size();
    order_.resize(n);
    std::iota(order_.begin(), order_.end(), 0U);
    std::vector<glm::vec3> centres(n);
    parallel_for_each_index(0, n, 4096, [&](std::size_t i) {
        const glm::uvec3& t = mesh.triangles[i];
        centres[i] =
            mesh.positions[t.x] / 3.0F + mesh.positions[t.y] / 3.0F + mesh.positions[t.z] / 3.0F;
    });
    // Halves at a whole number of leaves, along the longest side of the centres' box.
    const std::function<void(std::size_t, std::size_t)> split = [&](std::size_t first,
                                                                    std::size_t last) {
        const std::size_t n_leaves = (last - first + kLeafSize - 1) / kLeafSize;
        if (n_leaves < 2)
            return;
        glm::vec3 low(std::numeric_limits<float>::max());
        glm::vec3 high = -low;
        for (std::size_t i = first; i < last; ++i) {
            low = glm::min(low, centres[order_[i]]);
            high = glm::max(high, centres[order_[i]]);
        }
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = first + n_leaves / 2 * kLeafSize;
        std::nth_element(order_.begin() + static_cast<std::ptrdiff_t>(first),
                         order_.begin() + static_cast<std::ptrdiff_t>(middle),
                         order_.begin() + static_cast<std::ptrdiff_t>(last),
                         [&](std::uint32_t a, std::uint32_t b) {
                             return centres[a][axis] < centres[b][axis] ||
                                    (centres[a][axis] == centres[b][axis] && a < b);
                         });
        if (last - first > 8192) {
            parallel_invoke([&] { split(first, middle); }, [&] { split(middle, last); });
        } else {
            split(first, middle);
            split(middle, last);
        }
    };
    split(0, n);
}

// Where each leaf stands among the nodes.
void SelfIntersectionFinder::place_leaves(std::size_t node, std::size_t first, std::size_t last) {
    if (last - first == 1) {
        node_of_leaf_[first] = static_cast<std::uint32_t>(node);
        return;
    }
    const std::size_t middle = first + (last - first) / 2;
    place_leaves(node + 1, first, middle);
    place_leaves(node + 2 * (middle - first), middle, last);
}

void SelfIntersectionFinder::measure_leaves(const TriMesh& mesh) {
    const std::size_t n = order_.size();
    const std::size_t n_leaves = (n + kLeafSize - 1) / kLeafSize;
    if (leaves_.size() != n_leaves || node_of_leaf_.size() != n_leaves) {
        leaves_.resize(n_leaves);
        node_of_leaf_.resize(n_leaves);
        nodes_.resize(2 * n_leaves - 1);
        place_leaves(0, 0, n_leaves);
    }
    const Grid grid(mesh);
    parallel_for_each_index(0, n_leaves, 256, [&](std::size_t leaf) {
        Leaf& out = leaves_[leaf];
        Box whole{glm::vec3(std::numeric_limits<float>::max()),
                  glm::vec3(std::numeric_limits<float>::lowest())};
        for (std::size_t k = 0; k < kLeafSize; ++k) {
            if (leaf * kLeafSize + k >= n) {  // an empty place meets nothing
                out.low_x[k] = out.low_y[k] = out.low_z[k] = Grid::kBeyond;
                out.high_x[k] = out.high_y[k] = out.high_z[k] = -Grid::kBeyond;
                out.a[k] = out.b[k] = out.c[k] = kNoFace;
                continue;
            }
            const glm::uvec3& t = mesh.triangles[order_[leaf * kLeafSize + k]];
            const glm::vec3& a = mesh.positions[t.x];
            const glm::vec3& b = mesh.positions[t.y];
            const glm::vec3& c = mesh.positions[t.z];
            const glm::vec3 low = glm::min(a, glm::min(b, c));
            const glm::vec3 high = glm::max(a, glm::max(b, c));
            whole = {glm::min(whole.low, low), glm::max(whole.high, high)};
            out.low_x[k] = grid.below(low, 0);
            out.low_y[k] = grid.below(low, 1);
            out.low_z[k] = grid.below(low, 2);
            out.high_x[k] = grid.above(high, 0);
            out.high_y[k] = grid.above(high, 1);
            out.high_z[k] = grid.above(high, 2);
            out.a[k] = t.x;
            out.b[k] = t.y;
            out.c[k] = t.z;
        }
        nodes_[node_of_leaf_[leaf]] = whole;
    });
    join_boxes(0, 0, n_leaves);
}

void SelfIntersectionFinder::join_boxes(std::size_t node, std::size_t first, std::size_t last) {
    if (last - first == 1)
        return;
    const std::size_t middle = first + (last - first) / 2;
    const std::size_t left = node + 1;
    const std::size_t right = node + 2 * (middle - first);
    if (last - first > 1024) {
        parallel_invoke([&] { join_boxes(left, first, middle); },
                        [&] { join_boxes(right, middle, last); });
    } else {
        join_boxes(left, first, middle);
        join_boxes(right, middle, last);
    }
    nodes_[node].low = glm::min(nodes_[left].low, nodes_[right].low);
    nodes_[node].high = glm::max(nodes_[left].high, nodes_[right].high);
}

// Bit k: triangle k of the other leaf shares no vertex with this one and its box overlaps.
inline unsigned SelfIntersectionFinder::candidates(const Leaf& leaf, std::size_t i,
                                                   const Leaf& other) {
    Steps low_x, low_y, low_z, high_x, high_y, high_z;
    std::memcpy(&low_x, other.low_x, sizeof low_x);
    std::memcpy(&low_y, other.low_y, sizeof low_y);
    std::memcpy(&low_z, other.low_z, sizeof low_z);
    std::memcpy(&high_x, other.high_x, sizeof high_x);
    std::memcpy(&high_y, other.high_y, sizeof high_y);
    std::memcpy(&high_z, other.high_z, sizeof high_z);
    const Steps apart = (high_x < leaf.low_x[i]) | (low_x > leaf.high_x[i]) |
                        (high_y < leaf.low_y[i]) | (low_y > leaf.high_y[i]) |
                        (high_z < leaf.low_z[i]) | (low_z > leaf.high_z[i]);
    const unsigned overlap = ~bits_of(apart) & 0xFFU;
    if (overlap == 0)
        return 0;
    Names a, b, c;
    std::memcpy(&a, other.a, sizeof a);
    std::memcpy(&b, other.b, sizeof b);
    std::memcpy(&c, other.c, sizeof c);
    const auto shared = (a == leaf.a[i]) | (a == leaf.b[i]) | (a == leaf.c[i]) | (b == leaf.a[i]) |
                        (b == leaf.b[i]) | (b == leaf.c[i]) | (c == leaf.a[i]) | (c == leaf.b[i]) |
                        (c == leaf.c[i]);
    return overlap & ~bits_of(shared);
}

SCREE_MULTIVERSION
void SelfIntersectionFinder::search_pair(const TriMesh& mesh, std::size_t leaf, std::size_t other,
                                         Found& found) const {
    const std::size_t n = order_.size();
    for (std::size_t i = 0; i < kLeafSize && leaf * kLeafSize + i < n; ++i) {
        unsigned bits = candidates(leaves_[leaf], i, leaves_[other]);
        if (leaf == other)
            bits &= 0xFEU << i;  // each pair once
        if (bits == 0)
            continue;
        const std::uint32_t a = order_[leaf * kLeafSize + i];
        const glm::uvec3& first = mesh.triangles[a];
        const Plane plane(mesh, first);
        for (; bits != 0; bits &= bits - 1) {
            const std::uint32_t b =
                order_[other * kLeafSize + static_cast<std::size_t>(std::countr_zero(bits))];
            const glm::uvec3& second = mesh.triangles[b];
            if (plane.clears(mesh, second))
                continue;
            if (triangles_meet(points_of(mesh, first), points_of(mesh, second)))
                found.push_back({std::min(a, b), std::max(a, b)});
        }
    }
}

// All leaves from this one on whose boxes overlap its own.
void SelfIntersectionFinder::search_from(const TriMesh& mesh, std::size_t leaf,
                                         Found& found) const {
    struct Place {
        std::size_t node, first, last;
    };
    std::array<Place, 128> open;  // halving keeps one place a level
    std::size_t n_open = 1;
    open[0] = {0, 0, leaves_.size()};
    const Box own = nodes_[node_of_leaf_[leaf]];
    while (n_open > 0) {
        const Place at = open[--n_open];
        const Box& box = nodes_[at.node];
        if (at.last <= leaf || box.low.x > own.high.x || own.low.x > box.high.x ||
            box.low.y > own.high.y || own.low.y > box.high.y || box.low.z > own.high.z ||
            own.low.z > box.high.z)
            continue;
        if (at.last - at.first == 1) {
            search_pair(mesh, leaf, at.first, found);
            continue;
        }
        const std::size_t middle = at.first + (at.last - at.first) / 2;
        open[n_open++] = {at.node + 2 * (middle - at.first), middle, at.last};
        open[n_open++] = {at.node + 1, at.first, middle};
    }
}

SelfIntersections SelfIntersectionFinder::find(const TriMesh& mesh, const Adjacency& adjacency,
                                               std::size_t limit) {
    const std::size_t n = mesh.triangles.size();
    if (adjacency.n_vertices() != mesh.positions.size() || adjacency.corners.size() != 3 * n)
        fail<InvalidInput>("the mesh has ", mesh.positions.size(), " vertices and ", n,
                           " triangles, its adjacency ", adjacency.n_vertices(), " and ",
                           adjacency.corners.size() / 3);
    SelfIntersections result;
    if (n == 0)
        return result;
    if (order_.size() != n)
        order_triangles(mesh);
    measure_leaves(mesh);

    const std::size_t n_vertices = mesh.positions.size();
    const std::size_t n_stars = (n_vertices + kStarGrain - 1) / kStarGrain;
    const std::size_t n_pieces = n_stars + (leaves_.size() + kLeafGrain - 1) / kLeafGrain;
    std::vector<Found> pieces(n_pieces);
    std::atomic<bool> all_looked_at{true};
    parallel_for_each_index(0, n_pieces, 1, [&](std::size_t i) {
        Found& found = pieces[i];
        if (i < n_stars) {
            const std::size_t last = std::min(n_vertices, (i + 1) * kStarGrain);
            for (std::size_t v = i * kStarGrain; v < last && found.size() < limit; ++v)
                if (!star_is_flat(mesh, adjacency, v) &&
                    !test_star(mesh, adjacency, v, limit, found))
                    all_looked_at = false;
            return;
        }
        const std::size_t first = (i - n_stars) * kLeafGrain;
        const std::size_t last = std::min(leaves_.size(), first + kLeafGrain);
        for (std::size_t leaf = first; leaf < last && found.size() < limit; ++leaf)
            search_from(mesh, leaf, found);
    });
    result.complete = all_looked_at;
    for (const Found& found : pieces) {
        result.complete = result.complete && found.size() < limit;
        result.pairs.insert(result.pairs.end(), found.begin(), found.end());
    }
    std::sort(result.pairs.begin(), result.pairs.end());
    result.pairs.erase(std::unique(result.pairs.begin(), result.pairs.end()), result.pairs.end());
    return result;
}

void SelfIntersectionFinder::compact(const std::vector<std::uint32_t>& kept) {
    constexpr std::uint32_t kGone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> place(order_.size(), kGone);
    for (std::uint32_t i = 0; i < kept.size(); ++i)
        if (kept[i] < place.size())
            place[kept[i]] = i;
    std::size_t n = 0;
    for (const std::uint32_t t : order_)
        if (place[t] != kGone)
            order_[n++] = place[t];
    order_.resize(n);
}

SelfIntersections find_self_intersections(const TriMesh& mesh, const Adjacency& adjacency,
                                          std::size_t limit) {
    return SelfIntersectionFinder().find(mesh, adjacency, limit);
}

}  // namespace scree::meshing
