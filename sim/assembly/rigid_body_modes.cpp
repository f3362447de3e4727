#include "sim/assembly/rigid_body_modes.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "fem/sparse/pressure_term.hpp"
#include "sim/model/newton_weights.hpp"

namespace articular::sim {
namespace {

/// A motion that moves nothing farther than 1 counts as free when its stiffness is no more than
/// this part of the stiffest diagonal entry: round-off of K leaves 1e-12. One with a negative
/// stiffness is driven off by the load, not free.
constexpr double kFree = 1e-10;

/// A motion counts as driven when forces do more work on it than this part of the largest force.
constexpr double kDriven = 1e-6;

/// More bodies that hang together, or touch each other, are not looked at: it would take the cube
/// of their number.
constexpr std::size_t kMostTogether = 100;

/// Six rigid motions of one body, of its unknown blocks.
struct BodyMotions {
  int body = 0;
  Vec3 center = Vec3::Zero();              // [m]
  double radius = 0;                       // [m] farthest point from there
  Mat3 axes = Mat3::Identity();            // along and about which it moves
  std::vector<int> blocks;                 // that move,
  std::array<std::vector<Vec3>, 6> moves;  // and how: three translations, three turns by 1/radius
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
      std::set<int> carriers;
      for (const NodeRef& node : tissue.nodes)
        if (node.rigid >= 0) carriers.insert(node.rigid);
      for (const int r : carriers)
        if (!is_held[of(r)]) is_held[of(r)] = ties(tissue, [&](int other) { return other == r; });
    }
  }
  std::vector<char> result;
  for (const BodyModel& body : model.bodies)
    result.push_back(body.tissue >= 0 ? tissue_is_held[static_cast<std::size_t>(body.tissue)]
                                      : is_held[static_cast<std::size_t>(body.rigid)]);
  return result;
}

/// None of a body without unknowns.
void append_motions(const Model& model, const Configuration& now, int b,
                    std::vector<BodyMotions>& bodies) {
  const BodyModel& body = model.bodies[static_cast<std::size_t>(b)];
  const bool is_rigid =
      body.rigid >= 0 && model.rigid_bodies[static_cast<std::size_t>(body.rigid)].unknown;
  const auto nodes = free_nodes(model, now, body);
  if (!is_rigid && nodes.empty()) return;
  BodyMotions motions;
  motions.body = b;
  if (is_rigid) {
    const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(body.rigid)];
    motions.center = now.poses[static_cast<std::size_t>(body.rigid)].p;
    motions.radius = turning_radius(rigid);
    motions.blocks = {rigid.block, rigid.block + 1};
    if (rigid.hold) motions.axes = rigid.hold->axes;
  } else {
    for (const auto& [block, x] : nodes) motions.center += x / static_cast<double>(nodes.size());
    for (const auto& [block, x] : nodes) {
      motions.radius = std::max(motions.radius, (x - motions.center).norm());
      motions.blocks.push_back(block);
    }
  }
  for (int k = 0; k < 6; ++k) {
    Vec3 axis = motions.axes.col(k % 3);
    std::vector<Vec3>& move = motions.moves[static_cast<std::size_t>(k)];
    if (is_rigid) {
      const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(body.rigid)];
      if (rigid.hold && rigid.hold->held[static_cast<std::size_t>(k)]) axis.setZero();
      const Vec3 none = Vec3::Zero();
      move = k < 3 ? std::vector{axis, none} : std::vector<Vec3>{none, axis / motions.radius};
      continue;
    }
    for (const auto& [block, x] : nodes)
      move.push_back(k < 3 ? axis : Vec3(axis.cross(x - motions.center) / motions.radius));
  }
  bodies.push_back(std::move(motions));
}

double dot(const BodyMotions& body, int k, const Eigen::VectorXd& v) {
  double sum = 0;
  const std::vector<Vec3>& move = body.moves[static_cast<std::size_t>(k)];
  for (std::size_t i = 0; i < move.size(); ++i)
    sum += move[i].dot(v.segment<3>(3 * body.blocks[i]));
  return sum;
}

