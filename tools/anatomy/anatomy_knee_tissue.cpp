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

constexpr double kThinnest = 0.8;  // height of a meniscus's inner edge
/// Horns leave the condyle and the plateau, between which nothing may squeeze them: they grow on
/// bone.
constexpr double kHornRelief = 1, kHornRise = 0.3;
constexpr double kClearance = 0.02;  // of a meniscus, beside what chords of elements need

Mesh femoral_layer(const Compartment& c, const CellGrid& grid, double full) {
  constexpr double kRound = 0.3;  // outline: 0 rectangle, 1 ellipse
  const double front = profile_length(c, kFrontDeg * kDeg);
  const double back = profile_length(c, kBackDeg * kDeg);
  return grid.fill([&](double u, double v, double w) {
    const double alpha = c.coronal_angle * u * std::sqrt(1 - kRound * v * v / 2);
    const double along = v * std::sqrt(1 - kRound * u * u / 2);
    const double phi = profile_angle(c, (front + back) / 2 + (back - front) / 2 * along);
    const CartilagePlace place = femoral_place(c, phi, alpha);
    return condyle_point(c, phi, alpha, (1 - w) * full * rim_taper(place.u, place.v));
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

/// Ray from a compartment's middle to the outer rim of its meniscus. psi: 0 at the middle of the
/// rim, < 0 in front.
Eigen::Vector2d rim_ray(const Compartment& c, double psi) {
  return {c.side * c.rim_width * std::cos(psi), c.rim_depth * std::sin(psi)};
}

/// Between the three widths, by the share of front and back.
double meniscus_width(const Compartment& c, double psi) {
  const double t = std::min(std::abs(psi) / (90 * kDeg), 1.0);
  const double blend = t * t * (3 - 2 * t);
  return c.middle_width + blend * ((psi < 0 ? c.front_width : c.back_width) - c.middle_width);
}

/// The meniscus as a function of place.
class Wedge {
 public:
  Wedge(const Compartment& c, double size) : c_(c) {
    // A chord of length l of a circle of radius R leaves it by l²/8R; of a square's diagonal h²/4R.
    const double plateau_radius = std::min(1 / std::abs(c.sagittal_curvature), c.eminence_radius);
    upper_ = kClearance + size * size / (4 * c.coronal_radius);
    lower_ = kClearance + size * size / (4 * plateau_radius);
  }

  double floor(const Eigen::Vector2d& p, double psi) const {
    return plateau_height(c_, p.x(), p.y()) + lower_ + kHornRise * horn_share(psi);
  }
  double height(const Eigen::Vector2d& p, double psi) const {
    const double room =
        condyle_height(c_, p.x(), p.y(), upper_) - kHornRelief * horn_share(psi) - floor(p, psi);
    return std::min(room, c_.rim_height);
  }
  /// @param v  -1 at the inner edge, 1 at the outer rim
  Eigen::Vector2d place(double psi, double v) const {
    const Eigen::Vector2d ray = rim_ray(c_, psi);
    const auto at = [&](double r) -> Eigen::Vector2d {
      return Eigen::Vector2d(c_.side * kCompartmentX, 0) + r * ray;
    };
    double inner = 1 - meniscus_width(c_, psi) / ray.norm();
    constexpr double kStep = 1e-3;
    while (inner < 0.9 && height(at(inner), psi) < kThinnest) inner += kStep;
    return at(inner + (1 - inner) * (v + 1) / 2);
  }

 private:
  /// 0 along the rim, 1 at the ends of the horns.
  double horn_share(double psi) const {
    constexpr double kBegin = 0.7;
    const double t = std::clamp((std::abs(psi) / c_.horn_angle - kBegin) / (1 - kBegin), 0.0, 1.0);
    return t * t * (3 - 2 * t);
  }

  const Compartment& c_;
  double upper_ = 0, lower_ = 0;
};

/// Along the grid's first direction, one an element.
FibreDirections rim_fibres(const Mesh& mesh, const CellGrid& grid) {
  FibreDirections fibres(3, mesh.tets.cols());
  for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e) {
    const Eigen::Index cell = e / 6;  // i fastest, then j, then k, see CellGrid
    const int i = static_cast<int>(cell % grid.nu);
    const int j = static_cast<int>(cell / grid.nu % grid.nv);
    const int k = static_cast<int>(cell / grid.nu / grid.nv);
    Vec3 along = Vec3::Zero();
    for (const int dj : {0, 1})
      for (const int dk : {0, 1})
        along += mesh.X_mm.col(grid.node(i + 1, j + dj, k + dk)) -
                 mesh.X_mm.col(grid.node(i, j + dj, k + dk));
    fibres.col(e) = along.normalized();
  }
  return fibres;
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

Mesh tibial_cartilage(const Compartment& c, const KneeResolution& resolution) {
  check_resolution(resolution);
  const double h = resolution.size_mm;
  const CellGrid grid{even_cells(2 * c.half_width, h, 4), even_cells(2 * c.half_depth, h, 4),
                      resolution.layers};
  return tibial_layer(c, grid, tibial_full_thickness(c));
}

Mesh meniscus(const Compartment& c, const KneeResolution& resolution) {
  check_resolution(resolution);
  const double h = resolution.size_mm;
  constexpr double kLength = 75;  // along its middle, about
  const CellGrid grid{even_cells(kLength, h, 8), even_cells(c.middle_width, h, 4),
                      resolution.layers};
  const Wedge wedge(c, h);
  Mesh mesh = grid.fill([&](double u, double v, double w) -> Vec3 {
    const double psi = u * c.horn_angle;
    const Eigen::Vector2d p = wedge.place(psi, v);
    return {p.x(), p.y(), wedge.floor(p, psi) + w * wedge.height(p, psi)};
  });
  mesh.fibres = rim_fibres(mesh, grid);
  return mesh;
}

Vec3 horn(const Compartment& c, int end) {
  const Wedge wedge(c, 0);
  const double psi = end * c.horn_angle;
  const Eigen::Vector2d p = wedge.place(psi, 0);
  return {p.x(), p.y(), wedge.floor(p, psi) + wedge.height(p, psi) / 2};
}

}  // namespace articular::anatomy
