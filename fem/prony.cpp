#include "fem/prony.hpp"

#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "fem/material.hpp"

namespace articular::fem {
namespace {

/// The mean of exp(−t/τ) over a step.
double mean_decay(double dt, double time) {
  const double x = dt / time;
  return x > 0 ? -std::expm1(-x) / x : 1;
}

}  // namespace

PronySeries::PronySeries(std::vector<PronyTerm> terms) : terms_(std::move(terms)) {
  double sum = 0;
  for (const PronyTerm& term : terms_) {
    checked_positive(term.time, "relaxation time", "s");
    sum += checked_positive(term.weight, "weight of a relaxation time", "(no unit)");
  }
  equilibrium_ = 1 - sum;
  if (sum < 1) return;
  std::ostringstream message;
  message << "weights of the relaxation times sum up to " << sum
          << ", must be below 1: nothing would be left of the stress";
  throw std::invalid_argument(message.str());
}

double PronySeries::instantaneous_fraction(double dt) const {
  double fraction = equilibrium_;
  for (const auto& [weight, time] : terms_) fraction += weight * mean_decay(dt, time);
  return fraction;
}

Mat3 PronySeries::memory(std::span<const Mat3> h, const Mat3& S0, double dt) const {
  assert(h.size() == terms_.size());
  Mat3 result = Mat3::Zero();
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const auto& [weight, time] = terms_[i];
    result += std::exp(-dt / time) * h[i] - weight * mean_decay(dt, time) * S0;
  }
  return result;
}

void PronySeries::advance(const Mat3& S0, const Mat3& S0_next, double dt, std::span<Mat3> h) const {
  assert(h.size() == terms_.size());
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const auto& [weight, time] = terms_[i];
    h[i] = std::exp(-dt / time) * h[i] + weight * mean_decay(dt, time) * (S0_next - S0);
  }
}

}  // namespace articular::fem
