#include "tools/anatomy/anatomy_meniscus.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tools/anatomy/anatomy_grid.hpp"
#include "tools/anatomy/anatomy_solids.hpp"

namespace articular::anatomy {
namespace {

/// From the condyle and from the plateau. Together less than kJointGap: a knee without load touches
/// on its menisci first. They are the same for every size of elements, else coarse menisci carry
/// less. So chords of coarse elements enter the condyle, by hundredths of a millimetre.
constexpr double kUpperClearance = 0.06, kLowerClearance = 0.03;
static_assert(kUpperClearance + kLowerClearance < kJointGap);
/// Horns leave the condyle and the plateau, between which nothing may squeeze them.
constexpr double kHornRelief = 1, kHornRise = 0.3;
/// Over kEndWay towards the end of a horn both faces bend to its middle, by this part of what is
/// higher than the inner edge. Else the root, which pulls the end down, presses an edge into the
/// plateau.
constexpr double kEndWay = 7, kEndThinning = 0.5;

/// The inner edge: its height, how far its middle stands out, how far each face has left its
/// cartilage there. The outer rim: how far its middle stands out, by how much the upper and the
/// lower face bend towards it. Faces bend over kBendWay.
constexpr double kEdgeHeight = 0.75, kEdgeRound = 0.3, kEdgeRelief = 0.25;
constexpr double kRimRound = 1, kRimBend = 1, kRimLift = 0.2, kBendWay = 2.5;
constexpr double kRimBlend = 2;  // width over which the upper face gets level

/// From above.
struct RimPlace {
  Eigen::Vector2d point, inward;  // on the outer rim; across it, of length 1
  double to_end;                  // along a straight horn
};

/// An ellipse, and straight on from it along the horns. psi: 0 at the middle of the rim, < 0 in
/// front.
RimPlace rim_place(const Compartment& c, double psi) {
  const double bent = std::clamp(psi, -c.straight_front, c.straight_back);
  const Eigen::Vector2d middle(c.side * kCompartmentX, 0);
  const Eigen::Vector2d ray(c.side * c.rim_width * std::cos(bent), c.rim_depth * std::sin(bent));
  const Eigen::Vector2d along(-c.side * c.rim_width * std::sin(bent), c.rim_depth * std::cos(bent));
  return {middle + ray + (psi - bent) * along, -ray.normalized(),
          (c.horn_angle - std::abs(psi)) * along.norm()};
}

/// From 0 to 1, level at both ends; t in [0, 1].
double smooth_step(double t) { return t * t * (3 - 2 * t); }

/// Between what is published of the front, the middle and the back.
double along_rim(double psi, double front, double middle, double back) {
  const double share = smooth_step(std::min(std::abs(psi) / (90 * kDeg), 1.0));
  return middle + share * ((psi < 0 ? front : back) - middle);
}

/// 0 along the rim, 1 at the ends of the horns.
double horn_share(const Compartment& c, double psi) {
  constexpr double kBegin = 0.7;
  const double t = std::clamp((std::abs(psi) / c.horn_angle - kBegin) / (1 - kBegin), 0.0, 1.0);
  return smooth_step(t);
}

/// 1 at a distance of 0, nothing from `way` on.
double fade(double distance, double way) {
  const double t = std::max(1 - distance / way, 0.0);
  return t * t;
}

/// One section, across the rim.
class MeniscusSection {
 public:
  MeniscusSection(const Compartment& c, double psi)
      : c_(c),
        rim_(rim_place(c, psi)),
        horn_(horn_share(c, psi)),
        end_(fade(rim_.to_end, kEndWay)),
        upper_((1 - horn_) * kUpperClearance),
        lower_((1 - horn_) * kLowerClearance + horn_ * kHornRise),
        height_(along_rim(psi, c.front_height, c.middle_height, c.back_height)) {
    // The horn in front gets narrower towards its root; the one behind leaves no room to be wider.
    const double front = c.front_width + horn_ * (c.middle_width - c.front_width);
    width_ = along_rim(psi, front, c.middle_width, c.back_width);
    constexpr double kStep = 0.01;  // as wide as there is room
    for (; width_ > 1; width_ -= kStep) {
      narrow_ = std::min(width_ / c.middle_width, 1.0);
      if (ceiling(plan(0), 0) - floor(plan(0), 0) > kEdgeHeight) break;
    }
  }

  /// @param v  -1 at the inner edge, 1 at the outer rim
  /// @param w  0 on the lower face, 1 on the upper one
  Vec3 place(double v, double w) const {
    constexpr double kGrading = 0.3;  // elements are narrow at the edge, where the faces bend
    const double t = (v + 1) / 2, along = width_ * t * (1 - kGrading + kGrading * t);
    const double round = kEdgeRound * (1 - t) * (1 - t) - kRimRound * t * t;
    const Eigen::Vector2d p = plan(along + narrow_ * round * (2 * w - 1) * (2 * w - 1));
    const double bottom = floor(p, along), height = ceiling(p, along) - bottom;
    const double thinner = kEndThinning * end_ * std::max(height - kEdgeHeight, 0.0);
    return {p.x(), p.y(), bottom + thinner / 2 + w * (height - thinner)};
  }

 private:
  /// From above. @param along  from the inner edge outwards
  Eigen::Vector2d plan(double along) const { return rim_.point + (width_ - along) * rim_.inward; }
  double along_plateau(const Eigen::Vector2d& p) const {
    return plateau_height(c_, p.x(), p.y()) + lower_;
  }
  double floor(const Eigen::Vector2d& p, double along) const {
    return along_plateau(p) + narrow_ * bend(along, kRimLift);
  }
  double ceiling(const Eigen::Vector2d& p, double along) const {
    const double along_condyle = condyle_height(c_, p.x(), p.y(), upper_) - kHornRelief * horn_;
    return smooth_min(along_condyle, along_plateau(p) + height_, kRimBlend) -
           narrow_ * bend(along, kRimBend);
  }
  /// How far a face has left its cartilage. @param rim  by how much at the outer rim
  double bend(double along, double rim) const {
    return kEdgeRelief * fade(along, narrow_ * kBendWay) +
           rim * fade(width_ - along, narrow_ * kBendWay);
  }

  const Compartment& c_;
  RimPlace rim_;
  double horn_, end_;
  double upper_, lower_;           // clearance of both faces
  double height_;                  // of the rim, where the condyle leaves room
  double width_ = 0, narrow_ = 1;  // roundings of a narrow section are smaller by this factor
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

Mesh meniscus(const Compartment& c, const KneeResolution& resolution) {
  check_resolution(resolution);
  const double h = resolution.size_mm;
  constexpr double kLength = 75;   // along its middle, about
  constexpr int kLeastCells = 22;  // with fewer, tetrahedra at the inner edge of a bend are flat
  const CellGrid grid{even_cells(kLength, h, kLeastCells), even_cells(c.middle_width, h, 4),
                      resolution.layers};
  Mesh mesh = grid.fill([&](double u, double v, double w) -> Vec3 {
    return MeniscusSection(c, u * c.horn_angle).place(v, w);
  });
  mesh.fibres = rim_fibres(mesh, grid);
  return mesh;
}

Vec3 horn(const Compartment& c, int end) {
  return MeniscusSection(c, end * c.horn_angle).place(0, 0.5);
}

}  // namespace articular::anatomy
