#include "tools/report/rigid_pose.hpp"

#include <Eigen/Geometry>

namespace articular::tools {

std::array<double, 12> rigid_pose(const Positions& before, const Positions& now) {
  const Eigen::Matrix4d motion = Eigen::umeyama(before, now, false);
  std::array<double, 12> pose{};
  std::size_t i = 0;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) pose[i++] = motion(row, column);
  return pose;
}

}  // namespace articular::tools
