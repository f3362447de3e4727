#include "fem/element/fibre_sheet.hpp"

#include <Eigen/Geometry>
#include <sstream>
#include <stdexcept>

namespace articular::fem {
namespace {

[[noreturn]] void refuse(const Mat3& corners, const char* why) {
  std::ostringstream message;
  message << "its face at (" << 1e3 * corners.rowwise().mean().transpose() << ") mm " << why;
  throw std::invalid_argument(message.str());
}

}  // namespace

FibreSheet::FibreSheet(const Positions& X, const Triangles& faces, const Eigen::Matrix3Xd& fibres,
                       double thickness, const CrimpedFibre& law, const BlockMatrix& matrix)
    : faces_(faces),
      along_(3, faces.cols()),
      area_(faces.cols()),
      thickness_(thickness),
      law_(law) {
  for (Eigen::Index i = 0; i < faces.cols(); ++i) {
    const Mat3 corners = X(Eigen::all, faces.col(i));
    const Vec3 doubled_area =
        (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
    area_[i] = 0.5 * doubled_area.norm();
    if (!(area_[i] > 0)) refuse(corners, "has no area");
    const Vec3 normal = doubled_area.normalized(), given = fibres.col(i);
    const Vec3 within = given - normal.dot(given) * normal;
    constexpr double kCrosses = 0.1;  // sine of the angle, below which rounding and mesh decide
    if (!(within.norm() > kCrosses * given.norm())) refuse(corners, "is crossed by the fibres");
    for (int a = 0; a < 3; ++a) {
      const Vec3 opposite = corners.col((a + 2) % 3) - corners.col((a + 1) % 3);
      along_(a, i) = normal.cross(opposite).dot(within.normalized()) / (2 * area_[i]);
    }
    for (const int b : faces.col(i))
      for (const int a : faces.col(i)) slots_.push_back(matrix.slot(a, b));
  }
}

Vec3 FibreSheet::fibre(const Positions& x, Eigen::Index face) const {
  return x(Eigen::all, faces_.col(face)) * along_.col(face);
}

double FibreSheet::energy(const Positions& x) const {
  double energy = 0;
  for (Eigen::Index i = 0; i < faces_.cols(); ++i)
    energy += thickness_ * area_[i] * law_.energy(fibre(x, i).norm() - 1);
  return energy;
}

void FibreSheet::add_force(const Positions& x, Positions& f) const {
  for (Eigen::Index i = 0; i < faces_.cols(); ++i) {
    const Vec3 along = fibre(x, i);
    const double stretch = along.norm(), tension = law_.tension(stretch - 1).value;
    if (tension == 0) continue;
    const Vec3 pull = (thickness_ * area_[i] * tension / stretch) * along;
    for (int a = 0; a < 3; ++a) f.col(faces_(a, i)) += along_(a, i) * pull;
  }
}

void FibreSheet::add_stiffness(const Positions& x, double scale, BlockMatrix& K) const {
  for (Eigen::Index i = 0; i < faces_.cols(); ++i) {
    const Vec3 along = fibre(x, i);
    const double stretch = along.norm();
    const ValueSlope tension = law_.tension(stretch - 1);
    if (tension.value == 0) continue;
    const Vec3 n = along / stretch;
    const double turning = tension.value / stretch;
    const Mat3 k = scale * thickness_ * area_[i] *
                   ((tension.slope - turning) * n * n.transpose() + turning * Mat3::Identity());
    const int* slot = slots_.data() + 9 * i;
    for (int b = 0; b < 3; ++b)
      for (int a = 0; a < 3; ++a) K.block(*slot++) += along_(a, i) * along_(b, i) * k;
  }
}

Eigen::VectorXd FibreSheet::stretch(const Positions& x) const {
  return Eigen::VectorXd::NullaryExpr(faces_.cols(),
                                      [&](Eigen::Index i) { return fibre(x, i).norm(); });
}

Eigen::VectorXd FibreSheet::tension(const Positions& x) const {
  return Eigen::VectorXd::NullaryExpr(faces_.cols(), [&](Eigen::Index i) {
    return thickness_ * law_.tension(fibre(x, i).norm() - 1).value;
  });
}

}  // namespace articular::fem
