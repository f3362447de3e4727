#include "tools/anatomy/anatomy_trochlea.hpp"

#include <algorithm>
#include <cmath>

#include "tools/anatomy/anatomy_layer.hpp"

namespace articular::anatomy {
namespace {

/// Between these the valley, beyond them the condyles.
constexpr double kLateralEdge = -18, kMedialEdge = 15;
/// The lateral ridge rises by kRise over the condyle, from kRiseBeginDeg to kRiseEndDeg.
constexpr double kRise = 3.2, kRiseBeginDeg = -45, kRiseEndDeg = -75;
/// Half the width of the cartilage at its top and at its end.
constexpr double kTopWidth = 21, kEndWidth = 27;
/// Between the condyles it goes on to the notch.
constexpr double kTongueDeg = 19.5, kTongueWidth = 11;
constexpr double kTopRoundDeg = 8;  // its upper corners are lower

double eased(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// How far the rounded condyle lies inside its radius, and its slope.
struct Drop {
  double value, slope;
};
Drop condyle_drop(const Compartment& c, double x) {
  const double across = x - c.side * kCompartmentX;
  const double height = std::sqrt(c.coronal_radius * c.coronal_radius - across * across);
  return {c.coronal_radius - height, across / height};
}

/// The valley is the cubic that goes on from both condyles with their slopes.
double drop(double x) {
  if (x >= kMedialEdge) return condyle_drop(medial_compartment(), x).value;
  if (x <= kLateralEdge) return condyle_drop(lateral_compartment(), x).value;
  const Drop a = condyle_drop(lateral_compartment(), kLateralEdge),
             b = condyle_drop(medial_compartment(), kMedialEdge);
  const double width = kMedialEdge - kLateralEdge, t = (x - kLateralEdge) / width;
  return a.value + (b.value - a.value) * eased(t) +
         width * t * (1 - t) * (a.slope * (1 - t) - b.slope * t);
}

/// Height of the axis.
double axis_height(double x) {
  const double low = lateral_compartment().distal_radius, high = medial_compartment().distal_radius;
  return low + (high - low) * eased((x - kLateralEdge) / (kMedialEdge - kLateralEdge));
}

double slope_across(double x, double phi) {
  constexpr double kStep = 1e-4;
  return (trochlea_radius(x + kStep, phi) - trochlea_radius(x - kStep, phi)) / (2 * kStep);
}

double top_angle(double u) { return (kTrochleaTopDeg + kTopRoundDeg * std::pow(u, 4)) * kDeg; }

double end_angle(double x) {
  const double t = std::min(std::abs(x) / kTongueWidth, 1.0);
  return (kTrochleaEndDeg + kTongueDeg * (1 - eased(t))) * kDeg;
}

double half_width(double v) { return kTopWidth + (kEndWidth - kTopWidth) * (v + 1) / 2; }

Mesh layer(const CellGrid& grid, double full) {
  return grid.fill([&](double u, double v, double w) {
    const double x = half_width(v) * u;
    const double top = top_angle(u), phi = top + (end_angle(x) - top) * (v + 1) / 2;
    return trochlea_point(x, phi, (1 - w) * full * rim_taper(u, v));
  });
}

}  // namespace

double trochlea_radius(double x, double phi) {
  const double up = eased((phi / kDeg - kRiseBeginDeg) / (kRiseEndDeg - kRiseBeginDeg));
  return axis_height(x) - drop(x) + kRise * up * eased(x / kLateralEdge);
}

Vec3 trochlea_point(double x, double phi, double depth) {
  const double radius = trochlea_radius(x, phi) - depth * std::hypot(1, slope_across(x, phi));
  return {x, radius * std::sin(phi), axis_height(x) - radius * std::cos(phi)};
}

TrochleaPlace trochlea_place(const Vec3& p) {
  constexpr double kWidest = 34;  // beyond it the lateral condyle has no surface
  const double x = std::clamp(p.x(), -kWidest, kWidest);
  const double below = axis_height(x) - p.z();
  const double phi = std::atan2(p.y(), below);
  const double out =
      (std::hypot(p.y(), below) - trochlea_radius(x, phi)) / std::hypot(1, slope_across(x, phi));
  double u = 0, v = 0;
  for (int k = 0; k < 10; ++k) {
    u = p.x() / half_width(std::clamp(v, -1.3, 1.3));
    const double top = top_angle(std::clamp(u, -1.0, 1.0));
    v = 2 * (phi - top) / (end_angle(x) - top) - 1;
  }
  return {out, u, v};
}

double trochlear_full_thickness(double mean) { return full_thickness(mean, layer); }

Mesh trochlear_cartilage(double mean, const KneeResolution& resolution) {
  check_resolution(resolution);
  const double h = resolution.size_mm, radius = trochlea_radius(0, kTrochleaEndDeg * kDeg);
  const double length = radius * (kTrochleaEndDeg - kTrochleaTopDeg) * kDeg;
  const CellGrid grid{even_cells(kTopWidth + kEndWidth, h, 4), even_cells(length, h, 4),
                      resolution.layers};
  return layer(grid, trochlear_full_thickness(mean));
}

}  // namespace articular::anatomy
