#include "tools/anatomy/anatomy_bones.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "tools/anatomy/anatomy_solids.hpp"

namespace articular::anatomy {
namespace {

/// A tooth crown: |u/su|^4 + |v/sv|^4 + |w/sw|^4 <= 1, u along the arch, v across it, w up.
struct Crown {
  Vec3 center, along, half_size;
};

double distance(const Crown& crown, const Vec3& p) {
  const Vec3 across = Vec3::UnitZ().cross(crown.along);
  const Vec3 d = p - crown.center;
  const Vec3 q = Vec3(d.dot(crown.along), d.dot(across), d.z()).cwiseQuotient(crown.half_size);
  const double level = std::pow(q.array().pow(4).sum(), 0.25);
  return (level - 1) * crown.half_size.minCoeff();
}

double distance(const std::vector<Crown>& crowns, const Vec3& p) {
  constexpr double kNear = 5;  // further off nothing of a crown shows in the surface
  double least = kFar;
  for (const Crown& crown : crowns)
    if ((p - crown.center).norm() - crown.half_size.norm() < kNear)
      least = std::min(least, distance(crown, p));
  return least;
}

/// Crowns of one half of an arch, from the central incisor to the second molar.
/// @param up  1 for the upper arch: crowns hang above the occlusal level
std::vector<Crown> crowns(bool up) {
  struct Size {
    double width, depth, height;  // along the arch, across it, crown from the occlusal level
  };
  static const std::vector<Size> lower = {{5.4, 6.0, 9.5}, {5.9, 6.2, 9.5}, {6.9, 7.6, 10.5},
                                          {7.0, 7.8, 8.5}, {7.2, 8.2, 8},   {11, 10.4, 7.5},
                                          {10.6, 10.2, 7}};
  static const std::vector<Size> upper = {{8.3, 6.8, 10}, {6.6, 6.2, 9.5}, {7.5, 8, 10.5},
                                          {7.0, 9, 8.5},  {6.8, 9, 8.2},   {10.2, 11, 7.5},
                                          {9.8, 11, 7}};
  std::vector<Crown> result;
  double s = 0;                       // along the arch
  const double shift = up ? 1.2 : 0;  // the upper arch is wider
  constexpr double kStep = 0.02;
  const auto outward = [shift](double x) -> Vec3 {
    const Vec3 t = (arch_point(x + kStep) - arch_point(std::max(x - kStep, 0.0))).normalized();
    const Vec3 n = t.cross(Vec3::UnitZ()).normalized();
    return arch_point(x) + shift * n;
  };
  double x = 0;
  for (const Size& size : up ? upper : lower) {
    const double target = s + size.width / 2;
    double walked = s;
    while (walked < target) {
      walked += (outward(x + kStep) - outward(x)).norm();
      x += kStep;
    }
    const Vec3 along = (outward(x + kStep) - outward(x)).cwiseProduct(Vec3(1, 1, 0)).normalized();
    const double half = size.height / 2 + 1.5;  // the root side is sunk into the bone
    Vec3 center = outward(x);
    center.z() += up ? kOcclusalGap + half : -half;
    result.push_back({center, along, {0.5 * size.width * 0.99, 0.5 * size.depth, half}});
    while (walked < s + size.width) {
      walked += (outward(x + kStep) - outward(x)).norm();
      x += kStep;
    }
    s = walked;
  }
  return result;
}

Sheet mandible_sheet() {
  Sheet sheet;
  // Body: lower border and alveolar border from the chin to the back of the last molar.
  add_strip(sheet,
            smoothed({{0, -40.5, 13.5, 6.2},
                      {8, -39.8, 12.5, 6.0},
                      {16, -35, 12.5, 5.3},
                      {23, -24, 14, 5.2},
                      {30.5, -11, 16.5, 5.3},
                      {37, 2, 19.5, 5.2},
                      {42.5, 14, 23, 4.6}},
                     4),
            smoothed({{0, -42.5, 32, 4.6},
                      {8, -41, 32, 4.6},
                      {16, -34.5, 32.5, 4.8},
                      {21.5, -24.5, 33.5, 5.0},
                      {25.5, -12, 35.5, 5.6},
                      {29.5, 0, 38, 5.6},
                      {36, 9.5, 43, 4.2}},
                     4));
  add_rods(sheet, {{0, -43.5, 12, 4.6}, {7, -42.5, 11.5, 4.0}});  // mental protuberance
  // Ramus: anterior border with the coronoid, middle line to the notch, posterior border to the
  // neck.
  const std::vector<Knot> anterior = smoothed(
      {{42.5, 14, 23, 4.2}, {38.5, 7.5, 44, 3.8}, {43.3, 3.5, 57, 3.0}, {44.8, 0, 68, 2.6}}, 4);
  const std::vector<Knot> middle = smoothed(
      {{46, 21, 21.5, 4.0}, {45.3, 19, 40, 3.0}, {46.3, 17, 55, 2.6}, {47, 15.5, 63.5, 2.4}}, 4);
  const std::vector<Knot> posterior = smoothed(
      {{48.2, 27, 25.5, 4.0}, {47.2, 27.5, 42, 3.6}, {47.6, 28.5, 56, 3.4}, {48.6, 29.8, 66, 3.4}},
      4);
  add_strip(sheet, anterior, middle);
  add_strip(sheet, middle, posterior);
  sheet.push_back({{44.8, 0, 68, 2.6}, {47, 15.5, 63.5, 2.4}, {47, 0.2, 78.3, 1.9}});
  sheet.push_back({{47, 15.5, 63.5, 2.4}, {48.6, 29.8, 66, 3.4}, {49.4, 30.3, 72, 3.4}});
  add_rods(sheet, {{48.6, 29.8, 66, 3.6}, {49.4, 30.5, 73, 3.5}, {50, 31.5, 79, 3.8}});
  sheet.push_back({{49.4, 30.6, 73, 3.2},
                   {44, 31.3, 79.5, 3.0},
                   {56, 31.3, 79.5, 3.0}});  // neck widens to the head
  return sheet;
}

double head_distance(const Vec3& p) {
  const Vec3 d = p - kCondyle;
  const double a = std::abs(d.x()) / kCondyleHalfWidth,
               r = std::hypot(d.y(), d.z()) / kCondyleRadius;
  return (std::pow(std::pow(a, 2.5) + std::pow(r, 2.5), 0.4) - 1) * kCondyleRadius;
}

Sheet skull_sheet() {
  Sheet sheet;
  // Alveolar process and maxilla above the upper teeth, palate between.
  const std::vector<Knot> alveolar = smoothed({{0, -45, 53.5, 4.4},
                                               {9, -42.5, 53.5, 4.4},
                                               {17.5, -35, 54, 4.6},
                                               {23, -24, 54.5, 4.8},
                                               {26.5, -12, 55.5, 5.4},
                                               {28, -2, 57, 5.2},
                                               {28, 3, 58.5, 4.4}},
                                              4);
  const std::vector<Knot> base = smoothed({{0, -43, 64, 3.6},
                                           {8, -40.5, 65, 3.6},
                                           {15, -33, 66, 3.8},
                                           {20, -23, 67, 4.0},
                                           {23, -12, 67, 4.0},
                                           {24, -3, 67, 4.0},
                                           {24, 1, 67, 3.6}},
                                          4);
  add_strip(sheet, alveolar, base);
  for (std::size_t i = 0; i + 1 < base.size(); ++i) {
    const Knot m0{0, base[i].y, 66, 2.6}, m1{0, base[i + 1].y, 66, 2.6};
    sheet.push_back({base[i], base[i + 1], m1});
    sheet.push_back({base[i], m1, m0});
  }
  // Front of the maxilla beside the nose, up to the cheekbone and the rim of the orbit.
  add_strip(sheet, {{15, -33, 66, 3.8}, {20, -23, 67, 4}, {23, -12, 67, 4}},
            {{13, -36, 84, 2.6}, {27, -31, 82, 3}, {40, -24, 78, 4.2}});
  add_rods(sheet, {{13, -36, 84, 2.6},
                   {9, -38, 99, 2.6},
                   {14, -39, 109, 2.8},
                   {28, -37, 113, 3},
                   {41, -29, 110, 3},
                   {47, -20, 103, 2.6}});
  add_rods(sheet, {{0, -42, 107, 3}, {14, -39, 109, 2.8}});  // brow
  add_strip(sheet, {{0, -42, 98, 2.2}, {0, -42, 107, 3}},
            {{9, -38, 99, 2.2}, {14, -39, 109, 2.6}});  // root of the nose
  add_rods(sheet, {{13, -36, 84, 2.8}, {27, -32, 84, 3}, {40, -25, 82, 4}});
  // Cheekbone and zygomatic arch to the eminence, lateral rim of the orbit.
  add_rods(sheet, smoothed({{38, -24, 76, 5},
                            {47, -19, 76, 4.8},
                            {55, -9, 77, 3.8},
                            {62, 3, 80, 2.9},
                            {65.5, 15, 84, 2.7},
                            {65.5, 26, 88, 3.0},
                            {62.5, 36, 91.5, 3.6}},
                           4));
  add_rods(sheet, smoothed({{46, -20, 78, 4}, {47.5, -18, 92, 2.8}, {47, -20, 103, 2.6}}, 4));
  // Pterygoid plate and the floor of the skull that carries it.
  add_strip(sheet, {{24, 1, 60, 2}, {25, 4, 67, 2.2}, {25, 6, 78, 2.4}, {26, 8, 92, 3}},
            {{26, 9, 60, 1.6}, {27, 11, 67, 1.8}, {27, 13, 78, 2.2}, {28, 16, 92, 3}});
  add_strip(sheet, {{0, 6, 96, 4}, {27, 8, 95, 3.2}, {38, 4, 96, 3}, {41, -1, 97, 2.6}},
            {{0, 36, 94, 4}, {27, 36, 94, 3.4}, {46, 40, 95, 3.4}, {57, 42, 97, 3.4}});
  // Temporal squama, where the temporalis comes from: rows from its root, which leaves room for
  // that muscle within the zygomatic arch, to its rounded top; mastoid.
  const std::vector<std::vector<Knot>> squama = {
      {{40, -3, 96, 2.4}, {43, 10, 97, 2.6}, {50, 26, 97, 3.2}, {58, 44, 97, 3.6}},
      {{47, -8, 112, 2.2}, {53, 8, 113, 2.2}, {60, 30, 113, 2.2}, {62, 52, 111, 2.6}},
      {{51, -8, 130, 2.0}, {60.5, 14, 132, 2.2}, {65.5, 34, 132, 2.2}, {65, 55, 128, 2.2}},
      {{54, -4, 144, 1.8}, {60, 17, 148, 2.0}, {64, 33, 148, 2.0}, {63, 50, 142, 1.8}}};
  for (std::size_t row = 0; row + 1 < squama.size(); ++row)
    add_strip(sheet, smoothed(squama[row], 4), smoothed(squama[row + 1], 4));
  add_rods(sheet, {{61, 46, 97, 5}, {57, 52, 85, 5.5}, {53, 53, 74, 4}});
  return sheet;
}

/// Styloid process, which stylohyoid and stylomandibular ligament come from.
Sheet styloid_sheet() {
  Sheet sheet;
  add_rods(sheet, {{45, 40, 94, 3.2}, {42, 41.5, 82, 2.3}, {38, 44, 66.5, 1.8}});
  return sheet;
}

/// One half: body with the greater horn.
Sheet hyoid_sheet() {
  Sheet sheet;
  add_rods(sheet, smoothed({{0, 7.5, -7, 4.2},
                            {6, 8.2, -7, 4},
                            {12, 11, -6.5, 3.2},
                            {17, 18, -5, 2.4},
                            {20, 26, -3.5, 2},
                            {21.5, 33, -2, 2.2}},
                           3));
  return sheet;
}

/// Temporal bone around the joint: everything within 7 mm above the fossa surface, cut to a block.
double temporal_block_distance(const Vec3& p, const FossaProfile& fossa) {
  const Vec3 d = p - kCondyle;
  if (d.norm() > 45) return d.norm() - 40;
  const double below = distance_below_fossa(d, fossa);
  const Vec3 half(14, 17, 12), center(-1.5, -7, 5);
  const Vec3 box = (d - center).cwiseAbs() - half;
  const double box_distance = box.maxCoeff();
  const double top = std::abs(below + 4.0) - 4.0;  // 0 to 8 mm above the surface
  return std::max(top, box_distance);
}

const Vec3 kSkullLow(-82, -56, 36), kSkullHigh(82, 66, 160);

/// Strip along the arch between two offsets from its middle.
Mesh arch_strip(double h, double dz, bool normal_up) {
  constexpr double kEnd = 27, kHalfWidth = 4.5;
  const int across = std::max(2, static_cast<int>(std::lround(2 * kHalfWidth / h)));
  std::vector<Vec3> middle;
  // Even spacing along the arch.
  std::vector<double> xs = {0}, arc = {0};
  for (int i = 1; i <= 2000; ++i) {
    xs.push_back(kEnd * i / 2000);
    arc.push_back(arc.back() +
                  (arch_point(xs[xs.size() - 1]) - arch_point(xs[xs.size() - 2])).norm());
  }
  const int half = static_cast<int>(std::lround(arc.back() / h));
  Mesh mesh;
  mesh.X_mm.resize(3, (2 * half + 1) * (across + 1));
  mesh.triangles.resize(3, 2 * 2 * half * across);
  for (int i = -half; i <= half; ++i) {
    const auto it = std::lower_bound(arc.begin(), arc.end(), arc.back() * std::abs(i) / half);
    const double x = xs[std::min(static_cast<std::size_t>(it - arc.begin()), xs.size() - 1)];
    const double before = std::max(x - 0.01, 0.0);
    Vec3 along = arch_point(x + 0.01) - arch_point(before);
    if (i == 0) along = Vec3::UnitX();
    const Vec3 out = along.cwiseProduct(Vec3(1, 1, 0)).normalized().cross(Vec3::UnitZ());
    for (int j = 0; j <= across; ++j) {
      // Narrower at the incisors than at the molars.
      const double width = kHalfWidth * (0.6 + 0.4 * std::min(x / 18, 1.0));
      Vec3 p = arch_point(x) + width * (2.0 * j / across - 1) * out + dz * Vec3::UnitZ();
      if (i < 0) p.x() = -p.x();
      mesh.X_mm.col((i + half) * (across + 1) + j) = p;
    }
  }
  Eigen::Index e = 0;
  for (int i = 0; i < 2 * half; ++i)
    for (int j = 0; j < across; ++j) {
      const int a = i * (across + 1) + j, b = a + across + 1;
      const bool left = i >= half;  // diagonals mirror
      const std::array<Eigen::Vector3i, 2> faces =
          left ? std::array<Eigen::Vector3i, 2>{Eigen::Vector3i(a, a + 1, b + 1),
                                                Eigen::Vector3i(a, b + 1, b)}
               : std::array<Eigen::Vector3i, 2>{Eigen::Vector3i(a, a + 1, b),
                                                Eigen::Vector3i(a + 1, b + 1, b)};
      for (Eigen::Vector3i face : faces) {
        const Vec3 x0 = mesh.X_mm.col(face(0));
        const double up = (mesh.X_mm.col(face(1)) - x0).cross(mesh.X_mm.col(face(2)) - x0).z();
        if ((up > 0) != normal_up) std::swap(face(1), face(2));
        mesh.triangles.col(e++) = face;
      }
    }
  return mesh;
}

}  // namespace

Vec3 arch_point(double x) {
  // Flat at the incisors, nearly straight at the molars; the occlusal level rises backwards.
  const double y = -45 + 47 * std::pow(std::abs(x) / 27, 2.3);
  return {x, y, kIncisor.z() + 0.085 * (y + 45)};
}

Distance mandible_distance() {
  return [sheet = mandible_sheet(), teeth = crowns(false)](const Vec3& p) {
    const double bone = smooth_min(distance(sheet, p), head_distance(p), 2.5);
    return smooth_min(bone, distance(teeth, p), 0.5);
  };
}

Distance skull_distance(const FossaProfile& fossa) {
  return [sheet = skull_sheet(), teeth = crowns(true), fossa](const Vec3& p) {
    const double bone = smooth_min(distance(sheet, p), temporal_block_distance(p, fossa), 2.0);
    const double solid = smooth_min(bone, distance(teeth, p), 0.5);
    const Vec3 d = p - kCondyle;  // nothing may stand in the joint
    const bool joint =
        std::abs(d.x()) < 12 && d.y() < 9 && d.y() > -26 && d.z() > -12 && d.z() < 14;
    return joint ? std::max(solid, distance_below_fossa(d, fossa)) : solid;
  };
}

Mesh mandible_surface(double h) {
  return contour_even(mandible_distance(), {-62, -56, 0}, {62, 44, 92}, h);
}

Mesh skull_surface(double h, const FossaProfile& fossa) {
  const auto with_styloid = [skull = skull_distance(fossa),
                             styloid = styloid_sheet()](const Vec3& p) {
    return smooth_min(skull(p), distance(styloid, p), 2);
  };
  return contour_even(with_styloid, kSkullLow, kSkullHigh, h);
}

Mesh skull_without_styloid(double h) {
  return contour_even(skull_distance(), kSkullLow, kSkullHigh, h);
}

Mesh hyoid_surface(double h) {
  return contour_even([sheet = hyoid_sheet()](const Vec3& p) { return distance(sheet, p); },
                      {-28, -2, -16}, {28, 40, 6}, h);
}

Mesh lower_teeth_sheet(double h) { return arch_strip(h, 0, true); }
Mesh upper_teeth_sheet(double h) { return arch_strip(h, kOcclusalGap, false); }

}  // namespace articular::anatomy
