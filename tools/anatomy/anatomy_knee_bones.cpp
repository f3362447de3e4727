#include "tools/anatomy/anatomy_knee_bones.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/anatomy/anatomy_knee_tissue.hpp"
#include "tools/anatomy/anatomy_solids.hpp"
#include "tools/anatomy/anatomy_trochlea.hpp"

namespace articular::anatomy {
namespace {

/// The bone goes on by this part of the cartilage's extent as if it were covered.
constexpr double kBeyond = 1.25;
constexpr double kNotch = 7;        // half the distance of the condyles
constexpr double kCondyleTop = 32;  // condyles end in the shaft below this height

/// A superellipse that changes along z: half width, half depth, y of its middle.
struct Section {
  double z, half_width, half_depth, y;
};

/// Of the solid between stacked sections; about a distance near its surface.
double loft_distance(const std::vector<Section>& sections, const Vec3& p) {
  constexpr double kExponent = 2.6;
  const double low = sections.front().z, high = sections.back().z;
  const double z = std::clamp(p.z(), low, high);
  std::size_t i = 0;
  while (i + 2 < sections.size() && z > sections[i + 1].z) ++i;
  const Section &a = sections[i], &b = sections[i + 1];
  const double s = (z - a.z) / (b.z - a.z), t = s * s * (3 - 2 * s);
  const double width = a.half_width + t * (b.half_width - a.half_width);
  const double depth = a.half_depth + t * (b.half_depth - a.half_depth);
  const double level =
      std::pow(std::pow(std::abs(p.x()) / width, kExponent) +
                   std::pow(std::abs(p.y() - a.y - t * (b.y - a.y)) / depth, kExponent),
               1 / kExponent);
  return std::max((level - 1) * std::min(width, depth), std::max(low - p.z(), p.z() - high));
}

/// A compartment with what takes long to find.
struct Side {
  explicit Side(const Compartment& compartment)
      : c(compartment),
        femoral_thickness(femoral_full_thickness(compartment)),
        tibial_thickness(tibial_full_thickness(compartment)) {}
  Compartment c;
  double femoral_thickness, tibial_thickness;  // full, see rim_taper()
};
using Sides = std::array<Side, 2>;  // medial, lateral

/// Distance to the surface that a condyle's cartilage grows on, and whether it is covered there.
struct Covered {
  double distance;
  bool covered;  // or nearly
  bool on_cartilage;
};
Covered below_femoral_cartilage(const Side& side, const Vec3& p) {
  const Compartment& c = side.c;
  const CondylePlace place = condyle_place(c, p);
  const auto [u, v] = femoral_place(c, place.phi, place.alpha);
  return {place.distance + side.femoral_thickness * rim_taper(u, v),
          std::max(std::abs(u), std::abs(v)) < kBeyond, std::max(std::abs(u), std::abs(v)) < 1};
}

std::array<Covered, 2> below_femoral_cartilage(const Sides& sides, const Vec3& p) {
  return {below_femoral_cartilage(sides[0], p), below_femoral_cartilage(sides[1], p)};
}

double condyle_distance(const Side& side, const Covered& below, const Vec3& p) {
  const Compartment& c = side.c;
  const double half_width = (c.coronal_radius - 1) * std::sin(c.coronal_angle) + 2.5;
  const double wall = std::abs(p.x() - c.side * kCompartmentX) - half_width;
  return std::max({below.distance, wall, p.z() - kCondyleTop});
}

/// The bone that carries the cartilage of the trochlea.
double trochlea_distance(double thickness, const TrochleaPlace& place) {
  constexpr double kDeep = 14, kOver = 1.1;
  const double beyond = std::max(std::abs(place.u), std::abs(place.v)) - kOver;
  const double below = place.distance + thickness * rim_taper(place.u, place.v);
  return std::max({below, 20 * beyond, -kDeep - place.distance});
}

double femur_distance(const Sides& sides, const std::array<Covered, 2>& below, const Vec3& p) {
  static const std::vector<Section> shaft = {
      {23, 34, 17, -6},    {32, 36, 22, -8},    {42, 32, 21, -10}, {56, 23, 18, -12},
      {75, 16.5, 14, -11}, {100, 13.5, 13, -8}, {119, 13, 13, -5}};
  // The groove of the patella, between the condyles in front; the epicondyles.
  static const Sheet front = [] {
    Sheet sheet;
    add_strip(sheet, {{-21, -22, 18, 9}, {0, -20, 20, 7}, {21, -22, 18, 8}},
              {{-19, -24, 36, 9}, {0, -21, 37, 7}, {19, -22, 36, 8}});
    add_rods(sheet, {{-29, -1, 25, 8}, {29, -3, 27, 8}});
    return sheet;
  }();
  // The notch: cruciate ligaments begin at its walls.
  static const Sheet notch = [] {
    Sheet sheet;
    add_rods(sheet, {{0, -2, 17, 9}, {0, 22, 33, 9}});
    return sheet;
  }();
  double bone = smooth_min(loft_distance(shaft, p), distance(front, p), 6);
  for (std::size_t i = 0; i < 2; ++i)
    bone = smooth_min(bone, condyle_distance(sides[i], below[i], p), 4);
  bone = std::max(bone, -distance(notch, p));
  for (std::size_t i = 0; i < 2; ++i) {
    const bool beside = p.x() * sides[i].c.side > kNotch && p.z() < kCondyleTop;
    if (below[i].covered && beside) bone = std::max(bone, below[i].distance);
  }
  return bone;
}

/// The same with a trochlea. Nothing rises above what any cartilage grows on.
double femur_with_trochlea_distance(const Sides& sides, double thickness, const Vec3& p) {
  const std::array<Covered, 2> below = below_femoral_cartilage(sides, p);
  const TrochleaPlace place = trochlea_place(p);
  double bone = smooth_min(femur_distance(sides, below, p), trochlea_distance(thickness, place), 6);
  for (const Covered& condyle : below)
    if (condyle.on_cartilage) bone = std::max(bone, condyle.distance);
  if (std::max(std::abs(place.u), std::abs(place.v)) < 1.05 && p.y() < 0)
    bone = std::max(bone, place.distance + thickness * rim_taper(place.u, place.v));
  return bone;
}

/// What lies below a point of the bone under a plateau.
struct BelowPlateau {
  double outward;  // of the outline: 0 in the middle, 1 at the rim
  double floor;    // height of the surface that the cartilage grows on; beyond, it levels off
};
BelowPlateau below_plateau(const Side& side, const Vec3& p) {
  const Compartment& c = side.c;
  const Eigen::Vector2d place = plateau_place(c, p.x(), p.y());
  const Eigen::Vector2d inside = plateau_point(c, std::clamp(place.x(), -kBeyond, kBeyond),
                                               std::clamp(place.y(), -kBeyond, kBeyond));
  const double slope = plateau_normal(c, inside.x(), inside.y()).z();
  return {place.cwiseAbs().maxCoeff(),
          plateau_height(c, inside.x(), inside.y()) -
              side.tibial_thickness * rim_taper(place.x(), place.y()) / slope};
}

/// The bone under a plateau, to some depth.
double plateau_distance(const Side& side, const BelowPlateau& below, const Vec3& p) {
  constexpr double kDepth = 12, kOver = 1.15;
  return std::max(
      {p.z() - below.floor, (below.outward - kOver) * side.c.half_width, -kDepth - p.z()});
}

double tibia_distance(const Sides& sides, const Vec3& p) {
  static const std::vector<Section> body = {
      {-119, 12.5, 14, -4}, {-95, 14, 16, -4},  {-70, 17, 18, -3}, {-48, 22, 20, -1},
      {-30, 31, 23, 1},     {-16, 36.5, 25, 1}, {8, 37.5, 25, 1}};
  static const Sheet added = [] {
    Sheet sheet;
    add_rods(sheet, {{0, -17, -28, 8}, {1, -17, -42, 7}, {1, -11, -60, 6}});  // tuberosity
    add_rods(sheet,
             {{-39, 14, -23, 6.5}, {-38, 14, -32, 5.5}, {-35, 13, -60, 4}, {-34, 12, -117, 4}});
    return sheet;
  }();
  static const Sheet eminence = [] {
    Sheet sheet;
    add_rods(sheet, {{4.5, 3, -4, 4}, {4.5, 3, 3.5, 2}});
    add_rods(sheet, {{-4.5, 1, -4, 4}, {-4.5, 1, 3, 2}});
    return sheet;
  }();
  const std::array<BelowPlateau, 2> below = {below_plateau(sides[0], p),
                                             below_plateau(sides[1], p)};
  const double share = std::clamp(p.x() / kCompartmentX * 2 + 0.5, 0.0, 1.0);
  const double top = p.z() - (share * below[0].floor + (1 - share) * below[1].floor);
  double trunk = std::max(loft_distance(body, p), top);
  for (std::size_t i = 0; i < 2; ++i)
    trunk = smooth_min(trunk, plateau_distance(sides[i], below[i], p), 3);
  double bone = smooth_min(smooth_min(trunk, distance(eminence, p), 4), distance(added, p), 5);
  for (const BelowPlateau& plateau : below)
    if (plateau.outward < kBeyond && p.z() > -10) bone = std::max(bone, p.z() - plateau.floor);
  return bone;
}

}  // namespace

Distance femur_distance(const Compartment& medial, const Compartment& lateral) {
  return [sides = Sides{Side(medial), Side(lateral)}](const Vec3& p) {
    return femur_distance(sides, below_femoral_cartilage(sides, p), p);
  };
}

Distance tibia_distance(const Compartment& medial, const Compartment& lateral) {
  return [sides = Sides{Side(medial), Side(lateral)}](const Vec3& p) {
    return tibia_distance(sides, p);
  };
}

Mesh femur_surface(double h, const Compartment& medial, const Compartment& lateral) {
  return contour(femur_distance(medial, lateral), {-46, -50, -8}, {46, 44, 123}, h);
}

Mesh femur_with_trochlea_surface(double h, const Compartment& medial, const Compartment& lateral,
                                 double trochlear_thickness) {
  const Sides sides{Side(medial), Side(lateral)};
  const double full = trochlear_full_thickness(trochlear_thickness);
  return contour([&](const Vec3& p) { return femur_with_trochlea_distance(sides, full, p); },
                 {-46, -50, -8}, {46, 44, 123}, h);
}

Mesh tibia_surface(double h, const Compartment& medial, const Compartment& lateral) {
  return contour(tibia_distance(medial, lateral), {-50, -36, -123}, {44, 32, 12}, h);
}

}  // namespace articular::anatomy
