#include "tools/anatomy/anatomy_knee_tissue.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tools/anatomy/anatomy_layer.hpp"
#include "tools/anatomy/anatomy_spacing.hpp"

namespace articular::anatomy {
namespace {

/// A place of a condyle: angle in the coronal plane, and arc length along the sagittal profile.
struct CondyleSpread {
  double alpha, length;
};

/// Of a place of the layer, |u|, |v| <= 1; its back edge is v = 1.
CondyleSpread femoral_spread(const Compartment& c, double u, double v) {
  constexpr double kRound = 0.3;  // outline: 0 rectangle, 1 ellipse
  const double front = profile_length(c, kFrontDeg * kDeg);
  const double back = profile_length(c, kBackDeg * kDeg);
  const double along = v * std::sqrt(1 - kRound * u * u / 2);
  return {c.coronal_angle * u * std::sqrt(1 - kRound * v * v / 2),
          (front + back) / 2 + (back - front) / 2 * along};
}

/// Where cartilages of a standing knee touch: in the middle across, and this far behind the lowest
/// points of the condyles. They do on spots of up to 7 mm in radius (scenarios/knee/RESULTS.md).
constexpr double kStandingY = -2.5, kStandingReach = 7.5;

/// Along both directions of a layer.
struct LayerSpacing {
  Spacing u, v;
  CellGrid grid(int layers) const { return {u.cells(), v.cells(), layers}; }
};

Spacing focused(double length, double middle, const KneeResolution& resolution) {
  return {length, resolution.size_mm, {middle, kStandingReach, resolution.focus}};
}

LayerSpacing femoral_spacing(const Compartment& c, const KneeResolution& resolution) {
  const double front = profile_length(c, kFrontDeg * kDeg),
               back = profile_length(c, kBackDeg * kDeg);
  return {focused(2 * c.coronal_radius * c.coronal_angle, 0, resolution),
          focused(back - front, kStandingY - (front + back) / 2, resolution)};
}

LayerSpacing tibial_spacing(const Compartment& c, const KneeResolution& resolution) {
  return {focused(2 * c.half_width, 0, resolution),
          focused(2 * c.half_depth, kStandingY, resolution)};
}

Mesh femoral_layer(const Compartment& c, const LayerSpacing& spacing, int layers, double full) {
  return spacing.grid(layers).fill([&](double s, double t, double w) {
    const auto [alpha, length] = femoral_spread(c, spacing.u.place(s), spacing.v.place(t));
    const double phi = profile_angle(c, length);
    const CartilagePlace place = femoral_place(c, phi, alpha);
    return condyle_point(c, phi, alpha, (1 - w) * full * rim_taper(place.u, place.v));
  });
}

/// From the layer's back edge on.
Mesh back_layer(const Compartment& c, const CellGrid& grid, double full) {
  const double end = profile_length(c, kBackEndDeg * kDeg);
  return grid.fill([&](double u, double v, double w) {
    const auto [alpha, edge] = femoral_spread(c, u, 1);
    const double phi = profile_angle(c, edge + (end - edge) * (v + 1) / 2);
    return condyle_point(c, phi, alpha, (1 - w) * full * rim_taper(u, 1));
  });
}

Mesh tibial_layer(const Compartment& c, const LayerSpacing& spacing, int layers, double full) {
  return spacing.grid(layers).fill([&](double s, double t, double w) -> Vec3 {
    const double u = spacing.u.place(s), v = spacing.v.place(t);
    const Eigen::Vector2d p = plateau_point(c, u, v);
    // Straight down, so that the surface that it grows on is a height too.
    const double depth = full * rim_taper(u, v) / plateau_normal(c, p.x(), p.y()).z();
    return {p.x(), p.y(), plateau_height(c, p.x(), p.y()) - (1 - w) * depth};
  });
}

}  // namespace

void check_resolution(const KneeResolution& resolution) {
  if (!(resolution.size_mm >= 0.4 && resolution.size_mm <= 4))
    throw std::invalid_argument(
        fmt::format("--size: element size {} mm: expected 0.4 to 4 mm", resolution.size_mm));
  if (resolution.layers < 2 || resolution.layers > 6)
    throw std::invalid_argument(
        fmt::format("--layers: {} layers: expected 2 to 6", resolution.layers));
  if (!(resolution.focus >= 1 && resolution.focus <= 3))
    throw std::invalid_argument(fmt::format("--focus: {}: expected 1 to 3", resolution.focus));
}

CartilagePlace femoral_place(const Compartment& c, double phi, double alpha) {
  const double front = profile_length(c, kFrontDeg * kDeg);
  const double back = profile_length(c, kBackDeg * kDeg);
  return {alpha / c.coronal_angle, 2 * (profile_length(c, phi) - front) / (back - front) - 1};
}

double femoral_full_thickness(const Compartment& c) {
  return full_thickness(c.femoral_thickness, [&](const CellGrid& grid, double full) {
    return femoral_layer(c, {Spacing(grid.nu), Spacing(grid.nv)}, grid.nw, full);
  });
}

double tibial_full_thickness(const Compartment& c) {
  return full_thickness(c.tibial_thickness, [&](const CellGrid& grid, double full) {
    return tibial_layer(c, {Spacing(grid.nu), Spacing(grid.nv)}, grid.nw, full);
  });
}

Mesh femoral_cartilage(const Compartment& c, const KneeResolution& resolution) {
  check_resolution(resolution);
  return femoral_layer(c, femoral_spacing(c, resolution), resolution.layers,
                       femoral_full_thickness(c));
}

Mesh femoral_cartilage_back(const Compartment& c, const KneeResolution& resolution) {
  check_resolution(resolution);
  const double h = resolution.size_mm;
  const double length = profile_length(c, kBackEndDeg * kDeg) - profile_length(c, kBackDeg * kDeg);
  const CellGrid grid{even_cells(2 * c.coronal_radius * c.coronal_angle, h, 4),
                      even_cells(length, h, 2), resolution.layers};
  return back_layer(c, grid, femoral_full_thickness(c));
}

Mesh tibial_cartilage(const Compartment& c, const KneeResolution& resolution) {
  check_resolution(resolution);
  return tibial_layer(c, tibial_spacing(c, resolution), resolution.layers,
                      tibial_full_thickness(c));
}

}  // namespace articular::anatomy
