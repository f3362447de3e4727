#include "sim/lines/wrapped_stiffness.hpp"

#include <algorithm>

#include "sim/wrap/string_hessian.hpp"

namespace articular::sim {
namespace {

/// Unknown blocks that a line moves with, each once, in the order of their coordinates.
std::vector<int> blocks_of(const Model& model, const Line& line) {
  std::vector<int> blocks;
  for (const WeightedPoint& point : line.path)
    for (const NodeRef& node : point.nodes) append_blocks(model, node, blocks);
  for (const int b : line.wrap.bodies) {
    const int rigid = model.wrap_bodies[static_cast<std::size_t>(b)].rigid;
    append_blocks(model,
                  {model.rigid_bodies[static_cast<std::size_t>(rigid)].block, rigid, Vec3::Zero()},
                  blocks);
  }
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  return blocks;
}

/// A point's motion with the blocks: a rigid body's is δp − [r]× δθ.
struct Motions {
  const Model& model;
  const Configuration& configuration;
  const std::vector<int>& blocks;

  Eigen::Index column(int block) const {
    return 3 * (std::lower_bound(blocks.begin(), blocks.end(), block) - blocks.begin());
  }
  void add_point(const WeightedPoint& point, Eigen::Index row, Eigen::MatrixXd& m) const {
    for (std::size_t k = 0; k < point.nodes.size(); ++k) {
      const NodeRef& node = point.nodes[k];
      if (node.rigid >= model.layout.num_rigid) continue;
      m.block<3, 3>(row, column(node.block)) += point.weights[k] * Mat3::Identity();
      if (node.rigid >= 0)
        m.block<3, 3>(row, column(node.block + 1)) -=
            point.weights[k] * skew(configuration.lever(node));
    }
  }
  /// An edge turns with its body.
  void add_edge(int rigid, const Vec3& edge, Eigen::Index row, Eigen::MatrixXd& m) const {
    if (rigid >= model.layout.num_rigid) return;
    const int block = model.rigid_bodies[static_cast<std::size_t>(rigid)].block;
    m.block<3, 3>(row, column(block + 1)) -= skew(edge);
  }
};

}  // namespace

void add_wrapped_stiffness(const Model& model, const Line& line, const LinePath& path,
                           const Configuration& configuration, const LineState& state,
                           const SystemScale& scale, bool hold, fem::BlockMatrix& A) {
  const std::vector<int> blocks = blocks_of(model, line);
  const auto size = static_cast<Eigen::Index>(3 * blocks.size());
  if (size == 0) return;
  const Motions motions{model, configuration, blocks};
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size);
  std::size_t first = 0;  // point of the string
  for (std::size_t k = 0; k < path.strings.size(); ++k) {
    const StringShape& shape = path.works[k].shape;
    const auto n = static_cast<Eigen::Index>(shape.e.size());
    StringMotion motion{Eigen::MatrixXd::Zero(3 * n + 6, size), Eigen::MatrixXd::Zero(3 * n, size)};
    for (Eigen::Index i = 0; i < n + 2; ++i)
      motions.add_point(path.points[first + static_cast<std::size_t>(i)], 3 * i, motion.points);
    for (Eigen::Index i = 0; i < n; ++i)
      motions.add_edge(path.points[first + 1 + static_cast<std::size_t>(i)].nodes[0].rigid,
                       shape.e[static_cast<std::size_t>(i)], 3 * i, motion.edges);
    K += scale.stiffness * state.tension *
         (hold ? held_hessian(shape, motion) : taut_hessian(shape, motion));
    for (Eigen::Index i = 0; i <= n; ++i)
      gradient += (motion.points.middleRows<3>(3 * i + 3) - motion.points.middleRows<3>(3 * i))
                      .transpose() *
                  shape.u[static_cast<std::size_t>(i)];
    first += static_cast<std::size_t>(n) + 1;
  }
  K += (scale.stiffness * state.stiffness + scale.damping * state.viscosity) * gradient *
       gradient.transpose();
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (std::size_t j = 0; j < blocks.size(); ++j)
      A.block(A.slot(blocks[i], blocks[j])) +=
          K.block<3, 3>(3 * static_cast<Eigen::Index>(i), 3 * static_cast<Eigen::Index>(j));
}

void append_wrapped_stencil(const Model& model, const Line& line, Stencils& stencils) {
  const std::vector<int> blocks = blocks_of(model, line);
  stencils.blocks.insert(stencils.blocks.end(), blocks.begin(), blocks.end());
  stencils.close();
}

}  // namespace articular::sim