/// Sets of bodies, each with its number in a list, that grow together.
class BodySets {
 public:
  explicit BodySets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) {
      int& up = parent_[static_cast<std::size_t>(i)];
      up = parent_[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  }
  void unite(int i, int j) {
    const int p = root(i), q = root(j);
    parent_[static_cast<std::size_t>(std::max(p, q))] = std::min(p, q);
  }

 private:
  std::vector<int> parent_;
};

/// Bodies, by their numbers in the list, that the stiffness couples with each other, however
/// indirectly; pressures couple all that a tissue's nodes move with.
std::vector<std::vector<int>> coupled_groups(const Model& model, const fem::BlockMatrix& K,
                                             const std::vector<BodyMotions>& bodies) {
  std::vector<int> owner(static_cast<std::size_t>(K.num_blocks()), -1);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (const int block : bodies[b].blocks)
      owner[static_cast<std::size_t>(block)] = static_cast<int>(b);
  BodySets sets(bodies.size());
  for (int i = 0; i < K.num_blocks(); ++i)
    for (int s = K.row_begin()[static_cast<std::size_t>(i)];
         s < K.row_begin()[static_cast<std::size_t>(i) + 1]; ++s) {
      const int p = owner[static_cast<std::size_t>(i)],
                q = owner[static_cast<std::size_t>(K.column()[static_cast<std::size_t>(s)])];
      if (p >= 0 && q >= 0 && p != q && !K.block(s).isZero(0)) sets.unite(p, q);
    }
  for (const Tissue& tissue : model.tissues) {
    int first = -1;
    for (const NodeRef& node : tissue.nodes) {
      const bool is_unknown = node.rigid < model.layout.num_rigid;
      const int p = is_unknown ? owner[static_cast<std::size_t>(node.block)] : -1;
      if (p < 0) continue;
      if (first < 0) first = p;
      sets.unite(first, p);
    }
  }
  std::map<int, std::vector<int>> by_root;
  for (int b = 0; b < static_cast<int>(bodies.size()); ++b) by_root[sets.root(b)].push_back(b);
  std::vector<std::vector<int>> groups;
  for (auto& [root, group] : by_root)
    if (group.size() <= kMostTogether) groups.push_back(std::move(group));
  return groups;
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

namespace {

/// Zᵀ K Z of the motions Z of some bodies, and Zᵀ f.
struct Projected {
  Eigen::MatrixXd stiffness;
  Eigen::VectorXd drive;
};

/// Of each group. As they are not coupled, the same column of all takes one product.
std::vector<Projected> projected(const std::vector<std::vector<int>>& groups,
                                 const std::vector<BodyMotions>& bodies, const Moment& now,
                                 const NewtonEquations& equations, double stiffest) {
  const auto motions = [&](const std::vector<int>& group, Eigen::Index column) -> const auto& {
    return bodies[static_cast<std::size_t>(group[static_cast<std::size_t>(column / 6)])];
  };
  fem::PressureOperator by_pressure;
  by_pressure.set(equations.pressure.terms);
  std::vector<Projected> result;
  Eigen::Index most = 0;
  for (const std::vector<int>& group : groups) {
    const auto n = 6 * static_cast<Eigen::Index>(group.size());
    result.push_back({Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)});
    most = std::max(most, n);
  }
  Eigen::VectorXd columns, product;
  for (Eigen::Index j = 0; j < most; ++j) {
    columns = Eigen::VectorXd::Zero(3 * equations.A.num_blocks());
    const auto k = static_cast<int>(j % 6);
    const auto for_each = [&](const auto& visit) {
      for (std::size_t g = 0; g < groups.size(); ++g)
        if (j < result[g].drive.size()) visit(groups[g], motions(groups[g], j), result[g]);
    };
    for_each([&](const auto&, const BodyMotions& body, const auto&) {
      for (std::size_t i = 0; i < body.blocks.size(); ++i)
        columns.segment<3>(3 * body.blocks[i]) = body.moves[static_cast<std::size_t>(k)][i];
    });
    equations.A.multiply(columns, product);
    by_pressure.add_product(columns, product);
    for_each([&](const std::vector<int>& group, const BodyMotions& body, Projected& of_group) {
      for (Eigen::Index i = 0; i < of_group.drive.size(); ++i)
        of_group.stiffness(i, j) = dot(motions(group, i), static_cast<int>(i % 6), product);
      of_group.drive[j] = dot(body, k, now.forces);
      if (dot(body, k, columns) == 0) of_group.stiffness(j, j) = stiffest;  // held
    });
  }
  return result;
}

/// The null space of a stiffness, and what of a drive lies in it.
struct FreeMotions {
  Eigen::MatrixXd all;
  Eigen::VectorXd driven;
};

FreeMotions free_motions(const Projected& of_group, double limit) {
  const Eigen::MatrixXd& K = of_group.stiffness;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (K + K.transpose()));
  const Eigen::VectorXd& values = eigen.eigenvalues();  // they rise
  const Eigen::Index first = (values.array() < -limit).count();
  const Eigen::Index count = (values.array() <= limit).count() - first;
  FreeMotions found{eigen.eigenvectors().middleCols(first, count), {}};
  found.driven = found.all * (found.all.transpose() * of_group.drive);
  return found;
}

}  // namespace

