#include "sim/base/pose.hpp"

namespace articular::sim {

Mat3 rotation_matrix(const Vec3& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle == 0) return Mat3::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
}

void turn(double* q, const Vec3& rotation_vector) {
  const Eigen::Quaterniond turned = Eigen::Quaterniond(rotation_matrix(rotation_vector)) *
                                    Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  q[0] = turned.w();
  q[1] = turned.x();
  q[2] = turned.y();
  q[3] = turned.z();
}

}  // namespace articular::sim
