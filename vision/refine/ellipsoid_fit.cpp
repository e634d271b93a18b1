#include "vision/refine/ellipsoid_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <ceres/cubic_interpolation.h>
#include <ceres/tiny_solver.h>
#include <glm/geometric.hpp>

namespace scree::vision {
namespace {

using Grid = ceres::Grid2D<float>;
using Interpolator = ceres::BiCubicInterpolator<Grid>;
using Basis = std::array<double, 2 * kMostHarmonics + 1>;

constexpr double kCauchy = 1.5;          // residuals beyond this many sigma lose influence
constexpr double kCorrelation = 3.0;     // px along the outline over which errors are alike
constexpr double kAnchorShare = 0.6;     // standard deviation of the start, share of the window
constexpr double kFirstHarmonic = 0.03;  // of log radius: ties the centre to the middle
constexpr double kRoughness = 0.20;      // of log radius at the second harmonic; it falls as...
constexpr double kRoughnessFall = 1.6;   // ...this power of the harmonic's number
constexpr double kSizeFreedom = 1.0;     // of log mean radius about the start

// Cauchy's robust cost as a residual: its square is k^2 log(1 + (e / k)^2), so that the solver may
// stay plain least squares.
struct Robust {
    double value = 0.0;
    double slope = 1.0;
};

Robust robust(double e) {
    const double s = e / kCauchy;
    const double t = s * s;
    if (t < 1e-8)
        return {e, 1.0};
    const double value = std::copysign(kCauchy * std::sqrt(std::log1p(t)), e);
    return {value, e / ((1.0 + t) * value)};
}

// One over the standard deviation of each coefficient.
Basis prior_of(int n_coefficients, double roughness) {
    Basis prior{};
    for (int i = 0; i < n_coefficients; ++i) {
        const int k = (i + 1) / 2;
        const double sigma = k == 0   ? kSizeFreedom
                             : k == 1 ? kFirstHarmonic
                                      : roughness * kRoughness * std::pow(0.5 * k, -kRoughnessFall);
        prior[static_cast<std::size_t>(i)] = 1.0 / sigma;
    }
    return prior;
}

/// The residuals in the form of ceres::TinySolver. Parameters: the centre's move over the mean
/// radius (2), then the series. Residuals: hits, pull of the field, start (one a ray each), prior.
class Cost {
public:
    using Scalar = double;
    enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

    Cost(const EdgeMaps& maps, const std::vector<EdgeHit>& hits, const Shape& start, double window,
         const RefineOptions& options)
        : hits_(hits),
          start_(start),
          options_(options),
          size_(std::exp(start.coefficients[0])),
          anchor_(kAnchorShare * window),
          grid_(maps.boundary.data(), 0, maps.boundary.height(), 0, maps.boundary.width()),
          field_(grid_),
          basis_(hits.size()),
          prior_(prior_of(start.n_coefficients(), options.roughness)) {
        for (std::size_t i = 0; i < hits.size(); ++i)
            fourier_basis(hits[i].direction.x, hits[i].direction.y, start.n_harmonics,
                          basis_[i].data());
        const double spacing = 2.0 * std::numbers::pi * size_ / static_cast<double>(hits.size());
        share_ = std::sqrt(std::min(1.0, spacing / kCorrelation));
    }

    int NumParameters() const { return 2 + start_.n_coefficients(); }
    int NumResiduals() const {
        return 3 * static_cast<int>(hits_.size()) + start_.n_coefficients();
    }

    Shape shape_at(const double* x) const {
        Shape shape = start_;
        shape.centre += size_ * glm::dvec2(x[0], x[1]);
        std::copy_n(x + 2, shape.n_coefficients(), shape.coefficients.begin());
        return shape;
    }

    bool operator()(const double* x, double* residuals, double* jacobian) const {
        const Shape shape = shape_at(x);
        const Rows rows{residuals, jacobian, NumResiduals()};
        if (jacobian != nullptr)
            std::fill_n(jacobian, NumResiduals() * NumParameters(), 0.0);
        const int n = static_cast<int>(hits_.size());
        for (int i = 0; i < n; ++i) {
            add_hit(shape, hits_[static_cast<std::size_t>(i)], i, rows);
            add_ray(shape, static_cast<std::size_t>(i), n + 2 * i, rows);
        }
        add_prior(shape, 3 * n, rows);
        return true;
    }

    const Basis& basis(std::size_t ray) const { return basis_[ray]; }

private:
    struct Rows {
        double* residuals;
        double* jacobian;  // by columns; may be null
        int n_rows;
        double& slope(int row, int parameter) const { return jacobian[parameter * n_rows + row]; }
    };

    // Distance of the fixed point from the curve, along the line to the centre.
    void add_hit(const Shape& shape, const EdgeHit& hit, int row, const Rows& rows) const {
        rows.residuals[row] = 0.0;
        if (hit.weight <= 0.0)
            return;
        const glm::dvec2 arm = hit.point - shape.centre;
        const double length = std::max(1e-9, std::hypot(arm.x, arm.y));
        const glm::dvec2 unit = arm / length;
        Basis basis;
        fourier_basis(unit.x, unit.y, shape.n_harmonics, basis.data());
        const RadiusSlope curve = radius_slope(shape, basis.data());
        const double scale = share_ * hit.weight * hit.obliquity / options_.hit_error;
        const Robust e = robust(scale * (length - curve.radius));
        rows.residuals[row] = e.value;
        if (rows.jacobian == nullptr)
            return;
        const double chain = scale * e.slope;
        const double turn = curve.slope / length;  // of the curve's radius as the centre moves
        rows.slope(row, 0) = size_ * chain * (-unit.x - turn * unit.y);
        rows.slope(row, 1) = size_ * chain * (-unit.y + turn * unit.x);
        for (int k = 0; k < shape.n_coefficients(); ++k)
            rows.slope(row, 2 + k) = -chain * curve.radius * basis[static_cast<std::size_t>(k)];
    }

