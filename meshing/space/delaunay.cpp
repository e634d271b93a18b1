#include "meshing/space/delaunay.h"

#include "base/error.h"
#include "base/random.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace scree::meshing {
namespace {

__extension__ using Wide = __int128;

constexpr double kGrid = 4194304.0;        // 2^22 cells along the longer side of the box
constexpr std::int64_t kFar = 1LL << 28U;  // corners around all: determinants stay below 2^123
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kStream = 0x64656c61756eULL;
constexpr std::size_t kMostPoints = std::size_t{1} << 28U;

struct Place {
    std::int64_t x;
    std::int64_t y;
    bool operator==(const Place&) const = default;
};

// Twice the area of a, b, c; positive where they run counter-clockwise.
std::int64_t turn(const Place& a, const Place& b, const Place& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Whether d lies inside the circle of the counter-clockwise a, b, c.
bool in_circle(const Place& a, const Place& b, const Place& c, const Place& d) {
    const Wide ax = a.x - d.x, ay = a.y - d.y;
    const Wide bx = b.x - d.x, by = b.y - d.y;
    const Wide cx = c.x - d.x, cy = c.y - d.y;
    return (ax * ax + ay * ay) * (bx * cy - by * cx) - (bx * bx + by * by) * (ax * cy - ay * cx) +
               (cx * cx + cy * cy) * (ax * by - ay * bx) >
           0;
}

// Place along Hilbert's curve through the grid: neighbours on it are neighbours in the plane.
std::uint64_t hilbert(Place p) {
    auto x = static_cast<std::uint64_t>(p.x);
    auto y = static_cast<std::uint64_t>(p.y);
    std::uint64_t along = 0;
    for (std::uint64_t s = 1ULL << 22U; s > 0; s >>= 1U) {
        const std::uint64_t rx = (x & s) != 0 ? 1 : 0;
        const std::uint64_t ry = (y & s) != 0 ? 1 : 0;
        along += s * s * ((3 * rx) ^ ry);
        x &= s - 1;
        y &= s - 1;
        if (ry == 0) {
            if (rx == 1) {
                x = s - 1 - x;
                y = s - 1 - y;
            }
            std::swap(x, y);
        }
    }
    return along;
}

struct Triangle {
    std::array<std::uint32_t, 3> at;      // places, counter-clockwise
    std::array<std::uint32_t, 3> beyond;  // triangle across the side that faces corner k
};

constexpr std::size_t next(std::size_t k) {
    return k == 2 ? 0 : k + 1;
}
constexpr std::size_t before(std::size_t k) {
    return k == 0 ? 2 : k - 1;
}

class Builder {
public:
    explicit Builder(std::vector<Place>& places) : places_(places) {
        const auto n = static_cast<std::uint32_t>(places_.size());
        places_.insert(places_.end(), {{-kFar, -kFar}, {kFar, -kFar}, {0, kFar}});
        triangles_.reserve(2 * places_.size());
        triangles_.push_back({{n, n + 1, n + 2}, {kNone, kNone, kNone}});
    }

    // False if a point lies there already.
    bool insert(std::uint32_t p) {
        const std::uint32_t t = find(places_[p]);
        const Triangle& here = triangles_[t];
        std::size_t on_side = 3;
        for (std::size_t k = 0; k < 3; ++k) {
            if (places_[here.at[k]] == places_[p])
                return false;
            if (turn(side_start(t, k), side_end(t, k), places_[p]) == 0)
                on_side = k;
        }
        if (on_side == 3)
            split_inside(t, p);
        else
            split_side(t, on_side, p);
        restore();
        return true;
    }

    std::vector<glm::uvec3> result(std::uint32_t n_points) const {
        std::vector<glm::uvec3> out;
        for (const Triangle& t : triangles_)
            if (std::max({t.at[0], t.at[1], t.at[2]}) < n_points)
                out.emplace_back(t.at[0], t.at[1], t.at[2]);
        return out;
    }

private:
    const Place& side_start(std::uint32_t t, std::size_t k) const {
        return places_[triangles_[t].at[next(k)]];
    }
    const Place& side_end(std::uint32_t t, std::size_t k) const {
        return places_[triangles_[t].at[before(k)]];
    }

    // Walk from the last triangle across sides that have the place beyond them. In a Delaunay
    // triangulation this ends (Edelsbrunner 1990).
    std::uint32_t find(const Place& p) {
        for (std::size_t k = 0; k < 3;) {
            if (turn(side_start(last_, k), side_end(last_, k), p) < 0) {
                last_ = triangles_[last_].beyond[k];
                k = 0;
            } else {
                ++k;
            }
        }
        return last_;
    }

    void point_back(std::uint32_t neighbour, std::uint32_t was, std::uint32_t is) {
        if (neighbour == kNone)
            return;
        for (std::uint32_t& t : triangles_[neighbour].beyond)
            if (t == was) {
                t = is;
                return;
            }
    }

    void split_inside(std::uint32_t t, std::uint32_t p) {
        const Triangle old = triangles_[t];
        const auto u = static_cast<std::uint32_t>(triangles_.size());
        const std::uint32_t v = u + 1;
        triangles_[t] = {{p, old.at[1], old.at[2]}, {old.beyond[0], u, v}};
        triangles_.push_back({{p, old.at[2], old.at[0]}, {old.beyond[1], v, t}});
        triangles_.push_back({{p, old.at[0], old.at[1]}, {old.beyond[2], t, u}});
        point_back(old.beyond[1], t, u);
        point_back(old.beyond[2], t, v);
        doubtful_.insert(doubtful_.end(), {t, u, v});
    }

    // Both triangles at a side become two. The side is never on the far corners' own triangle.
    void split_side(std::uint32_t t, std::size_t k, std::uint32_t p) {
        const Triangle mine = triangles_[t];
        const std::uint32_t s = mine.beyond[k];
        const Triangle theirs = triangles_[s];
        const std::size_t j = corner_facing(s, t);
        const std::uint32_t a = mine.at[next(k)], b = mine.at[before(k)];
        const auto u = static_cast<std::uint32_t>(triangles_.size());
        const std::uint32_t w = u + 1;
        // Around p: t (b, apex), u (apex, a), s (a, their apex), w (their apex, b).
        const std::uint32_t apex = mine.at[k], other = theirs.at[j];
        const std::uint32_t past_b = mine.beyond[next(k)], past_a = mine.beyond[before(k)];
        const std::uint32_t past_a2 = theirs.beyond[next(j)], past_b2 = theirs.beyond[before(j)];
        triangles_[t] = {{p, b, apex}, {past_b, u, w}};
        triangles_.push_back({{p, apex, a}, {past_a, s, t}});
        triangles_[s] = {{p, a, other}, {past_a2, w, u}};
        triangles_.push_back({{p, other, b}, {past_b2, t, s}});
        point_back(past_a, t, u);
        point_back(past_b2, s, w);
        doubtful_.insert(doubtful_.end(), {t, u, s, w});
    }

    std::size_t corner_facing(std::uint32_t t, std::uint32_t neighbour) const {
        const auto& beyond = triangles_[t].beyond;
        return beyond[0] == neighbour ? 0 : beyond[1] == neighbour ? 1 : 2;
    }

    // The new point is corner 0 of every doubtful triangle: flip the side that faces it while a
    // point beyond lies inside the circle.
    void restore() {
        while (!doubtful_.empty()) {
            const std::uint32_t t = doubtful_.back();
            doubtful_.pop_back();
            const std::uint32_t s = triangles_[t].beyond[0];
            if (s == kNone)
                continue;
            const std::size_t j = corner_facing(s, t);
            const std::array<std::uint32_t, 3> at = triangles_[t].at;
            const std::uint32_t other = triangles_[s].at[j];
            if (!in_circle(places_[at[0]], places_[at[1]], places_[at[2]], places_[other]))
                continue;
            const std::uint32_t past_1 = triangles_[s].beyond[before(j)];
            const std::uint32_t past_2 = triangles_[s].beyond[next(j)];
            const std::uint32_t mine_1 = triangles_[t].beyond[1];
            const std::uint32_t mine_2 = triangles_[t].beyond[2];
            flip(t, s, other, {past_1, past_2, mine_1, mine_2});
        }
    }

    // t = (p, a, b) and s with the far corner o become (p, a, o) and (p, o, b). Past: the
    // triangles beyond o-b of s, a-o of s, and beyond b-p and p-a of t.
    void flip(std::uint32_t t, std::uint32_t s, std::uint32_t other,
              const std::array<std::uint32_t, 4>& past) {
        const std::array<std::uint32_t, 3> at = triangles_[t].at;
        const std::uint32_t past_ao = past[1], past_ob = past[0];
        triangles_[t] = {{at[0], at[1], other}, {past_ao, s, past[3]}};
        triangles_[s] = {{at[0], other, at[2]}, {past_ob, past[2], t}};
        point_back(past_ao, s, t);
        point_back(past[2], t, s);
        doubtful_.push_back(t);
        doubtful_.push_back(s);
    }

    std::vector<Place>& places_;
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> doubtful_;
    std::uint32_t last_ = 0;
};

// Rounded to the grid that the box of all points is laid over.
std::vector<Place> on_grid(std::span<const glm::dvec2> points) {
    if (points.size() > kMostPoints)
        fail<InvalidInput>("there are ", points.size(), " points, at most ", kMostPoints,
                           " are triangulated");
    glm::dvec2 low(std::numeric_limits<double>::max());
    glm::dvec2 high(-std::numeric_limits<double>::max());
    for (const glm::dvec2& p : points) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y))
            fail<InvalidInput>("a point to triangulate has a place that is no number");
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const double side = std::max(high.x - low.x, high.y - low.y);
    if (!std::isfinite(side))
        fail<InvalidInput>("the points to triangulate lie too far apart");
    const double cells = side > 0.0 ? kGrid / side : 0.0;
    std::vector<Place> places;
    places.reserve(points.size() + 3);
    for (const glm::dvec2& p : points)
        places.push_back(
            {std::llround((p.x - low.x) * cells), std::llround((p.y - low.y) * cells)});
    return places;
}

}  // namespace

PlanTriangulation triangulate_plan(std::span<const glm::dvec2> points) {
    PlanTriangulation result;
    if (points.empty())
        return result;
    std::vector<Place> places = on_grid(points);
    const auto n = static_cast<std::uint32_t>(places.size());
    // Rounds of twice as many points each, drawn by chance, keep the number of flips small for any
    // arrangement (Amenta, Choi and Rote 2003); along the curve inside a round walks are short.
    std::vector<std::tuple<int, std::uint64_t, std::uint32_t>> order(n);
    for (std::uint32_t i = 0; i < n; ++i)
        order[i] = {-std::countl_zero(Rng({.stream = kStream, .cell = i}).bits()),
                    hilbert(places[i]), i};
    std::sort(order.begin(), order.end());
    Builder builder(places);
    for (const auto& [round, along, point] : order)
        result.n_repeated += builder.insert(point) ? 0 : 1;
    result.triangles = builder.result(n);
    return result;
}

}  // namespace scree::meshing
