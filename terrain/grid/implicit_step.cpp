#include "terrain/grid/implicit_step.h"

#include "base/parallel.h"
#include "terrain/grid/face_flux.h"
#include "terrain/grid/slope_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace scree::terrain {

namespace {

constexpr std::size_t kRows = 8;
constexpr double kGain = 4.0;
constexpr int kPatience = 100;  // passes without getting better before relaxing less

struct Slope {
    double value = 0.0;
    double derivative = 0.0;
};

// Slide through a face per unit of diffusion * time step, metres (`rocks-and-deformer.md` C.8), for
// a difference above what the face holds.
class SlideRule {
public:
    SlideRule(Slide slide, double cell_size) : slide_(slide), per_cell_(1.0 / cell_size) {}

    Slope above(double difference, double limit) const {
        if (slide_ == Slide::Excess)
            return {difference - limit, 1.0};
        const double gain = slide_ == Slide::Gain ? kGain : 1.0;
        const double s = difference * per_cell_;
        const double holds = std::atan(limit * per_cell_);
        const double room = std::max(std::numbers::pi / 2 - holds, 1e-6);
        const double weight = gain * (std::atan(s) - holds) / room;  // (4.4) on faces
        if (weight >= 1.0)
            return {difference, 1.0};
        return {weight * difference, weight + gain * s / ((1.0 + s * s) * room)};
    }

private:
    Slide slide_;
    double per_cell_;
};

FloatRaster face_rates(const SoilTile& soil, double time_step, int along_x, int along_y) {
    const FloatRaster& diffusion = soil.diffusion;
    FloatRaster rates(diffusion.width(), diffusion.height());
    for (int y = 0; y + along_y < rates.height(); ++y)
        for (int x = 0; x + along_x < rates.width(); ++x)
            rates(x, y) = static_cast<float>(
                time_step * static_cast<double>(face_diffusion(
                                diffusion(x, y), diffusion(x + along_x, y + along_y))));
    return rates;
}

// Solves H + div(rate * slide(H)) = H before, cell by cell.
class Solver {
public:
    Solver(const DoubleRaster& before, const SlopeLimits& limits, const SoilTile& soil,
           double cell_size, const ImplicitOptions& options)
        : before_(before),
          heights_(before),
          limits_(limits),
          rate_x_(face_rates(soil, options.time_step, 1, 0)),
          rate_z_(face_rates(soil, options.time_step, 0, 1)),
          rule_(options.slide, cell_size),
          row_change_(static_cast<std::size_t>(before.height())) {
        const float rate = std::max(*std::max_element(rate_x_.begin(), rate_x_.end()),
                                    *std::max_element(rate_z_.begin(), rate_z_.end()));
        stiffness_ = static_cast<double>(rate);
    }

    // Until a pass changes no height by more than what, carried through the fluxes, is `tolerance`.
    ImplicitReport solve(double tolerance, int max_sweeps) {
        const double jacobi = 4.0 * stiffness_ / (1.0 + 4.0 * stiffness_);
        double relaxation = 2.0 / (1.0 + std::sqrt(1.0 - jacobi * jacobi));  // Young's optimum
        const double enough = tolerance / (1.0 + 8.0 * stiffness_);
        double least = std::numeric_limits<double>::infinity();
        int idle = 0;
        ImplicitReport report;
        while (report.sweeps < max_sweeps && !report.converged) {
            const double change = sweep(relaxation);
            report.converged = change <= enough;
            ++report.sweeps;
            idle = change < 0.9 * least ? 0 : idle + 1;
            least = std::min(least, change);
            if (idle == kPatience) {  // kinks of the slide make a pass overshoot
                relaxation = 1.0 + 0.5 * (relaxation - 1.0);
                idle = 0;
            }
        }
        return report;
    }

    // The ground before plus the fluxes of the solution.
    DoubleRaster moved() const {
        DoubleRaster result = before_;
        const auto hand = [&](double& first, double& second, double flux) {
            first += flux;
            second -= flux;
        };
        for (int y = 0; y < result.height(); ++y)
            for (int x = 0; x < result.width(); ++x) {
                if (x + 1 < result.width())
                    hand(result(x, y), result(x + 1, y),
                         face_x(x, y, heights_(x + 1, y) - heights_(x, y)).value);
                if (y + 1 < result.height())
                    hand(result(x, y), result(x, y + 1),
                         face_z(x, y, heights_(x, y + 1) - heights_(x, y)).value);
            }
        return result;
    }

private:
    // Height that goes from a face's second cell to its first at a difference second - first.
    Slope face(double difference, double rise, double fall, double rate) const {
        if (difference > rise) {
            const Slope slope = rule_.above(difference, rise);
            return {rate * slope.value, rate * slope.derivative};
        }
        if (difference < -fall) {
            const Slope slope = rule_.above(-difference, fall);
            return {-rate * slope.value, rate * slope.derivative};
        }
        return {};
    }
    Slope face_x(int x, int y, double difference) const {
        return face(difference, static_cast<double>(limits_.rise_x(x, y)),
                    static_cast<double>(limits_.fall_x(x, y)), static_cast<double>(rate_x_(x, y)));
    }
    Slope face_z(int x, int y, double difference) const {
        return face(difference, static_cast<double>(limits_.rise_z(x, y)),
                    static_cast<double>(limits_.fall_z(x, y)), static_cast<double>(rate_z_(x, y)));
    }