std::optional<RigidBodyMode> find_rigid_body_mode(const Model& model, Dynamics& dynamics) {
  std::vector<BodyMotions> bodies;
  const std::vector<char> is_held = held_by_attachments(model);
  for (int b = 0; b < static_cast<int>(model.bodies.size()); ++b)
    if (!is_held[static_cast<std::size_t>(b)])
      append_motions(model, dynamics.now().configuration, b, bodies);
  if (bodies.empty()) return std::nullopt;

  const NewtonEquations equations = dynamics.assemble({0, 0, 1}, fem::Tangent::Consistent);
  const double stiffest = stiffest_node(model, equations.A);
  const auto groups = coupled_groups(model, equations.A, bodies);
  std::vector<Eigen::VectorXd> motions;  // of each group
  std::optional<std::size_t> first_free;
  Eigen::VectorXd any;
  double squares = 0;
  for (const Projected& of_group : projected(groups, bodies, dynamics.now(), equations, stiffest)) {
    const FreeMotions found = free_motions(of_group, kFree * stiffest);
    if (found.all.cols() > 0 && !first_free) {
      first_free = motions.size();
      any = found.all.col(0);
    }
    motions.push_back(found.driven);
    squares += found.driven.squaredNorm();
  }
  if (!first_free) return std::nullopt;
  if (!(std::sqrt(squares) > kDriven * dynamics.now().largest_force)) {
    for (Eigen::VectorXd& motion : motions) motion.setZero();
    motions[*first_free] = any;
  }
  Eigen::Matrix<double, 6, 1> part = Eigen::Matrix<double, 6, 1>::Zero();
  const BodyMotions* most = nullptr;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t i = 0; i < groups[g].size(); ++i) {
      const Eigen::Matrix<double, 6, 1> own =
          motions[g].segment<6>(6 * static_cast<Eigen::Index>(i));
      const BodyMotions& body = bodies[static_cast<std::size_t>(groups[g][i])];
      const bool is_most = most == nullptr || own.norm() > part.norm() ||
                           (own.norm() == part.norm() && body.body < most->body);
      if (!is_most) continue;
      part = own;
      most = &body;
    }
  return RigidBodyMode{
      most->body,
      fmt::format("body `{}` can {}", model.bodies[static_cast<std::size_t>(most->body)].name,
                  rigid_motion_in_words(most->axes * part.head<3>(), most->axes * part.tail<3>(),
                                        most->center))};
}

}  // namespace articular::sim
