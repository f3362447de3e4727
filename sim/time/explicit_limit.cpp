#include "sim/time/explicit_limit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "sim/model/newton_weights.hpp"

namespace articular::sim {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The smallest length that the forces know [m]: a part of it is moved to see how they change.
double least_length(const Model& model) {
  double length = model.trusted_motion;
  if (!std::isfinite(length))
    for (int r = 0; r < model.layout.num_rigid; ++r)
      length = std::min(length, turning_radius(model.rigid_bodies[static_cast<std::size_t>(r)]));
  return length;
}

/// S ∂rate/∂y S⁻¹ over positions and velocities. S makes them comparable, so that what swings is
/// nearly a turn: √m for velocities, ω√m for positions, of the largest ω roughly.
class ScaledRate {
 public:
  ScaledRate(const Model& model, Dynamics& dynamics, const VectorXd& y, double t)
      : dynamics_(dynamics),
        layout_(model.layout),
        y_(y),
        t_(t),
        motion_(kMoved * least_length(model)),
        scale_(VectorXd::Zero(layout_.activations())) {
    for (int block = 0; block < layout_.num_free_nodes; ++block)
      set_scale(layout_.node_x(block), 3, block, std::sqrt(model.node_mass[block]));
    for (int r = 0; r < layout_.num_rigid; ++r) {
      const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(r)];
      const double root = std::sqrt(rigid.mass.mass), turned = root * turning_radius(rigid);
      set_scale(layout_.rigid_p(r), 3, rigid.block, root);
      set_scale(layout_.rigid_q(r), 4, rigid.block + 1, turned);
      scale_.segment<4>(layout_.rigid_q(r)) *= 2;  // q̇ = ½ ω q
    }
    estimate_frequency();
  }

  Eigen::Index size() const { return scale_.size(); }

  VectorXd product(const VectorXd& u) {
    const VectorXd way = u.cwiseQuotient(scale_);
    const auto positions = way.head(layout_.velocities());
    const auto velocities = way.tail(size() - layout_.velocities());
    const double farthest = std::max(positions.lpNorm<Eigen::Infinity>(),
                                     velocities.lpNorm<Eigen::Infinity>() / frequency_);
    const double part = motion_ / farthest;
    const VectorXd difference = (rate_at(part * way) - rate_at(-part * way)) / (2 * part);
    return difference.cwiseProduct(scale_);
  }

 private:
  static constexpr double kMoved = 1e-6;  // of the length; the error of a central difference: its ²

  void set_scale(int position, int count, int block, double root) {
    scale_.segment(position, count).setConstant(root);
    scale_.segment<3>(layout_.velocities() + 3 * block).setConstant(root);
  }

  VectorXd rate_at(const VectorXd& way) {
    VectorXd y = y_, y_dot(y_.size());
    y.head(size()) += way;
    dynamics_.evaluate(y.data(), t_);
    dynamics_.rate(y.data(), y_dot.data());
    return y_dot.head(size());
  }

  /// A few power iterations for ω²: accelerations by displacements.
  void estimate_frequency() {
    constexpr int kIterations = 5;
    std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same each time
    std::uniform_real_distribution<double> uniform(-1, 1);
    VectorXd u = VectorXd::NullaryExpr(size(), [&] { return uniform(random); });
    const Eigen::Index num = size() - layout_.velocities();
    for (int k = 0; k < kIterations; ++k) {
      u.tail(num).setZero();
      const VectorXd acceleration = product(u.normalized());
      const double next = std::sqrt(acceleration.tail(num).norm());
      if (!(next > 0) || !std::isfinite(next)) break;
      frequency_ = next;
      u.setZero();
      to_positions(acceleration, u);
    }
    scale_.head(layout_.velocities()) *= frequency_;
  }

  /// Moves everything along its acceleration.
  void to_positions(const VectorXd& rate, VectorXd& u) const {
    const int v = layout_.velocities();
    u.head(3 * layout_.num_free_nodes) = rate.segment(v, 3 * layout_.num_free_nodes);
    for (int r = 0; r < layout_.num_rigid; ++r) {
      const int block = v + 3 * (layout_.num_free_nodes + 2 * r);
      u.segment<3>(layout_.rigid_p(r)) = rate.segment<3>(block);
      // ½ ω q by quaternions: from the pose at the start the vector part.
      u.segment<3>(layout_.rigid_q(r) + 1) = rate.segment<3>(block + 3);
    }
  }

  Dynamics& dynamics_;
  const Layout& layout_;
  const VectorXd& y_;
  const double t_;
  const double motion_;  // [m]
  VectorXd scale_;
  double frequency_ = 1;  // [1/s]
};

/// Eigenvalues of the projection on a Krylov space, with a vector to begin the next one with.
struct RitzValues {
  MotionRates rates;
  VectorXd restart;
};

