#include "terrain/prepare/survey.h"

#include "base/error.h"
#include "meshing/space/delaunay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

constexpr double kMostCells = 1e9;  // along a side, so that a cell's number fits 64 bits
constexpr std::int64_t kReach = 3;  // of the slope filter, cells

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::max()};
    glm::dvec3 high{-std::numeric_limits<double>::max()};
};

Box box_of(std::span<const glm::dvec3> points) {
    Box box;
    for (const glm::dvec3& p : points) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            fail<InvalidInput>("a point of the survey has a place that is no number");
        box.low = glm::min(box.low, p);
        box.high = glm::max(box.high, p);
    }
    return box;
}

std::vector<glm::dvec3> ground_points(std::span<const glm::dvec3> points,
                                      std::span<const std::uint8_t> classes, bool ground_only) {
    const bool classified = ground_only && std::find(classes.begin(), classes.end(),
                                                     meshing::kGroundClass) != classes.end();
    std::vector<glm::dvec3> ground;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!classified || classes[i] == meshing::kGroundClass)
            ground.push_back(points[i]);
    return ground;
}

// Square cells over the plan; a cell's number is that of its column and row.
struct Cells {
    double size;

    std::int64_t along(double at) const { return static_cast<std::int64_t>(at / size); }
    static std::int64_t number(std::int64_t column, std::int64_t row) {
        return (row + kReach) * (std::int64_t{1} << 31U) + column + kReach;
    }
    std::int64_t number(const glm::dvec3& p) const { return number(along(p.x), along(p.z)); }
};

// One point a cell, in the order of the cells. Points are relative to the least corner.
std::vector<glm::dvec3> thin(const std::vector<glm::dvec3>& points, const Cells& cells,
                             ThinKeep keep) {
    std::vector<std::pair<std::int64_t, std::uint32_t>> order(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i)
        order[i] = {cells.number(points[i]), i};
    std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
        return std::tuple(a.first, points[a.second].y, a.second) <
               std::tuple(b.first, points[b.second].y, b.second);
    });
    std::vector<glm::dvec3> left;
    for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
        while (end < order.size() && order[end].first == order[i].first)
            ++end;
        left.push_back(points[order[keep == ThinKeep::Lowest ? i : (i + end - 1) / 2].second]);
    }
    return left;
}

// Without the points that stand over one nearby as no ground does: a slope filter after
// Vosselman 2000. Trees, houses and people go, and the lips of cliffs.
std::vector<glm::dvec3> drop_steep(const std::vector<glm::dvec3>& points, const Cells& cells,
                                   double steepest_deg) {
    std::unordered_map<std::int64_t, std::size_t> at;
    for (std::size_t i = 0; i < points.size(); ++i)
        at.emplace(cells.number(points[i]), i);
    const double slope = std::tan(steepest_deg * std::numbers::pi / 180.0);
    std::vector<glm::dvec3> left;
    for (const glm::dvec3& p : points) {
        bool stands = false;
        for (std::int64_t row = -kReach; row <= kReach && !stands; ++row)
            for (std::int64_t column = -kReach; column <= kReach && !stands; ++column) {
                const auto found =
                    at.find(Cells::number(cells.along(p.x) + column, cells.along(p.z) + row));
                if (found == at.end())
                    continue;
                const glm::dvec3 q = points[found->second];
                stands = p.y - q.y > slope * std::hypot(p.x - q.x, p.z - q.z);
            }
        if (!stands)
            left.push_back(p);
    }
    return left;
}

class Tin {
public:
    explicit Tin(std::vector<glm::dvec3> points, double longest) : points_(std::move(points)) {
        std::vector<glm::dvec2> plan;
        plan.reserve(points_.size());
        for (const glm::dvec3& p : points_)
            plan.emplace_back(p.x, -p.z);  // counter-clockwise seen from above
        for (const glm::uvec3& t : meshing::triangulate_plan(plan).triangles) {
            const double side =
                std::max({glm::distance(plan[t.x], plan[t.y]), glm::distance(plan[t.y], plan[t.z]),
                          glm::distance(plan[t.z], plan[t.x])});
            if (longest > 0.0 && side > longest)
                continue;
            triangles_.push_back(t);
            area += 0.5 * twice_area(plan[t.x], plan[t.y], plan[t.z]);
        }
        if (!(area > 0.0))
            fail<InvalidInput>("the ", points_.size(), " points left of the survey span no ground",
                               longest > 0.0 ? ": raise longest" : "");
    }

    // Heights at all places that some triangle covers.
    void sample(GroundLattice& lattice) const {
        for (const glm::uvec3& t : triangles_)
            sample(lattice, points_[t.x], points_[t.y], points_[t.z]);
    }

