#include <cmath>
#include <sstream>
#include <stdexcept>

#include "fem/material/active_fibre.hpp"
#include "fem/material/muscle_fibre.hpp"
#include "fem/material/toe_linear_fibre.hpp"

namespace articular::fem {
namespace {

/// An exponential of more than this is not far from the largest number of a double (exp(709)).
constexpr double kLargestExponent = 700;  // [-]

void check_below(double value, const char* name, double limit) {
  if (value < limit) return;
  std::ostringstream message;
  message << name << " is " << value << ", must be below " << limit;
  throw std::invalid_argument(message.str());
}

void check_at_least_one(double value, const char* name, bool one_allowed) {
  if (std::isfinite(value) && (one_allowed ? value >= 1 : value > 1)) return;
  std::ostringstream message;
  message << name << " is " << value << ", must be finite and "
          << (one_allowed ? "at least" : "above") << " 1";
  throw std::invalid_argument(message.str());
}

}  // namespace

ToeLinearFibre::ToeLinearFibre(const Constants& c) : c_(c) {
  checked_positive(c.c3, "c3", "Pa");
  checked_positive(c.c4, "c4", "(no unit)");
  checked_positive(c.c5, "c5", "Pa");
  check_at_least_one(c.toe_end, "stretch at the end of the toe", false);
  check_below(c.c4 * c.toe_end, "c4 times the stretch at the end of the toe", kLargestExponent);
  c6_ = c.c3 * std::expm1(c.c4 * (c.toe_end - 1)) - c.c5 * c.toe_end;
}

double ToeLinearFibre::energy(double stretch, double /*activation*/) const {
  if (stretch <= 1) return 0;
  if (stretch < c_.toe_end) return toe_energy(stretch);
  return toe_energy(c_.toe_end) + c_.c5 * (stretch - c_.toe_end) +
         c6_ * std::log(stretch / c_.toe_end);
}

double ToeLinearFibre::tension(double stretch, double /*activation*/) const {
  return cauchy_stress(stretch) / stretch;
}

double ToeLinearFibre::stiffness(double stretch, double activation) const {
  return (stress_slope(stretch) - tension(stretch, activation)) / stretch;
}

double ToeLinearFibre::cauchy_stress(double stretch) const {
  if (stretch <= 1) return 0;
  if (stretch < c_.toe_end) return c_.c3 * std::expm1(c_.c4 * (stretch - 1));
  return c_.c5 * stretch + c6_;
}

double ToeLinearFibre::stress_slope(double stretch) const {
  if (stretch <= 1) return 0;
  if (stretch < c_.toe_end) return c_.c3 * c_.c4 * std::exp(c_.c4 * (stretch - 1));
  return c_.c5;
}

double ToeLinearFibre::toe_energy(double stretch) const {
  const double difference = std::expint(c_.c4 * stretch) - std::expint(c_.c4);
  return c_.c3 * (std::exp(-c_.c4) * difference - std::log(stretch));
}

ActiveFibre::ActiveFibre(const Constants& c) : c_(c) {
  checked_not_negative(c.stress, "active stress", "Pa");
}

double ActiveFibre::energy(double stretch, double activation) const {
  const double work = c_.force_length ? c_.force_length->work(stretch) : stretch;
  return activation * c_.stress * work;
}

double ActiveFibre::tension(double stretch, double activation) const {
  const double factor = c_.force_length ? c_.force_length->factor(stretch) / stretch : 1;
  return activation * c_.stress * factor;
}

double ActiveFibre::stiffness(double stretch, double activation) const {
  if (!c_.force_length) return 0;
  const double slope = activation * c_.stress * c_.force_length->slope(stretch);
  return (slope - tension(stretch, activation)) / stretch;
}

MuscleFibre::MuscleFibre(const Constants& c) : c_(c) {
  checked_positive(c.max_stress, "largest active stress", "Pa");
  checked_positive(c.p1, "P1", "(no unit)");
  checked_positive(c.p2, "P2", "(no unit)");
  check_at_least_one(c.toe_end, "length at the end of the toe", false);
  check_at_least_one(c.optimal_stretch, "stretch of the largest active force", true);
  check_below(c.p2 * (c.toe_end - 1), "P2 times the strain at the end of the toe",
              kLargestExponent);
  checked_not_negative(c.tendon_ratio, "tendon ratio", "(no unit)");
  check_below(c.tendon_ratio, "tendon ratio", 1);
  if (c.max_velocity) checked_positive(*c.max_velocity, "largest speed of shortening", "1/s");
  end_slope_ = c.p1 * c.p2 * std::exp(c.p2 * (c.toe_end - 1));
}

double MuscleFibre::relative_length(double stretch) const {
  return (stretch / c_.optimal_stretch - c_.tendon_ratio) / (1 - c_.tendon_ratio);
}

double MuscleFibre::active_length(double n) const {
  return c_.descending_limb ? n : std::fmin(n, 1);
}

double MuscleFibre::energy(double stretch, double activation) const {
  const double n = relative_length(stretch);
  const double on_curve = active_length(n);
  return c_.max_stress * (1 - c_.tendon_ratio) *
         (passive_integral(n) + activation * (active_integral(on_curve) + (n - on_curve)));
}

double MuscleFibre::tension(double stretch, double activation) const {
  const double n = relative_length(stretch);
  return c_.max_stress / c_.optimal_stretch * (passive(n) + activation * active(active_length(n)));
}

double MuscleFibre::stiffness(double stretch, double activation) const {
  const double n = relative_length(stretch), per_stretch = 1 / c_.optimal_stretch;
  return c_.max_stress * per_stretch * per_stretch / (1 - c_.tendon_ratio) *
         (passive_slope(n) + activation * active_slope(active_length(n)));
}

MuscleFibre::Drag MuscleFibre::drag(double stretch, double activation) const {
  if (!c_.max_velocity) return {};
  return {c_.max_stress / c_.optimal_stretch * activation *
              active(active_length(relative_length(stretch))),
          1 / (c_.optimal_stretch * (1 - c_.tendon_ratio) * *c_.max_velocity)};
}

double MuscleFibre::active(double n) {
  if (n < 0.4 || n > 1.6) return 0;
  if (n < 0.6) return 9 * (n - 0.4) * (n - 0.4);
  return n < 1.4 ? 1 - 4 * (1 - n) * (1 - n) : 9 * (n - 1.6) * (n - 1.6);
}

double MuscleFibre::active_slope(double n) {
  if (n < 0.4 || n > 1.6) return 0;
  if (n < 0.6) return 18 * (n - 0.4);
  return n < 1.4 ? 8 * (1 - n) : 18 * (n - 1.6);
}

double MuscleFibre::active_integral(double n) {
  const auto cube = [](double v) { return v * v * v; };
  constexpr double kFoot = 0.024;                  // 3 · 0.2³, of either foot
  constexpr double kHump = 0.8 - 8.0 / 3 * 0.064;  // from 0.6 to 1.4
  if (n < 0.4) return 0;
  if (n < 0.6) return 3 * cube(n - 0.4);
  if (n < 1.4) return kFoot + (n - 0.6) - 4.0 / 3 * (cube(n - 1) + 0.064);
  return 2 * kFoot + kHump + (n < 1.6 ? 3 * cube(n - 1.6) : 0);
}

double MuscleFibre::passive(double n) const {
  if (n <= 1) return 0;
  if (n < c_.toe_end) return c_.p1 * std::expm1(c_.p2 * (n - 1));
  return c_.p1 * std::expm1(c_.p2 * (c_.toe_end - 1)) + end_slope_ * (n - c_.toe_end);
}

double MuscleFibre::passive_slope(double n) const {
  if (n <= 1) return 0;
  return n < c_.toe_end ? c_.p1 * c_.p2 * std::exp(c_.p2 * (n - 1)) : end_slope_;
}

double MuscleFibre::passive_integral(double n) const {
  if (n <= 1) return 0;
  const double toe = std::fmin(n, c_.toe_end) - 1, beyond = std::fmax(n - c_.toe_end, 0);
  return c_.p1 * (std::expm1(c_.p2 * toe) / c_.p2 - toe) +
         beyond * (c_.p1 * std::expm1(c_.p2 * toe) + 0.5 * end_slope_ * beyond);
}

}  // namespace articular::fem