    // Pull of the field and of the start along a fixed direction from the moving centre.
    void add_ray(const Shape& shape, std::size_t ray, int row, const Rows& rows) const {
        const EdgeHit& hit = hits_[ray];
        const Basis& basis = basis_[ray];
        const double radius = radius_slope(shape, basis.data()).radius;
        const double pull = hit.beyond ? 0.0 : share_ * options_.attraction;
        const double hold = share_ * hit.obliquity / anchor_;
        const glm::dvec2 start = start_.centre + hit.start * hit.direction;
        const glm::dvec2 point = shape.centre + radius * hit.direction;
        double value = 0.0;
        double by_row = 0.0;
        double by_column = 0.0;
        if (pull > 0.0)
            field_.Evaluate(point.y - 0.5, point.x - 0.5, &value, &by_row, &by_column);
        const double away = glm::dot(point - start, hit.direction);
        rows.residuals[row] = pull * (1.0 - value);
        rows.residuals[row + 1] = hold * away;
        if (rows.jacobian == nullptr)
            return;
        const double along = by_column * hit.direction.x + by_row * hit.direction.y;
        rows.slope(row, 0) = -pull * by_column * size_;
        rows.slope(row, 1) = -pull * by_row * size_;
        rows.slope(row + 1, 0) = hold * hit.direction.x * size_;
        rows.slope(row + 1, 1) = hold * hit.direction.y * size_;
        for (int k = 0; k < shape.n_coefficients(); ++k) {
            const double by_radius = radius * basis[static_cast<std::size_t>(k)];
            rows.slope(row, 2 + k) = -pull * along * by_radius;
            rows.slope(row + 1, 2 + k) = hold * by_radius;
        }
    }

    void add_prior(const Shape& shape, int row, const Rows& rows) const {
        for (int i = 0; i < shape.n_coefficients(); ++i) {
            const auto at = static_cast<std::size_t>(i);
            const double middle = i == 0 ? start_.coefficients[0] : 0.0;
            rows.residuals[row + i] = prior_[at] * (shape.coefficients[at] - middle);
            if (rows.jacobian != nullptr)
                rows.slope(row + i, 2 + i) = prior_[at];
        }
    }

    const std::vector<EdgeHit>& hits_;
    const Shape& start_;
    const RefineOptions& options_;
    double size_;
    double anchor_;
    double share_ = 1.0;
    Grid grid_;
    Interpolator field_;
    std::vector<Basis> basis_;
    Basis prior_;  // one over the standard deviation of each coefficient
};

// Standard deviation of the radius, root mean square over the rays, from the inverse of J'J.
double radius_deviation(const Cost& cost, const Shape& shape, const Eigen::VectorXd& x,
                        std::size_t n_rays) {
    Eigen::VectorXd residuals(cost.NumResiduals());
    Eigen::MatrixXd jacobian(cost.NumResiduals(), cost.NumParameters());
    cost(x.data(), residuals.data(), jacobian.data());
    const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    const Eigen::LLT<Eigen::MatrixXd> factor(normal);
    if (factor.info() != Eigen::Success)
        return 0.0;
    const double size = std::exp(shape.coefficients[0]);
    double sum = 0.0;
    Eigen::VectorXd slope(cost.NumParameters());
    for (std::size_t i = 0; i < n_rays; ++i) {
        const Basis& basis = cost.basis(i);
        const double radius = radius_slope(shape, basis.data()).radius;
        slope[0] = size * basis[1];  // the border point moves with the centre
        slope[1] = size * basis[2];
        for (int k = 0; k < shape.n_coefficients(); ++k)
            slope[2 + k] = radius * basis[static_cast<std::size_t>(k)];
        sum += factor.matrixL().solve(slope).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(n_rays));
}

}  // namespace

EllipsoidFit fit_ellipsoid(const EdgeMaps& maps, const std::vector<EdgeHit>& hits,
                           const Shape& shape, double window, const RefineOptions& options) {
    const Cost cost(maps, hits, shape, window, options);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(cost.NumParameters());
    for (int k = 0; k < shape.n_coefficients(); ++k)
        x[2 + k] = shape.coefficients[static_cast<std::size_t>(k)];
    ceres::TinySolver<Cost> solver;
    solver.options.max_num_iterations = 12;
    solver.options.parameter_tolerance = 1e-4;
    solver.options.function_tolerance = 1e-3;
    solver.Solve(cost, &x);
    EllipsoidFit fit;
    fit.iterations = solver.summary.iterations;
    fit.usable = x.allFinite() && std::isfinite(solver.summary.final_cost);
    if (!fit.usable)
        return fit;
    fit.shape = cost.shape_at(x.data());
    fit.uncertainty = radius_deviation(cost, fit.shape, x, hits.size());
    return fit;
}

}  // namespace scree::vision
