#include "terrain/prepare/river_bed.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

constexpr std::size_t kMostPoints = 2000;
constexpr std::size_t kMostSamples = 1'000'000;

void check_bed(const RiverBed& bed) {
    check(bed.options);
    if (bed.line.size() < 2 || bed.line.size() > kMostPoints)
        fail<InvalidInput>("the line of the bed has ", bed.line.size(), " points, must be 2 to ",
                           kMostPoints);
    for (const glm::dvec2& p : bed.line)
        if (!std::isfinite(p.x) || !std::isfinite(p.y))
            fail<InvalidInput>("the line of the bed has a point that is no number");
    if (!(bed.options.width + bed.options.bank > 0.0))
        fail<InvalidInput>("the bed has neither width nor banks");
}

// Heights of the bed at evenly spread points of the line.
class Course {
public:
    Course(const GroundLattice& ground, const RiverBed& bed) {
        starts_.push_back(0.0);
        for (std::size_t k = 1; k < bed.line.size(); ++k)
            starts_.push_back(starts_.back() + glm::distance(bed.line[k - 1], bed.line[k]));
        const double finest = 0.5 * std::min(ground.step.x, ground.step.y);
        const double wanted = std::ceil(length() / finest) + 1.0;
        levels_.resize(
            static_cast<std::size_t>(std::clamp(wanted, 2.0, static_cast<double>(kMostSamples))));
        sample_land(ground, bed.line);
        fill_unknown();
        if (bed.options.falling)
            make_fall();
        for (double& level : levels_)
            level -= bed.options.depth;
    }

    double length() const { return starts_.back(); }
    double known_length() const { return known_share_ * length(); }
    double start_of(std::size_t segment) const { return starts_[segment]; }

    double level_at(double along) const {
        const double at = length() > 0.0 ? along / length() * last() : 0.0;
        const auto k = static_cast<std::size_t>(std::clamp(at, 0.0, last() - 1.0));
        const double f = std::clamp(at - static_cast<double>(k), 0.0, 1.0);
        return (1.0 - f) * levels_[k] + f * levels_[k + 1];
    }

private:
    double last() const { return static_cast<double>(levels_.size() - 1); }

    void sample_land(const GroundLattice& ground, const std::vector<glm::dvec2>& line) {
        std::size_t segment = 0, n_known = 0;
        for (std::size_t k = 0; k < levels_.size(); ++k) {
            const double along = length() * static_cast<double>(k) / last();
            while (segment + 2 < line.size() && along > starts_[segment + 1])
                ++segment;
            const double whole = starts_[segment + 1] - starts_[segment];
            const double f =
                whole > 0.0 ? std::clamp((along - starts_[segment]) / whole, 0.0, 1.0) : 0.0;
            const glm::dvec2 p = line[segment] + f * (line[segment + 1] - line[segment]);
            levels_[k] = height_at(ground, p.x, p.y);
            n_known += std::isnan(levels_[k]) ? 0 : 1;
        }
        if (n_known == 0)
            fail<InvalidInput>("the line of the bed, from (", line.front().x, ", ", line.front().y,
                               ") on, lies nowhere over the ground");
        known_share_ = static_cast<double>(n_known) / static_cast<double>(levels_.size());
    }

    // Where the line leaves the ground the last height known holds.
    void fill_unknown() {
        const auto carry = [](auto begin, auto end) {
            double known = std::numeric_limits<double>::quiet_NaN();
            for (auto at = begin; at != end; ++at) {
                if (std::isnan(*at))
                    *at = known;
                known = *at;
            }
        };
        carry(levels_.begin(), levels_.end());
        carry(levels_.rbegin(), levels_.rend());
    }

    void make_fall() {
        const bool backwards = levels_.back() > levels_.front();
        if (backwards)
            std::reverse(levels_.begin(), levels_.end());
        for (std::size_t k = 1; k < levels_.size(); ++k)
            levels_[k] = std::min(levels_[k], levels_[k - 1]);
        if (backwards)
            std::reverse(levels_.begin(), levels_.end());
    }

    std::vector<double> starts_;  // of the segments along the line
    std::vector<double> levels_;
    double known_share_ = 0.0;
};

// The nearest point of the line to each place.
struct Nearest {
    float distance = std::numeric_limits<float>::max();
    float along = 0.0F;
};

// Of the places within `reach` of a segment.
void visit_segment(const GroundLattice& ground, const glm::dvec2& a, const glm::dvec2& b,
                   double start, double reach, Raster<Nearest>& nearest) {
    const auto range = [reach](double p, double q, double first, double step, int n) {
        const double low = (std::min(p, q) - reach - first) / step;
        const double high = (std::max(p, q) + reach - first) / step;
        return std::pair(static_cast<int>(std::clamp(std::ceil(low), 0.0, double(n))),
                         static_cast<int>(std::clamp(std::floor(high), -1.0, n - 1.0)));
    };
    const auto [i0, i1] = range(a.x, b.x, ground.first.x, ground.step.x, ground.heights.width());
    const auto [j0, j1] = range(a.y, b.y, ground.first.y, ground.step.y, ground.heights.height());
    const glm::dvec2 way = b - a;
    const double square = glm::dot(way, way);
    for (int j = j0; j <= j1; ++j)
        for (int i = i0; i <= i1; ++i) {
            const glm::dvec2 p = ground.place(i, j);
            const double f =
                square > 0.0 ? std::clamp(glm::dot(p - a, way) / square, 0.0, 1.0) : 0.0;
            const auto distance = static_cast<float>(glm::distance(p, a + f * way));
            if (distance < nearest(i, j).distance)
                nearest(i, j) = {distance, static_cast<float>(start + f * std::sqrt(square))};
        }
}

// 0 at the bed's bottom, 1 where the banks end.
double rise_at(double distance, const BedOptions& options) {
    const double half = 0.5 * options.width;
    if (options.profile == BedProfile::Round) {
        const double share = distance / (half + options.bank);
        return std::min(1.0, share * share);
    }
    if (distance <= half)
        return 0.0;
    return options.bank > 0.0 ? std::min(1.0, (distance - half) / options.bank) : 1.0;
}

}  // namespace

BedReport cut_bed(GroundLattice& ground, const RiverBed& bed) {
    check_bed(bed);
    const Course course(ground, bed);
    Raster<Nearest> nearest(ground.heights.width(), ground.heights.height());
    const double reach = 0.5 * bed.options.width + bed.options.bank;
    for (std::size_t k = 0; k + 1 < bed.line.size(); ++k)
        visit_segment(ground, bed.line[k], bed.line[k + 1], course.start_of(k), reach, nearest);
    BedReport report;
    report.length = course.known_length();
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        const Nearest& at = nearest.data()[i];
        float& height = ground.heights.data()[i];
        if (static_cast<double>(at.distance) > reach || std::isnan(height))
            continue;
        const double land = static_cast<double>(height);
        const double level = course.level_at(static_cast<double>(at.along));
        const double rise = rise_at(static_cast<double>(at.distance), bed.options);
        const auto lowered = static_cast<float>(level + rise * (land - level));
        if (!(land > level) || !(lowered < height))
            continue;
        height = lowered;
        ++report.n_lowered;
        report.deepest = std::max(report.deepest, land - static_cast<double>(lowered));
    }
    return report;
}

}  // namespace scree::terrain