    double area = 0.0;

private:
    static double twice_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    }

    // Steps of the lattice that lie in [low, high] along an axis, as far as it goes.
    static std::pair<int, int> steps_in(double low, double high, double start, double step, int n) {
        const double first = std::ceil((low - start) / step - 1e-9);
        const double last = std::floor((high - start) / step + 1e-9);
        return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(n))),
                static_cast<int>(std::clamp(last, -1.0, n - 1.0))};
    }

    // Row by row: what a triangle costs is its rows and the places that it covers, however thin and
    // long it is.
    static void sample(GroundLattice& lattice, const glm::dvec3& a, const glm::dvec3& b,
                       const glm::dvec3& c) {
        const glm::dvec2 pa(a.x, a.z), pb(b.x, b.z), pc(c.x, c.z);
        const double whole = twice_area(pa, pb, pc);
        if (whole == 0.0)
            return;
        const auto [j0, j1] = steps_in(std::min({a.z, b.z, c.z}), std::max({a.z, b.z, c.z}),
                                       lattice.first.y, lattice.step.y, lattice.heights.height());
        for (int j = j0; j <= j1; ++j) {
            const double z = lattice.place(0, j).y;
            double low = std::numeric_limits<double>::max(), high = -low;
            for (const auto& [from, to] :
                 {std::pair(pa, pb), std::pair(pb, pc), std::pair(pc, pa)}) {
                const double f =
                    from.y == to.y ? 0.0 : std::clamp((z - from.y) / (to.y - from.y), 0.0, 1.0);
                if (std::abs(from.y + f * (to.y - from.y) - z) > 1e-6 * lattice.step.y)
                    continue;  // the side does not reach this row
                const double x = from.x + f * (to.x - from.x);
                const double other = from.y == to.y ? to.x : x;
                low = std::min({low, x, other});
                high = std::max({high, x, other});
            }
            const auto [i0, i1] =
                steps_in(low, high, lattice.first.x, lattice.step.x, lattice.heights.width());
            for (int i = i0; i <= i1; ++i) {
                const glm::dvec2 p = lattice.place(i, j);
                const double u = twice_area(p, pb, pc) / whole;
                const double v = twice_area(pa, p, pc) / whole;
                if (std::min({u, v, 1.0 - u - v}) >= -1e-9)
                    lattice.heights(i, j) =
                        static_cast<float>(u * a.y + v * b.y + (1.0 - u - v) * c.y);
            }
        }
    }

    std::vector<glm::dvec3> points_;
    std::vector<glm::uvec3> triangles_;
};

}  // namespace

GroundLattice lattice_of_points(std::span<const glm::dvec3> points,
                                std::span<const std::uint8_t> classes, std::size_t n,
                                const SurveyOptions& options, SurveyReport* report) {
    check(options);
    if (!classes.empty() && classes.size() != points.size())
        fail<InvalidInput>("the survey has ", points.size(), " points but ", classes.size(),
                           " classes");
    SurveyReport done;
    done.n_points = points.size();
    std::vector<glm::dvec3> ground = ground_points(points, classes, options.ground_only);
    done.n_ground = ground.size();
    if (ground.size() < 3)
        fail<InvalidInput>("the survey has ", ground.size(),
                           " points of ground, at least 3 are "
                           "needed");
    const Box whole = box_of(points);
    const Box box = box_of(ground);
    for (glm::dvec3& p : ground) {
        p.x -= whole.low.x;
        p.z -= whole.low.z;
    }
    const glm::dvec2 low(box.low.x - whole.low.x, box.low.z - whole.low.z);
    const glm::dvec2 high(box.high.x - whole.low.x, box.high.z - whole.low.z);
    const glm::dvec2 size = high - low;
    if (!(size.x > 0.0 && size.y > 0.0))
        fail<InvalidInput>("the points of the survey measure ", size.x, " x ", size.y,
                           " m seen from above, both must be positive");
    done.moved = {whole.low.x, whole.low.z};
    const Cells cells{
        options.spacing > 0.0
            ? options.spacing
            : std::sqrt(size.x * size.y / static_cast<double>(std::max<std::size_t>(n, 1)))};
    if (!(std::max(high.x, high.y) < kMostCells * cells.size))
        fail<InvalidInput>("the survey measures ", size.x, " x ", size.y,
                           " m, too much for cells of ", cells.size, " m: raise spacing");
    ground = thin(ground, cells, options.keep);
    done.n_thinned = ground.size();
    if (options.steepest > 0.0) {
        ground = drop_steep(ground, cells, options.steepest);
        done.n_steep = done.n_thinned - ground.size();
    }
    const Tin tin(std::move(ground), options.longest);
    done.area = tin.area;
    // The triangles shall hold n places, not the box around them.
    const double share = std::max(tin.area / (size.x * size.y), 0.01);
    GroundLattice lattice =
        lattice_over(low, high, static_cast<std::size_t>(static_cast<double>(n) / share));
    tin.sample(lattice);
    if (report != nullptr)
        *report = done;
    return lattice;
}

}  // namespace scree::terrain
