#include "tools/anatomy/anatomy_knee_tissue.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tools/anatomy/anatomy_layer.hpp"

namespace articular::anatomy {
namespace {

constexpr double kCondyleRound = 0.3;  // outline of a condyle's layer: 0 rectangle, 1 ellipse

Mesh femoral_layer(const Compartment& c, const CellGrid& grid, double full) {
  const double front = profile_length(c, kFrontDeg * kDeg);
  const double back = profile_length(c, kBackDeg * kDeg);
  return grid.fill([&](double u, double v, double w) {
    const double alpha = c.coronal_angle * u * std::sqrt(1 - kCondyleRound * v * v / 2);
    const double along = v * std::sqrt(1 - kCondyleRound * u * u / 2);
    const double phi = profile_angle(c, (front + back) / 2 + (back - front) / 2 * along);
    const CartilagePlace place = femoral_place(c, phi, alpha);
    return condyle_point(c, phi, alpha, (1 - w) * full * rim_taper(place.u, place.v));
  });
}

/// From the layer's back edge on.
Mesh back_layer(const Compartment& c, const CellGrid& grid, double full) {
  const double front = profile_length(c, kFrontDeg * kDeg);
  const double back = profile_length(c, kBackDeg * kDeg);
  const double end = profile_length(c, kBackEndDeg * kDeg);
  return grid.fill([&](double u, double v, double w) {
    const double alpha = c.coronal_angle * u * std::sqrt(1 - kCondyleRound / 2);
    const double edge =
        (front + back) / 2 + (back - front) / 2 * std::sqrt(1 - kCondyleRound * u * u / 2);
    const double phi = profile_angle(c, edge + (end - edge) * (v + 1) / 2);
    return condyle_point(c, phi, alpha, (1 - w) * full * rim_taper(u, 1));
  });
}

Mesh tibial_layer(const Compartment& c, const CellGrid& grid, double full) {
  return grid.fill([&](double u, double v, double w) -> Vec3 {
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
}

CartilagePlace femoral_place(const Compartment& c, double phi, double alpha) {
  const double front = profile_length(c, kFrontDeg * kDeg);
  const double back = profile_length(c, kBackDeg * kDeg);
  return {alpha / c.coronal_angle, 2 * (profile_length(c, phi) - front) / (back - front) - 1};
}

double femoral_full_thickness(const Compartment& c) {
  return full_thickness(c.femoral_thickness, [&](const CellGrid& grid, double full) {
    return femoral_layer(c, grid, full);
  });
}

double tibial_full_thickness(const Compartment& c) {
  return full_thickness(c.tibial_thickness, [&](const CellGrid& grid, double full) {
    return tibial_layer(c, grid, full);
  });
}

Mesh femoral_cartilage(const Compartment& c, const KneeResolution& resolution) {
  check_resolution(resolution);
  const double h = resolution.size_mm;
  const double length = profile_length(c, kBackDeg * kDeg) - profile_length(c, kFrontDeg * kDeg);
  const CellGrid grid{even_cells(2 * c.coronal_radius * c.coronal_angle, h, 4),
                      even_cells(length, h, 4), resolution.layers};
  return femoral_layer(c, grid, femoral_full_thickness(c));
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
  const double h = resolution.size_mm;
  const CellGrid grid{even_cells(2 * c.half_width, h, 4), even_cells(2 * c.half_depth, h, 4),
                      resolution.layers};
  return tibial_layer(c, grid, tibial_full_thickness(c));
}

}  // namespace articular::anatomy
