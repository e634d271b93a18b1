#include "vision/thesis/turning_angle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace scree::vision {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double by_rule(double cosine, double sine, const ThesisOptions& o) {
    const double least = 1e-12;  // a factor of zero must not divide
    const double turn = cosine / std::max(least, o.cosine_factor);
    const double side = sine / std::max(least, o.sine_factor);
    switch (o.turn_rule) {
        case TurnRule::SignedOutward:
            return std::max(turn, -side);
        case TurnRule::SignedInward:
            return std::max(turn, side);
        case TurnRule::UnsignedAnd:
            return std::max(turn, std::abs(side));
        case TurnRule::UnsignedOr:
            return std::min(turn, std::abs(side));
        case TurnRule::CosineOnly:
            return turn;
        default:
            return kNever;
    }
}

// A closed polygon that loses vertices; remembers the critical severity of each one left.
class Peeler {
public:
    Peeler(std::span<const glm::dvec2> polygon, const ThesisOptions& options)
        : polygon_(polygon),
          options_(options),
          before_(polygon.size()),
          after_(polygon.size()),
          critical_(polygon.size()),
          alive_(polygon.size(), 1),
          n_alive_(polygon.size()) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            before_[i] = (i + polygon.size() - 1) % polygon.size();
            after_[i] = (i + 1) % polygon.size();
        }
        for (std::size_t i = 0; i < polygon.size(); ++i)
            update(i);
        for (std::size_t i = 0; i < polygon.size(); ++i)
            suspects_.push_back(i);
    }

    std::size_t n_alive() const { return n_alive_; }
    const std::vector<std::uint8_t>& alive() const { return alive_; }
    /// Largest critical severity among the vertices peeled: down to it, nothing would differ.
    double margin() const { return margin_; }
    void suspect_all() {
        suspects_.clear();
        for (std::size_t i = 0; i < polygon_.size(); ++i)
            if (alive_[i] != 0)
                suspects_.push_back(i);
    }

    bool has_outlier(double severity) const {
        for (std::size_t i = 0; i < polygon_.size(); ++i)
            if (alive_[i] != 0 && critical_[i] < severity)
                return true;
        return false;
    }

    /// One pass; false if it finds no outlier or would leave fewer than `least` vertices.
    bool pass(double severity, std::size_t least) {
        flagged_.clear();
        for (const std::size_t i : suspects_)
            if (alive_[i] != 0 && critical_[i] < severity)
                flagged_.push_back(i);
        std::sort(flagged_.begin(), flagged_.end());
        flagged_.erase(std::unique(flagged_.begin(), flagged_.end()), flagged_.end());
        suspects_.clear();
        if (flagged_.empty() || n_alive_ < flagged_.size() + least)
            return false;
        for (const std::size_t i : flagged_) {
            alive_[i] = 0;
            margin_ = std::max(margin_, critical_[i]);
            after_[before_[i]] = after_[i];
            before_[after_[i]] = before_[i];
        }
        n_alive_ -= flagged_.size();
        for (const std::size_t i : flagged_)
            for (const std::size_t j : {alive_before(i), alive_after(i)})
                if (n_alive_ > 0) {
                    update(j);
                    suspects_.push_back(j);
                }
        return n_alive_ >= 3;
    }

private:
    void update(std::size_t i) {
        critical_[i] =
            critical_severity(polygon_[before_[i]], polygon_[i], polygon_[after_[i]], options_);
    }
    std::size_t alive_before(std::size_t i) const {
        while (n_alive_ > 0 && alive_[i] == 0)
            i = before_[i];
        return i;
    }
    std::size_t alive_after(std::size_t i) const {
        while (n_alive_ > 0 && alive_[i] == 0)
            i = after_[i];
        return i;
    }

    std::span<const glm::dvec2> polygon_;
    const ThesisOptions& options_;
    std::vector<std::size_t> before_;
    std::vector<std::size_t> after_;
    std::vector<double> critical_;
    std::vector<std::uint8_t> alive_;
    std::vector<std::size_t> suspects_;
    std::vector<std::size_t> flagged_;
    std::size_t n_alive_;
    double margin_ = -kNever;
};

int steps_of(const ThesisOptions& o) {
    return static_cast<int>(std::floor(1.0 / o.severity_step + 1e-9));
}

double severity_at(int step, const ThesisOptions& o) {
    return std::max(0.0, 1.0 - step * o.severity_step);
}

FilteredPolygon restarting(std::span<const glm::dvec2> polygon, const ThesisOptions& options) {
    const Peeler whole(polygon, options);
    const auto least = static_cast<std::size_t>(options.least_vertices);
    FilteredPolygon result;
    int step = 0;
    while (step <= steps_of(options)) {
        const double severity = severity_at(step, options);
        Peeler peeler = whole;
        while (peeler.pass(severity, 0) && peeler.n_alive() >= least)
            continue;
        if (peeler.n_alive() >= least) {
            result.kept = peeler.alive();
            result.n_kept = static_cast<int>(peeler.n_alive());
            result.severity = severity;
            result.accepted = true;
            return result;
        }
        // The same vertices go at every severity above the margin, so leap past those.
        ++step;
        while (step <= steps_of(options) && severity_at(step, options) > peeler.margin())
            ++step;
    }
    result.kept.assign(polygon.size(), 0);
    return result;
}

FilteredPolygon cumulative(std::span<const glm::dvec2> polygon, const ThesisOptions& options) {
    Peeler peeler(polygon, options);
    const auto least = static_cast<std::size_t>(options.least_vertices);
    FilteredPolygon result;
    for (int step = 0; step <= steps_of(options); ++step) {
        result.severity = severity_at(step, options);
        peeler.suspect_all();
        while (peeler.pass(result.severity, least))
            continue;
        if (peeler.n_alive() <= least || !peeler.has_outlier(result.severity))
            break;  // whoever passes at this severity passes at every lower one
    }
    result.kept = peeler.alive();
    result.n_kept = static_cast<int>(peeler.n_alive());
    result.accepted = true;
    return result;
}

}  // namespace

double critical_severity(glm::dvec2 before, glm::dvec2 here, glm::dvec2 after,
                         const ThesisOptions& options) {
    const glm::dvec2 in = here - before;
    const glm::dvec2 out = after - here;
    const double length_in = glm::length(in);
    const double length_out = glm::length(out);
    if (length_in == 0.0)
        return -kNever;  // doubled vertex: a zero-length edge has no normal
    if (length_out == 0.0)
        return kNever;  // its double goes first
    const double scale = 1.0 / (length_in * length_out);
    const double cosine = (in.x * out.x + in.y * out.y) * scale;
    const double sine = (in.x * out.y - in.y * out.x) * scale;  // > 0 at an outward corner
    return by_rule(cosine, sine, options);
}

std::vector<std::uint8_t> peeled(std::span<const glm::dvec2> polygon, double severity,
                                 const ThesisOptions& options) {
    check_thesis(options);
    if (polygon.size() < 3)
        return std::vector<std::uint8_t>(polygon.size(), 1);
    Peeler peeler(polygon, options);
    while (peeler.pass(severity, 0))
        continue;
    return peeler.alive();
}

FilteredPolygon filter_outliers(std::span<const glm::dvec2> polygon, const ThesisOptions& options) {
    FilteredPolygon rejected;
    rejected.kept.assign(polygon.size(), 0);
    if (polygon.size() < 3 || polygon.size() < static_cast<std::size_t>(options.least_vertices))
        return rejected;
    return options.schedule == SeveritySchedule::Restart ? restarting(polygon, options)
                                                         : cumulative(polygon, options);
}

}  // namespace scree::vision