    // What is missing in a cell's equation at height h; grows with h.
    Slope residual(int x, int y, double h) const {
        Slope sum{h - before_(x, y), 1.0};
        const auto add = [&sum](Slope outflow, double sign) {
            sum.value += sign * outflow.value;
            sum.derivative += outflow.derivative;
        };
        if (x > 0)
            add(face_x(x - 1, y, h - heights_(x - 1, y)), 1.0);
        if (x + 1 < heights_.width())
            add(face_x(x, y, heights_(x + 1, y) - h), -1.0);
        if (y > 0)
            add(face_z(x, y - 1, h - heights_(x, y - 1)), 1.0);
        if (y + 1 < heights_.height())
            add(face_z(x, y, heights_(x, y + 1) - h), -1.0);
        return sum;
    }

    // The height that solves a cell's equation: it lies between its neighbours' and its old one.
    double solve_cell(int x, int y) const {
        double low = before_(x, y);
        double high = low;
        const auto widen = [&](int nx, int ny) {
            if (heights_.contains(nx, ny)) {
                low = std::min(low, heights_(nx, ny));
                high = std::max(high, heights_(nx, ny));
            }
        };
        widen(x - 1, y);
        widen(x + 1, y);
        widen(x, y - 1);
        widen(x, y + 1);
        double h = std::clamp(heights_(x, y), low, high);
        for (int step = 0; step < 8; ++step) {
            const Slope missing = residual(x, y, h);
            (missing.value > 0.0 ? high : low) = h;
            double next = h - missing.value / missing.derivative;
            if (!(next >= low && next <= high))
                next = 0.5 * (low + high);
            const bool done = std::abs(next - h) <= 1e-12 * (1.0 + std::abs(h));
            h = next;
            if (done)
                break;
        }
        return h;
    }

    // The cells of one colour, then those of the other; the greatest change, metres.
    double sweep(double relaxation) {
        std::fill(row_change_.begin(), row_change_.end(), 0.0);
        for (int colour = 0; colour < 2; ++colour)
            parallel_for_each_index(0, row_change_.size(), kRows, [&](std::size_t row) {
                const int y = static_cast<int>(row);
                double greatest = row_change_[row];
                for (int x = (y + colour) % 2; x < heights_.width(); x += 2) {
                    const double change = relaxation * (solve_cell(x, y) - heights_(x, y));
                    heights_(x, y) += change;
                    greatest = std::max(greatest, std::abs(change));
                }
                row_change_[row] = greatest;
            });
        return *std::max_element(row_change_.begin(), row_change_.end());
    }

    const DoubleRaster& before_;
    DoubleRaster heights_;
    const SlopeLimits& limits_;
    FloatRaster rate_x_;
    FloatRaster rate_z_;
    SlideRule rule_;
    double stiffness_ = 0.0;
    std::vector<double> row_change_;
};

}  // namespace

ImplicitReport implicit_step(FloatRaster& displacement, const Heightfield& base,
                             const SoilTile& soil, const ImplicitOptions& options) {
    check(options);
    check_ground(base, displacement);
    check_soil_tile(base, soil);

    const DoubleRaster before = total_heights(base, displacement);
    const SlopeLimits limits = slope_limits(base, soil, options.keep_base);
    Solver solver(before, limits, soil, base.cell_size, options);
    const ImplicitReport report =
        solver.solve(options.tolerance * base.cell_size, options.max_sweeps);
    if (report.converged)
        store_displacement(before, solver.moved(), base, displacement);
    return report;
}

ImplicitReport implicit_step(FloatRaster& displacement, const Heightfield& base,
                             const SoilField& soil, const ImplicitOptions& options) {
    check_heightfield(base);
    SoilTile tile;
    soil.fill({0, 0, base.heights.width(), base.heights.height()}, tile);
    return implicit_step(displacement, base, tile, options);
}

}  // namespace scree::terrain
