#include "tools/anatomy/anatomy_patella.hpp"

#include <algorithm>
#include <cmath>

#include "tools/anatomy/anatomy_layer.hpp"
#include "tools/anatomy/anatomy_solids.hpp"
#include "tools/anatomy/anatomy_trochlea.hpp"

namespace articular::anatomy {
namespace {

/// Cartilage: middle, half width and half height of its outline.
constexpr double kMiddleZ = 42, kHalfWidth = 20, kHalfHeight = 15.5;
/// Facets: slopes far from the ridge, which is kRidge wide; rounded from top to bottom.
constexpr double kLateralSlope = 0.42, kMedialSlope = 0.44, kRidge = 9, kSagittalRadius = 55;
/// Bone: widest at kWidestZ, from there up, down, to the sides and to the front.
constexpr double kWidestZ = 41, kUp = 18.4, kDown = 26, kSide = 21, kFront = 17.2;
/// The bone's rim lies this far in front of the ridge.
constexpr double kRim = 6.5;

/// How far the facets lie in front of the ridge's middle.
double facet_depth(double x, double z) {
  const double slope = x < 0 ? kLateralSlope : kMedialSlope;
  const double up = z - kMiddleZ;
  return slope * (std::hypot(x, kRidge) - kRidge) + up * up / (2 * kSagittalRadius);
}

/// y of the ridge's middle that leaves kJointGap between the cartilages.
double ridge_back() {
  static const double back = [] {
    constexpr int kSteps = 200;
    double least = kNoSurface;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j <= kSteps; ++j) {
        const double x = kHalfWidth * (2.0 * i / kSteps - 1);
        const double phi =
            (kTrochleaTopDeg + (kTrochleaEndDeg - kTrochleaTopDeg) * j / kSteps) * kDeg;
        const Vec3 p = trochlea_point(x, phi, -kJointGap);
        if (std::abs(p.z() - kMiddleZ) > kHalfHeight) continue;
        least = std::min(least, p.y() + facet_depth(x, p.z()));
      }
    return least;
  }();
  return back;
}

/// From the square [-1, 1]² to the outline of the cartilage, between a rectangle and an ellipse.
constexpr double kRoundPatella = 0.7;
Vec2 outline_point(double u, double v) {
  return {kHalfWidth * u * std::sqrt(1 - kRoundPatella * v * v / 2),
          kMiddleZ + kHalfHeight * v * std::sqrt(1 - kRoundPatella * u * u / 2)};
}

/// And back; clamped where it would be far outside.
Vec2 outline_place(double x, double z) {
  const double a = x / kHalfWidth, b = (z - kMiddleZ) / kHalfHeight;
  double u = a, v = b;
  for (int k = 0; k < 20; ++k) {
    const double bounded_v = std::clamp(v, -1.3, 1.3);
    u = a / std::sqrt(1 - kRoundPatella * bounded_v * bounded_v / 2);
    const double bounded_u = std::clamp(u, -1.3, 1.3);
    v = b / std::sqrt(1 - kRoundPatella * bounded_u * bounded_u / 2);
  }
  return {u, v};
}

/// Length of the normal whose y is 1.
double steepness(double x, double z) {
  constexpr double kStep = 1e-4;
  const double along_x = (facet_depth(x + kStep, z) - facet_depth(x - kStep, z)) / (2 * kStep);
  const double along_z = (facet_depth(x, z + kStep) - facet_depth(x, z - kStep)) / (2 * kStep);
  return std::sqrt(1 + along_x * along_x + along_z * along_z);
}

Mesh cartilage_layer(const CellGrid& grid, double full) {
  return grid.fill([&](double u, double v, double w) -> Vec3 {
    const Vec2 p = outline_point(u, v);
    const double depth = (1 - w) * full * rim_taper(u, v) * steepness(p.x(), p.y());
    return {p.x(), patella_back(p.x(), p.y()) - depth, p.y()};
  });
}

/// A superellipsoid, pointed towards the apex and in front, which is cut behind by the surface that
/// the cartilage grows on.
double bone_distance(double full, const Vec3& p) {
  constexpr double kAbove = 2.8, kBelow = 1.7, kForward = 1.5;  // exponents: 2 is an ellipse
  const double up = p.z() - kWidestZ, exponent = up > 0 ? kAbove : kBelow;
  const double across = std::pow(std::pow(std::abs(p.x()) / kSide, exponent) +
                                     std::pow(std::abs(up) / (up > 0 ? kUp : kDown), exponent),
                                 1 / exponent);
  const double forward = std::abs(p.y() - (ridge_back() - kRim)) / kFront;
  const double solid =
      (std::pow(std::pow(across, kForward) + std::pow(forward, kForward), 1 / kForward) - 1) *
      kFront;
  const Vec2 place = outline_place(p.x(), p.z());
  const double floor =
      patella_back(p.x(), p.z()) - full * rim_taper(place.x(), place.y()) * steepness(p.x(), p.z());
  return std::max(solid, p.y() - floor);
}

}  // namespace

double patella_back(double x, double z) { return ridge_back() - facet_depth(x, z); }

double patellar_full_thickness(double mean) { return full_thickness(mean, cartilage_layer); }

Mesh patellar_cartilage(double mean, const KneeResolution& resolution) {
  check_resolution(resolution);
  const double h = resolution.size_mm;
  const CellGrid grid{even_cells(2 * kHalfWidth, h, 4), even_cells(2 * kHalfHeight, h, 4),
                      resolution.layers};
  return cartilage_layer(grid, patellar_full_thickness(mean));
}

Distance patella_distance(double mean) {
  return [full = patellar_full_thickness(mean)](const Vec3& p) {
    constexpr double kStep = 1e-4;
    const double value = bone_distance(full, p);
    Vec3 slope;
    for (int i = 0; i < 3; ++i) {
      const Vec3 step = kStep * Vec3::Unit(i);
      slope[i] = (bone_distance(full, p + step) - bone_distance(full, p - step)) / (2 * kStep);
    }
    return value / std::max(slope.norm(), 0.1);
  };
}

Mesh patella_surface(double h, double mean) {
  const double full = patellar_full_thickness(mean), back = ridge_back();
  return contour([&](const Vec3& p) { return bone_distance(full, p); },
                 {-kSide - 3, back - kRim - kFront - 3, kWidestZ - kDown - 3},
                 {kSide + 3, back + 3, kWidestZ + kUp + 3}, h);
}

Vec3 patella_apex() { return {0, ridge_back() - kRim - kFront / 2, kWidestZ - 0.9 * kDown}; }
Vec3 patella_base() { return {0, ridge_back() - kRim - kFront / 2, kWidestZ + 0.9 * kUp}; }

}  // namespace articular::anatomy
