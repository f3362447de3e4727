#include <sstream>
#include <stdexcept>

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
  checked_not_negative(c.active_stress, "active stress", "Pa");
  check_at_least_one(c.toe_end, "stretch at the end of the toe", false);
  check_below(c.c4 * c.toe_end, "c4 times the stretch at the end of the toe", kLargestExponent);
  c6_ = c.c3 * std::expm1(c.c4 * (c.toe_end - 1)) - c.c5 * c.toe_end;
}

MuscleFibre::MuscleFibre(const Constants& c) : c_(c) {
  checked_positive(c.max_stress, "largest active stress", "Pa");
  checked_positive(c.p1, "P1", "(no unit)");
  checked_positive(c.p2, "P2", "(no unit)");
  check_at_least_one(c.toe_end, "length at the end of the toe", false);
  check_at_least_one(c.optimal_stretch, "stretch of the largest active force", true);
  check_below(c.p2 * (c.toe_end - 1), "P2 times the strain at the end of the toe",
              kLargestExponent);
  end_slope_ = c.p1 * c.p2 * std::exp(c.p2 * (c.toe_end - 1));
}

}  // namespace articular::fem
