#include "tools/anatomy/anatomy_knee_joint.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace articular::anatomy {
namespace {

constexpr double kRound = 0.7;  // outline of a plateau: 0 rectangle, 1 ellipse

/// (y, z) of the normal with the angle phi.
Vec2 radial(double phi) { return {std::sin(phi), -std::cos(phi)}; }

Vec2 distal_center(const Compartment& c) { return {0, c.distal_radius}; }
Vec2 posterior_center(const Compartment& c) {
  return distal_center(c) + (c.distal_radius - c.posterior_radius) * radial(c.transition);
}

/// The arc to which the angle phi belongs.
struct Arc {
  Vec2 center;
  double radius;
};
Arc arc_at(const Compartment& c, double phi) {
  if (phi < c.transition) return {distal_center(c), c.distal_radius};
  return {posterior_center(c), c.posterior_radius};
}

/// Up to a constant: it is 0 in the middle of the compartment.
double plateau_shape(const Compartment& c, double x, double y) {
  const double inward = std::max(kCompartmentX - c.side * x, 0.0);
  return inward * inward / (2 * c.eminence_radius) + c.sagittal_curvature * y * y / 2 -
         std::tan(kPlateauSlopeDeg * kDeg) * y;
}

/// Height of the plateau's middle that leaves kJointGap below the condyle.
double plateau_level(const Compartment& c) {
  constexpr int kSteps = 200;
  double least = kNoSurface;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const Vec2 p = plateau_point(c, 2.0 * i / kSteps - 1, 2.0 * j / kSteps - 1);
      least = std::min(least,
                       condyle_height(c, p.x(), p.y(), kJointGap) - plateau_shape(c, p.x(), p.y()));
    }
  return least;
}

}  // namespace

const Compartment& medial_compartment() {
  static const Compartment medial{.side = 1,
                                  .distal_radius = 38.6,
                                  .posterior_radius = 22.9,
                                  .transition = 30 * kDeg,
                                  .coronal_radius = 22.5,
                                  .coronal_angle = 36 * kDeg,
                                  .femoral_thickness = 2.5,
                                  .half_width = 14.5,
                                  .half_depth = 24,
                                  .sagittal_curvature = 1.0 / 150,
                                  .eminence_radius = 53,
                                  .tibial_thickness = 2.23,
                                  .rim_width = 14.5,
                                  .rim_depth = 23,
                                  .horn_angle = 130 * kDeg,
                                  .straight_front = 90 * kDeg,
                                  .straight_back = 92 * kDeg,
                                  .front_width = 10.5,
                                  .middle_width = 7.8,
                                  .back_width = 13.9,
                                  .front_height = 6.3,
                                  .middle_height = 5.2,
                                  .back_height = 6.9};
  return medial;
}

const Compartment& lateral_compartment() {
  static const Compartment lateral{.side = -1,
                                   .distal_radius = 35.8,
                                   .posterior_radius = 21.3,
                                   .transition = 15 * kDeg,
                                   .coronal_radius = 16.4,
                                   .coronal_angle = 48 * kDeg,
                                   .femoral_thickness = 2.58,
                                   .half_width = 14.3,
                                   .half_depth = 18.5,
                                   .sagittal_curvature = -1.0 / 37.5,
                                   .eminence_radius = 41,
                                   .tibial_thickness = 2.86,
                                   .rim_width = 14.3,
                                   .rim_depth = 17.5,
                                   .horn_angle = 130 * kDeg,
                                   .straight_front = 93 * kDeg,
                                   .straight_back = 107 * kDeg,
                                   .front_width = 11.8,
                                   .middle_width = 8.6,
                                   .back_width = 12,
                                   .front_height = 4.8,
                                   .middle_height = 6.4,
                                   .back_height = 7};
  return lateral;
}

double profile_length(const Compartment& c, double phi) {
  return c.distal_radius * std::min(phi, c.transition) +
         c.posterior_radius * std::max(phi - c.transition, 0.0);
}

double profile_angle(const Compartment& c, double length) {
  const double to_transition = c.distal_radius * c.transition;
  return std::min(length, to_transition) / c.distal_radius +
         std::max(length - to_transition, 0.0) / c.posterior_radius;
}

