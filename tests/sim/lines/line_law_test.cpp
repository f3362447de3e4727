// The laws of muscle_law.hpp and ligament_law.hpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "sim/lines/ligament_law.hpp"
#include "sim/lines/muscle_law.hpp"

namespace articular::sim::line_law_test {

struct Law {
  const char* name;
  std::function<ValueSlope(double)> at;
  double low, high;                      // range to be tested
  std::vector<double> kinks;             // of the slope
  std::function<double(double)> energy;  // ∫ value, where there is one
};

constexpr double kLength = 0.08;  // optimal or slack [m]
constexpr auto kCosine = Muscle::ForceLengthCurve::Cosine;
constexpr auto kParabola = Muscle::ForceLengthCurve::Parabola;

/// Length of a muscle of tendon ratio r whose fibres are n times their optimum [m].
double line_length(double n, double r) { return kLength * (r + n * (1 - r)); }

std::vector<Law> laws() {
  return {
      {"cosine",
       [](double l) { return active_force_length(kCosine, l, kLength, 0.3); },
       0.02,
       0.16,
       {},
       {}},
      {"parabola",
       [](double l) { return active_force_length(kParabola, l, kLength, 0.3); },
       0.02,
       0.16,
       {line_length(0.6, 0.3), line_length(1.4, 0.3)},
       {}},
      {"passive",
       [](double l) { return passive_force_length(l, kLength, 1.4); },
       0.04,
       0.16,
       {kLength, 1.4 * kLength},
       [](double l) { return passive_energy_length(l, kLength, 1.4); }},
      {"velocity", force_velocity, -1.5, 1.5, {-1}, {}},
      {"linear",
       [](double l) { return linear_ligament(l, kLength, 3e4); },
       0.04,
       0.12,
       {kLength},
       [](double l) { return linear_ligament_energy(l, kLength, 3e4); }},
      {"blankevoort",
       [](double l) { return blankevoort_ligament(l, kLength, 2e3, 0.03); },
       0.04,
       0.12,
       {},
       [](double l) { return blankevoort_ligament_energy(l, kLength, 2e3, 0.03); }},
  };
}

std::vector<double> sample(const Law& law) {
  std::vector<double> points;
  for (int i = 0; i <= 200; ++i) {
    const double x = law.low + (law.high - law.low) * (i + 0.123) / 200;
    const double near = 1e-3 * (law.high - law.low);
    if (std::none_of(law.kinks.begin(), law.kinks.end(),
                     [&](double kink) { return std::abs(x - kink) < near; }))
      points.push_back(x);
  }
  return points;
}

double largest(const Law& law, double ValueSlope::*what) {
  double result = 0;
  for (const double x : sample(law)) result = std::max(result, std::abs(law.at(x).*what));
  return result;
}

/// Smallest difference of a derivative and the central differences of `f`.
double derivative_error(const std::function<double(double)>& f, double x, double derivative,
                        double scale) {
  double best = std::numeric_limits<double>::infinity();
  for (const double h : {1e-4 * scale, 1e-5 * scale, 1e-6 * scale})
    best = std::min(best, std::abs((f(x + h) - f(x - h)) / (2 * h) - derivative));
  return best;
}

TEST(LineLaws, SlopeIsTheDerivativeOfTheValue) {
  for (const Law& law : laws())
    for (const double x : sample(law))
      EXPECT_LT(derivative_error([&](double at) { return law.at(at).value; }, x, law.at(x).slope,
                                 law.high - law.low),
                1e-7 * largest(law, &ValueSlope::slope))
          << law.name << " at " << x;
}

TEST(LineLaws, ValuesHaveNoJumps) {
  for (const Law& law : laws()) {
    const double step = 1e-6 * (law.high - law.low);
    const double limit = 1.1 * step * largest(law, &ValueSlope::slope);
    for (int k = 0; k < 1004; ++k) {
      const double x = law.low + k * 997 * step;
      EXPECT_LE(std::abs(law.at(x + step).value - law.at(x).value), limit)
          << law.name << " at " << x;
    }
    for (const double kink : law.kinks)
      EXPECT_LE(std::abs(law.at(kink + step).value - law.at(kink - step).value), 2 * limit)
          << law.name << " at " << kink;
  }
}

TEST(LineLaws, EnergyIsTheIntegralOfTheForce) {
  for (const Law& law : laws()) {
    if (!law.energy) continue;
    EXPECT_EQ(law.energy(law.low), 0);
    for (const double x : sample(law))
      EXPECT_LT(derivative_error(law.energy, x, law.at(x).value, law.high - law.low),
                1e-7 * largest(law, &ValueSlope::value))
          << law.name << " at " << x;
  }
}

TEST(MuscleLaw, ActiveForceIsFullAtTheOptimalLengthAndNoneHalfAFibreAway) {
  const double r = 0.3;
  const auto factor = [&](double n) {
    return active_force_length(kCosine, line_length(n, r), kLength, r).value;
  };
  EXPECT_DOUBLE_EQ(factor(1), 1);
  EXPECT_NEAR(factor(1.25), 0.5, 1e-12);
  EXPECT_EQ(factor(0.49), 0);
  EXPECT_EQ(factor(1.51), 0);
}

// Slow human fibres were measured [Gollapudi, Lin 2009, J Biomech 42:2011]: full force around
// sarcomeres of 2.64 to 2.81 um, which fits 0.42/um shorter and 0.52/um longer than that. Where
// these lines hold, a parabola is within 0.07 of them. The cosine is up to 0.28 below them.
TEST(MuscleLaw, TheParabolaFollowsMeasuredHumanFibresAndTheCosineDoesNot) {
  const double r = 0.3, optimum = 2.7;  // [um]
  const auto largest_error = [&](Muscle::ForceLengthCurve curve) {
    double error = 0;
    for (double sarcomere = 2.0; sarcomere < 3.51; sarcomere += 0.05) {
      const double measured =
          1 - 0.42 * std::max(0.0, 2.64 - sarcomere) - 0.52 * std::max(0.0, sarcomere - 2.81);
      const double ours =
          active_force_length(curve, line_length(sarcomere / optimum, r), kLength, r).value;
      error = std::max(error, std::abs(ours - measured));
    }
    return error;
  };
  EXPECT_LT(largest_error(kParabola), 0.07);
  EXPECT_GT(largest_error(kCosine), 0.28);
}

// Hill: (P + a)(v + b) = (P0 + a) b with a/P0 = b/vmax = 1/4. At half load v = vmax/6.
TEST(MuscleLaw, ShorteningFollowsHillsHyperbola) {
  EXPECT_NEAR(force_velocity(-1.0 / 6).value, 0.5, 1e-15);
  for (const double v : {0.0, 0.1, 0.3, 0.7, 1.0})
    EXPECT_NEAR((force_velocity(-v).value + 0.25) * (v + 0.25), 1.25 * 0.25, 1e-15);
  EXPECT_EQ(force_velocity(-2).value, 0);
}

TEST(MuscleLaw, LengtheningRisesToOnePointFourWithTheSameSlopeAtRest) {
  EXPECT_NEAR(force_velocity(1e9).value, 1.4, 1e-9);
  EXPECT_NEAR(force_velocity(1e-12).slope, force_velocity(-1e-12).slope, 1e-9);
}

// On the curve it is its slope. Beside it, the curve as a function G of w and the factor, which is
// linear in each, does not change along it to first order.
TEST(MuscleLaw, TheSlopeForNewtonsIterationIsThatOfTheCurveAsAnEquation) {
  constexpr double h = 1e-6;
  const auto equation = [](double w, double f) {
    return w <= 0 ? f * (1 - 4 * w) - (1 + w) : f * (1 + 12.5 * w) - (1 + 17.5 * w);
  };
  for (const double w : {-3.0, -0.9, -0.3, 0.2, 5.0})
    for (const double factor : {0.1, 0.7, 1.3}) {
      const double slope = fem::force_velocity_slope(w, factor);
      EXPECT_GT(slope, 0);
      EXPECT_NEAR(equation(w + h, factor + h * slope), equation(w - h, factor - h * slope), 1e-9);
    }
  for (const double w : {-0.9, -0.3, 0.0, 0.2, 5.0}) {
    const ValueSlope on = force_velocity(w);
    EXPECT_NEAR(fem::force_velocity_slope(w, on.value), on.slope, 1e-12 * on.slope);
  }
  EXPECT_EQ(fem::force_velocity_slope(-3, 0), 0);  // fibres that are too fast to pull
}

// Beyond twice the toe strain the force is k (e − e_l) and the stiffness is that of the linear
// part.
TEST(LigamentLaw, BlankevoortsToeEndsInALineShiftedByTheToeStrain) {
  const double k = 2e3, toe = 0.03;
  const ValueSlope end = blankevoort_ligament(kLength * (1 + 2 * toe), kLength, k, toe);
  EXPECT_NEAR(end.value, k * toe, 1e-9);
  EXPECT_NEAR(end.slope, k / kLength, 1e-9 * k / kLength);
  EXPECT_NEAR(blankevoort_ligament(1.1 * kLength, kLength, k, toe).value, k * 0.07, 1e-9);
}

// A force that jumps leaves an implicit step without an end: here it grows from zero.
TEST(LigamentLaw, TheDamperSetsInWithTheTensionAndNeverExceedsIt) {
  const double k = 2.5e5, c = 50, rate = 0.1, l = kLength + c * rate / k;  // there both are 5 N
  for (const double stretch : {0.0, 1e-9, 0.3, 0.999}) {
    const ValueSlope elastic = linear_ligament(kLength + stretch * (l - kLength), kLength, k);
    const Damper damper = ligament_damper(elastic, rate, c);
    EXPECT_EQ(damper.force, elastic.value);
    EXPECT_EQ(damper.by_length, elastic.slope);
    EXPECT_EQ(damper.by_rate, 0);
  }
  const Damper beyond = ligament_damper(linear_ligament(l + 1e-6, kLength, k), rate, c);
  EXPECT_EQ(beyond.force, c * rate);
  EXPECT_EQ(beyond.by_length, 0);
  EXPECT_EQ(beyond.by_rate, c);
  EXPECT_EQ(ligament_damper(linear_ligament(2 * l, kLength, k), -rate, c).force, 0);
}

TEST(LigamentLaw, ASlackLigamentNeitherPullsNorStores) {
  for (const double l : {0.5 * kLength, kLength}) {
    EXPECT_EQ(linear_ligament(l, kLength, 1e4).value, 0);
    EXPECT_EQ(linear_ligament_energy(l, kLength, 1e4), 0);
    EXPECT_EQ(blankevoort_ligament(l, kLength, 1e4, 0.03).value, 0);
    EXPECT_EQ(blankevoort_ligament_energy(l, kLength, 1e4, 0.03), 0);
  }
}

}  // namespace articular::sim::line_law_test
