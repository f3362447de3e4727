#include "sim/assembly/rigid_body_modes.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "fem/sparse/pressure_term.hpp"
#include "sim/model/newton_weights.hpp"

namespace articular::sim {
namespace {

/// A motion that moves nothing farther than 1 counts as free when its stiffness is below this part
/// of the stiffest diagonal entry: round-off of K leaves 1e-12.
constexpr double kFree = 1e-10;

/// A motion counts as driven when forces do more work on it than this part of the largest force.
constexpr double kDriven = 1e-6;

/// Six rigid motions of one body, of its unknown blocks.
struct BodyMotions {
  int body = 0;
  Vec3 center = Vec3::Zero();  // [m]
  double radius = 0;           // [m] farthest point from there
};

/// Free blocks of a body and where they are; a rigid body's own two blocks are added by the caller.
std::vector<std::pair<int, Vec3>> free_nodes(const Model& model, const Configuration& now,
                                             const BodyModel& body) {
  std::vector<std::pair<int, Vec3>> nodes;
  if (body.tissue < 0) return nodes;
  for (const NodeRef& node : model.tissues[static_cast<std::size_t>(body.tissue)].nodes)
    if (node.rigid < 0) nodes.emplace_back(node.block, now.position(node));
  return nodes;
}

/// Whether the nodes of a tissue that go with some rigid bodies are three that are not on one line:
/// then no rigid motion of the tissue leaves them where they are.
template <class Takes>
bool ties(const Tissue& tissue, const Takes& takes) {
  constexpr double kOnOneLine = 1e-6;  // of the distance to the farthest
  std::vector<Vec3> tied;
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
    if (tissue.nodes[i].rigid >= 0 && takes(tissue.nodes[i].rigid))
      tied.emplace_back(tissue.X.col(static_cast<Eigen::Index>(i)));
  if (tied.empty()) return false;
  Vec3 far = Vec3::Zero();
  for (const Vec3& x : tied)
    if ((x - tied[0]).norm() > far.norm()) far = x - tied[0];
  return std::any_of(tied.begin(), tied.end(), [&](const Vec3& x) {
    return far.cross(x - tied[0]).norm() > kOnOneLine * far.squaredNorm();
  });
}

/// Of each body: whether attachments alone hold it. Fixed and driven bodies are held, and those
/// without a free freedom; so is tissue that these tie, and a rigid body that such tissue ties.
/// This does not ask the stiffness, which away from equilibrium may be negative.
std::vector<char> held_by_attachments(const Model& model) {
  std::vector<char> is_held(model.rigid_bodies.size(), 0), tissue_is_held(model.tissues.size(), 0);
  for (std::size_t r = 0; r < model.rigid_bodies.size(); ++r) {
    const RigidBody& rigid = model.rigid_bodies[r];
    is_held[r] = !rigid.unknown ||
                 (rigid.hold && std::all_of(rigid.hold->held.begin(), rigid.hold->held.end(),
                                            [](bool held) { return held; }));
  }
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (std::size_t t = 0; t < model.tissues.size(); ++t) {
      const Tissue& tissue = model.tissues[t];
      const auto of = [](int rigid) { return static_cast<std::size_t>(rigid); };
      if (tissue_is_held[t] || !ties(tissue, [&](int r) { return is_held[of(r)] != 0; })) continue;
      tissue_is_held[t] = 1;
      goes_on = true;
      for (int r = 0; r < static_cast<int>(is_held.size()); ++r)
        if (!is_held[of(r)]) is_held[of(r)] = ties(tissue, [&](int other) { return other == r; });
    }
  }
  std::vector<char> result;
  for (const BodyModel& body : model.bodies)
    result.push_back(body.tissue >= 0 ? tissue_is_held[static_cast<std::size_t>(body.tissue)]
                                      : is_held[static_cast<std::size_t>(body.rigid)]);
  return result;
}

/// Appends the columns of a body: three translations, three turns by 1/radius about its centre.
void append_motions(const Model& model, const Configuration& now, int b,
                    std::vector<BodyMotions>& bodies, std::vector<Eigen::VectorXd>& columns) {
  const BodyModel& body = model.bodies[static_cast<std::size_t>(b)];
  const bool is_rigid =
      body.rigid >= 0 && model.rigid_bodies[static_cast<std::size_t>(body.rigid)].unknown;
  const auto nodes = free_nodes(model, now, body);
  if (!is_rigid && nodes.empty()) return;
  BodyMotions motions{.body = b};
  if (is_rigid) {
    const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(body.rigid)];
    motions.center = now.poses[static_cast<std::size_t>(body.rigid)].p;
    motions.radius = turning_radius(rigid);
  } else {
    for (const auto& [block, x] : nodes) motions.center += x / static_cast<double>(nodes.size());
    for (const auto& [block, x] : nodes)
      motions.radius = std::max(motions.radius, (x - motions.center).norm());
  }
  for (int k = 0; k < 6; ++k) {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(3 * model.layout.num_unknown_blocks());
    Vec3 axis = Vec3::Unit(k % 3);
    if (is_rigid) {
      const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(body.rigid)];
      const int row = 3 * rigid.block;
      if (rigid.hold) axis = rigid.hold->axes.col(k % 3);
      if (rigid.hold && rigid.hold->held[static_cast<std::size_t>(k)]) axis.setZero();
      if (k < 3) column.segment<3>(row) = axis;
      if (k >= 3) column.segment<3>(row + 3) = axis / motions.radius;
    }
    for (const auto& [block, x] : nodes)
      column.segment<3>(3 * block) =
          k < 3 ? axis : Vec3(axis.cross(x - motions.center) / motions.radius);
    columns.push_back(std::move(column));
  }
  bodies.push_back(motions);
}