Vec3 condyle_point(const Compartment& c, double phi, double alpha, double depth) {
  const Arc arc = arc_at(c, phi);
  const double tube = c.coronal_radius - depth;
  const Vec2 p =
      arc.center + (arc.radius - c.coronal_radius + tube * std::cos(alpha)) * radial(phi);
  return {c.side * kCompartmentX + tube * std::sin(alpha), p.x(), p.y()};
}

CondylePlace condyle_place(const Compartment& c, const Vec3& p) {
  const auto angle = [&](const Arc& arc) {
    const Vec2 d = p.tail<2>() - arc.center;
    return std::atan2(d.x(), -d.y());
  };
  double phi = angle(arc_at(c, c.transition));
  // The front of the condyle ends at phi = -135 degrees, its back goes on to there.
  const bool above_front = phi < -135 * kDeg;
  if (phi < c.transition && !above_front) phi = std::min(angle(arc_at(c, -1)), c.transition - 1e-9);
  if (above_front) phi += 2 * std::numbers::pi;
  const Arc arc = arc_at(c, phi);
  const double across = p.x() - c.side * kCompartmentX;
  const double out = (p.tail<2>() - arc.center).norm() - (arc.radius - c.coronal_radius);
  const double distance = (out > 0 ? std::hypot(across, out) : std::abs(across)) - c.coronal_radius;
  return {distance, phi, std::atan2(across, std::max(out, 0.0))};
}

double condyle_height(const Compartment& c, double x, double y, double clearance) {
  const double tube = c.coronal_radius + clearance;
  const double across = x - c.side * kCompartmentX;
  if (std::abs(across) >= 0.99 * tube) return kNoSurface;
  const double rounding = c.coronal_radius - std::sqrt(tube * tube - across * across);
  for (const double phi : {-1.0, c.transition}) {
    const Arc arc = arc_at(c, phi);
    const double radius = arc.radius - rounding, forth = y - arc.center.x();
    if (std::abs(forth) >= 0.99 * radius) continue;
    const bool posterior = std::asin(forth / radius) >= c.transition;
    if (posterior == (phi >= c.transition))
      return arc.center.y() - std::sqrt(radius * radius - forth * forth);
  }
  return kNoSurface;
}

double plateau_height(const Compartment& c, double x, double y) {
  static const double medial = plateau_level(medial_compartment());
  static const double lateral = plateau_level(lateral_compartment());
  return (c.side > 0 ? medial : lateral) + plateau_shape(c, x, y);
}

Vec3 plateau_normal(const Compartment& c, double x, double y) {
  constexpr double kStep = 1e-4;
  return Vec3(-(plateau_shape(c, x + kStep, y) - plateau_shape(c, x - kStep, y)),
              -(plateau_shape(c, x, y + kStep) - plateau_shape(c, x, y - kStep)), 2 * kStep)
      .normalized();
}

Vec2 plateau_point(const Compartment& c, double u, double v) {
  return {c.side * kCompartmentX + c.half_width * u * std::sqrt(1 - kRound * v * v / 2),
          c.half_depth * v * std::sqrt(1 - kRound * u * u / 2)};
}

Vec2 plateau_place(const Compartment& c, double x, double y) {
  const double a = (x - c.side * kCompartmentX) / c.half_width, b = y / c.half_depth;
  constexpr double kFarthest = 1.3;  // where the outline's map is not degenerate yet
  double u = a, v = b;
  for (int k = 0; k < 20; ++k) {  // converges by a half and better inside the outline
    const double bounded_v = std::clamp(v, -kFarthest, kFarthest);
    u = a / std::sqrt(1 - kRound * bounded_v * bounded_v / 2);
    const double bounded_u = std::clamp(u, -kFarthest, kFarthest);
    v = b / std::sqrt(1 - kRound * bounded_u * bounded_u / 2);
  }
  return {u, v};
}

double rim_taper(double u, double v) {
  constexpr double kLost = 0.3, kFull = 0.5;  // of the thickness at the rim; where it begins
  const auto one = [](double t) {
    const double s = std::clamp((std::abs(t) - kFull) / (1 - kFull), 0.0, 1.0);
    return 1 - kLost * s * s * (3 - 2 * s);
  };
  return one(u) * one(v);
}

}  // namespace articular::anatomy
