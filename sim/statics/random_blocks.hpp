#pragma once

#include <Eigen/Core>
#include <random>

namespace articular::sim {

/// n numbers of [-½, ½] that have a part along any motion or load. The same everywhere: raw numbers
/// of the generator are, those of distributions are not.
inline Eigen::VectorXd random_blocks(Eigen::Index n) {
  std::mt19937 random(1);
  Eigen::VectorXd blocks(n);
  for (double& entry : blocks)
    entry = static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 0.5;
  return blocks;
}

}  // namespace articular::sim