/// To two decimals, without a negative zero.
Vec3 rounded(const Vec3& v) { return (100 * v).array().round() / 100 + 0.0; }

/// The largest stiffness of a free node or of a rigid body's translation [N/m].
double stiffest_node(const Model& model, const fem::BlockMatrix& K) {
  double stiffest = 0;
  const auto look_at = [&](int block) {
    stiffest = std::max(stiffest, K.block(K.slot(block, block)).diagonal().maxCoeff());
  };
  for (int block = 0; block < model.layout.num_free_nodes; ++block) look_at(block);
  for (int r = 0; r < model.layout.num_rigid; ++r)
    look_at(model.rigid_bodies[static_cast<std::size_t>(r)].block);
  return stiffest;
}

}  // namespace

std::string rigid_motion_in_words(const Vec3& shift, const Vec3& turn, const Vec3& center) {
  const bool shifts = shift.norm() >= turn.norm();
  const Vec3 axis = rounded((shifts ? shift : turn).normalized());
  if (shifts)
    return fmt::format("shift along ({:.2f} {:.2f} {:.2f})", axis.x(), axis.y(), axis.z());
  const Vec3 mm = 1e3 * center;
  return fmt::format("turn about the axis ({:.2f} {:.2f} {:.2f}) through ({:.3g} {:.3g} {:.3g}) mm",
                     axis.x(), axis.y(), axis.z(), mm.x(), mm.y(), mm.z());
}

std::optional<RigidBodyMode> find_rigid_body_mode(const Model& model, Dynamics& dynamics) {
  std::vector<BodyMotions> bodies;
  std::vector<Eigen::VectorXd> columns;
  const std::vector<char> is_held = held_by_attachments(model);
  for (int b = 0; b < static_cast<int>(model.bodies.size()); ++b)
    if (!is_held[static_cast<std::size_t>(b)])
      append_motions(model, dynamics.now().configuration, b, bodies, columns);
  if (columns.empty()) return std::nullopt;

  const NewtonEquations stiffness = dynamics.assemble({0, 0, 1}, fem::Tangent::Consistent);
  const fem::BlockMatrix& K = stiffness.A;
  fem::PressureOperator by_pressure;
  by_pressure.set(stiffness.pressure.terms);
  const auto n = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd projected(n, n);
  Eigen::VectorXd product, drive(n);
  const double stiffest = stiffest_node(model, K);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::VectorXd& column = columns[static_cast<std::size_t>(j)];
    K.multiply(column, product);
    by_pressure.add_product(column, product);
    for (Eigen::Index i = 0; i < n; ++i)
      projected(i, j) = columns[static_cast<std::size_t>(i)].dot(product);
    drive[j] = column.dot(dynamics.now().forces.head(column.size()));
    if (column.isZero(0)) projected(j, j) = stiffest;  // held
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 *
                                                             (projected + projected.transpose()));
  Eigen::Index num_free = 0;
  const double limit = kFree * stiffest;
  while (num_free < n && eigen.eigenvalues()[num_free] <= limit) ++num_free;
  if (num_free == 0) return std::nullopt;

  const auto null_space = eigen.eigenvectors().leftCols(num_free);
  Eigen::VectorXd motion = null_space * (null_space.transpose() * drive);
  if (!(motion.norm() > kDriven * dynamics.now().largest_force)) motion = null_space.col(0);
  const auto part = [&](std::size_t b) -> Eigen::Matrix<double, 6, 1> {
    return motion.segment<6>(6 * static_cast<Eigen::Index>(b));
  };
  std::size_t most = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (part(b).norm() > part(most).norm()) most = b;
  const BodyMotions& body = bodies[most];
  return RigidBodyMode{
      body.body,
      fmt::format("body `{}` can {}", model.bodies[static_cast<std::size_t>(body.body)].name,
                  rigid_motion_in_words(part(most).head<3>(), part(most).tail<3>(), body.center))};
}

}  // namespace articular::sim