/// Arnoldi's iteration with two passes of Gram–Schmidt.
class Arnoldi {
 public:
  Arnoldi(ScaledRate& rate, const VectorXd& start)
      : rate_(rate), V_(start.size(), kMost + 1), H_(MatrixXd::Zero(kMost + 1, kMost)) {
    V_.col(0) = start.normalized();
  }

  bool is_full() const { return size_ == kMost; }

  /// @return false where the space holds all that there is
  bool grow() {
    const int j = size_++;
    VectorXd w = rate_.product(V_.col(j));
    const double whole = w.norm();
    for (int pass = 0; pass < 2; ++pass) {
      const VectorXd h = V_.leftCols(j + 1).transpose() * w;
      w -= V_.leftCols(j + 1) * h;
      H_.col(j).head(j + 1) += h;
    }
    const double rest = w.norm();
    if (!(rest > kRoundOff * whole)) return false;
    H_(j + 1, j) = rest;
    V_.col(j + 1) = w / rest;
    return true;
  }

  RitzValues values() const {
    const Eigen::EigenSolver<MatrixXd> eigen(H_.topLeftCorner(size_, size_));
    RitzValues ritz;
    const double rest = H_(size_, size_ - 1);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < size_; ++k) {
      const std::complex<double> rate = eigen.eigenvalues()[k];
      const Eigen::VectorXcd s = eigen.eigenvectors().col(k);
      if (rest * std::abs(s[size_ - 1]) > kSettled * std::abs(rate)) continue;
      ritz.rates.push_back(rate);
      const double step = longest_explicit_step({&rate, 1});
      if (!(step < least)) continue;
      least = step;
      ritz.restart = V_.leftCols(size_) * (s.real() + s.imag());
    }
    if (ritz.rates.empty()) ritz.restart = V_.col(size_);
    return ritz;
  }

 private:
  static constexpr int kMost = 40;            // vectors that are kept
  static constexpr double kSettled = 0.2;     // of a Ritz value, its residual
  static constexpr double kRoundOff = 1e-10;  // of a product: differences lose half of the digits

  ScaledRate& rate_;
  MatrixXd V_, H_;
  int size_ = 0;
};

MotionRates moving_rates(ScaledRate& rate, double accuracy) {
  constexpr int kCheck = 10, kMostProducts = 1000;
  std::mt19937 random(2);  // NOLINT(cert-msc51-cpp): the same each time
  std::uniform_real_distribution<double> uniform(-1, 1);
  auto space = std::make_unique<Arnoldi>(
      rate, VectorXd::NullaryExpr(rate.size(), [&] { return uniform(random); }));
  RitzValues now;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 1; k <= kMostProducts; ++k) {
    const bool more = space->grow();
    if (more && k % kCheck != 0) continue;
    now = space->values();
    const double step = longest_explicit_step(now.rates);
    if (!more || std::abs(step - last) < accuracy * step) break;
    last = step;
    if (space->is_full()) space = std::make_unique<Arnoldi>(rate, now.restart);
  }
  return now.rates;
}

double growth(std::span<const double> c, std::complex<double> z) {
  std::complex<double> sum = 0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * z + c[k];
  return std::abs(sum);
}

/// The first |z| in a direction where a step makes more of something.
double stable_length(std::span<const double> c, std::complex<double> direction) {
  constexpr double kScan = 0.01, kFarthest = 100, kRoundOff = 1e-12;
  const auto grows = [&](double length) { return growth(c, length * direction) > 1 + kRoundOff; };
  double high = kScan;
  while (!grows(high) && high < kFarthest) high += kScan;
  double low = high - kScan;
  while (high - low > kRoundOff * high) {
    const double middle = 0.5 * (low + high);
    (grows(middle) ? high : low) = middle;
  }
  return low;
}

}  // namespace

MotionRates fastest_rates(const Model& model, Dynamics& dynamics, const VectorXd& y, double t,
                          double accuracy) {
  MotionRates rates;
  if (model.layout.num_unknown_blocks() > 0) {
    ScaledRate rate(model, dynamics, y, t);
    rates = moving_rates(rate, accuracy);
  }
  for (const MuscleModel& muscle : model.muscles)
    rates.emplace_back(-1 / std::min(muscle.given.activation_time, muscle.given.deactivation_time));
  for (const Tissue& tissue : model.tissues)
    if (tissue.relaxation)
      for (const fem::PronyTerm& term : tissue.relaxation->terms())
        rates.emplace_back(-1 / term.time);
  dynamics.evaluate(y.data(), t);
  std::sort(rates.begin(), rates.end(),
            [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return rates;
}

double longest_explicit_step(std::span<const std::complex<double>> rates) {
  const std::vector<double> c = explicit_growth();
  double step = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& rate : rates) {
    const double size = std::abs(rate);
    if (!(size > 0)) continue;
    const std::complex<double> direction(std::min(0.0, rate.real()) / size,
                                         std::abs(rate.imag()) / size);
    const double length = std::abs(direction);
    step = std::min(step, length > 0 ? stable_length(c, direction / length) / size : step);
  }
  return step;
}

}  // namespace articular::sim
