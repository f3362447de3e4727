#include "sim/build/make_supports.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>

#include "sim/base/mistakes.hpp"
#include "sim/base/place_text.hpp"
#include "sim/build/region.hpp"
#include "sim/build/weighted_points.hpp"

namespace articular::sim {
namespace {

/// Axes that differ by less [rad] are one.
constexpr double kSameAxis = 1e-6;

/// A support that holds a node: index into Model::supports, and into the nodes of that.
struct Holder {
  std::size_t support, place;
};

/// Projection onto what is orthogonal to all axes: I − Q Qᵀ, Q by Gram–Schmidt. Exact for axes of
/// space.
Mat3 orthogonal_projection(const Eigen::Matrix3Xd& axes) {
  Mat3 free = Mat3::Identity();
  int held = 0;
  for (const auto& axis : axes.colwise()) {
    const Vec3 rest = free * axis;
    if (!(rest.norm() > kSameAxis)) continue;
    const Vec3 unit = rest.normalized();
    free -= unit * unit.transpose();
    ++held;
  }
  return held < 3 ? free : Mat3(Mat3::Zero());
}

/// "the [[attach]] at jaw.toml:12" that has taken a node of a tissue.
std::string attachment_of(const Scenario& scenario, const Model& model,
                          const std::vector<BodyGeometry>& geometry, const Tissue& tissue, int node,
                          bool on_surface) {
  const int rigid = tissue.nodes[static_cast<std::size_t>(node)].rigid;
  for (const Attachment& attachment : scenario.attachments) {
    const auto to = static_cast<std::size_t>(body_index(scenario, attachment.to));
    if (body_index(scenario, attachment.body) == tissue.body && model.bodies[to].rigid == rigid &&
        RegionTest(attachment.region, tissue.body, model, geometry)
            .contains_node(node, tissue.X.col(node), on_surface))
      return fmt::format("`{}`, by the [[attach]] at {}", attachment.to,
                         place_text(attachment.where));
  }
  return "a body";
}

class Supporter {
 public:
  Supporter(const Scenario& scenario, const std::vector<BodyGeometry>& geometry,
            const std::vector<collision::Surface>& surfaces, Model& model)
      : scenario_(scenario), geometry_(geometry), surfaces_(surfaces), model_(model) {}

  void support_all() {
    holders_.resize(static_cast<std::size_t>(model_.layout.num_free_nodes));
    read_each(scenario_.supports, [&](const Support& support) { add(support); });
    for (std::size_t block = 0; block < holders_.size(); ++block)
      if (!holders_[block].empty()) hold(static_cast<int>(block), holders_[block]);
  }

 private:
  void add(const Support& given) {
    const auto body = static_cast<std::size_t>(body_index(scenario_, given.body));
    SupportModel support{given.name, model_.bodies[body].tissue, {}, Vec3::Zero()};
    const auto t = static_cast<std::size_t>(support.tissue);
    const Tissue& tissue = model_.tissues[t];
    const RegionTest test(given.region, static_cast<int>(body), model_, geometry_);
    const std::vector<char> on_surface = surface_nodes(tissue, surfaces_[t]);
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
      const Vec3 x = tissue.X.col(static_cast<Eigen::Index>(i));
      if (!test.contains_node(static_cast<int>(i), x, on_surface[i] != 0)) continue;
      if (tissue.nodes[i].rigid >= 0)
        refuse_attached(given, tissue, static_cast<int>(i), on_surface[i] != 0);
      holders_[static_cast<std::size_t>(tissue.nodes[i].block)].push_back(
          {model_.supports.size(), support.nodes.size()});
      support.nodes.push_back({static_cast<int>(i), 0, Mat3::Zero()});
      box.extend(x);
    }
    if (support.nodes.empty())
      throw InputError(given.where, fmt::format("no node of tissue `{}` lies in the region of the "
                                                "[[support]]",
                                                given.body));
    support.center = box.center();
    if (const MotionLoad* const motion = motion_of(given)) support.motion = motion->motion;
    axes_.push_back(given.held);
    model_.supports.push_back(std::move(support));
  }

  const MotionLoad* motion_of(const Support& support) const {
    if (support.name.empty()) return nullptr;
    for (const Load& load : scenario_.loads)
      if (const auto* motion = std::get_if<MotionLoad>(&load);
          motion != nullptr && motion->support == support.name)
        return motion;
    return nullptr;
  }

  /// Where axes of supports depend on each other, one of them can't go its own way.
  void check_driven(const std::vector<Holder>& holders) const {
    for (const Holder& holder : holders) {
      const Support& given = scenario_.supports[holder.support];
      const SupportModel& support = model_.supports[holder.support];
      if (!support.motion) continue;
      const Vec3 x = model_.tissues[static_cast<std::size_t>(support.tissue)].X.col(
          support.nodes[holder.place].node);
      const bool is_first = holders.front().support == holder.support;
      const Location& other =
          scenario_.supports[(is_first ? holders.back() : holders.front()).support].where;
      throw InputError(
          given.where,
          fmt::format("support `{}` is driven, and its node of `{}` at {} is "
                      "held along the same direction by the [[support]] at {} too: expected "
                      "regions without common nodes, or other axes",
                      given.name, given.body, place_text(x), place_text(other)));
    }
  }

  [[noreturn]] void refuse_attached(const Support& given, const Tissue& tissue, int node,
                                    bool on_surface) const {
    const Vec3 x = tissue.X.col(node);
    throw InputError(
        given.where,
        fmt::format("the node of `{}` at {} is supported here and attached "
                    "to {}: expected regions without common nodes",
                    given.body, place_text(x),
                    attachment_of(scenario_, model_, geometry_, tissue, node, on_surface)));
  }

  /// Of the force R = B a on all axes B at the node, each support takes what its own axes carry,
  /// with the least a.
  void hold(int block, const std::vector<Holder>& holders) {
    Eigen::Matrix3Xd all(3, 0);
    for (const Holder& holder : holders) {
      const Eigen::Matrix3Xd& own = axes_[holder.support];
      all.conservativeResize(Eigen::NoChange, all.cols() + own.cols());
      all.rightCols(own.cols()) = own;
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> split;
    split.setThreshold(kSameAxis);
    const Eigen::MatrixXd carried = split.compute(all).pseudoInverse();
    if (split.rank() < all.cols()) check_driven(holders);
    const auto held = static_cast<int>(model_.held_blocks.size());
    model_.held_blocks.push_back({block, orthogonal_projection(all)});
    Eigen::Index row = 0;
    for (const Holder& holder : holders) {
      const Eigen::Matrix3Xd& own = axes_[holder.support];
      SupportModel::Node& node = model_.supports[holder.support].nodes[holder.place];
      node.held = held;
      node.share = own * carried.middleRows(row, own.cols());
      row += own.cols();
    }
  }

  const Scenario& scenario_;
  const std::vector<BodyGeometry>& geometry_;
  const std::vector<collision::Surface>& surfaces_;
  Model& model_;
  std::vector<Eigen::Matrix3Xd> axes_;        // of each support
  std::vector<std::vector<Holder>> holders_;  // of each free node, by block
};

}  // namespace

void make_supports(const Scenario& scenario, const std::vector<BodyGeometry>& geometry,
                   const std::vector<collision::Surface>& surfaces, Model& model) {
  if (!scenario.supports.empty()) Supporter(scenario, geometry, surfaces, model).support_all();
}

}  // namespace articular::sim
