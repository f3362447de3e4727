#include "sim/model/angular_momentum.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace articular::sim {

void keep_angular_momentum(const Model& model, const Eigen::VectorXd& before, double h,
                           Eigen::VectorXd& after) {
  const Layout& layout = model.layout;
  for (int r = 0; r < layout.num_rigid; ++r) {
    const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(r)];
    if (rigid.hold) continue;
    const auto inertia = [&](const Eigen::VectorXd& y) -> Mat3 {
      const Eigen::Vector4d q = y.segment<4>(layout.rigid_q(r)).normalized();
      const Mat3 R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
      return R * rigid.mass.inertia * R.transpose();
    };
    const int row = layout.velocities() + 3 * rigid.block + 3;
    const Mat3 I0 = inertia(before), I1 = inertia(after);
    const Vec3 omega0 = before.segment<3>(row), omega1 = after.segment<3>(row);
    const Vec3 impulse = I1 * (omega1 - omega0) + h * omega1.cross(I1 * omega1);
    after.segment<3>(row) = I1.llt().solve(I0 * omega0 + impulse);
  }
}

}  // namespace articular::sim
