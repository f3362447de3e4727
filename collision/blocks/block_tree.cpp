#include "collision/blocks/block_tree.hpp"

#include <algorithm>
#include <cmath>

#include "collision/blocks/box_group.hpp"
#include "collision/mesh/bad_input.hpp"
#include "collision/mesh/spatial_order.hpp"

namespace articular::collision {
namespace {

/// Boxes are enlarged by this, in units of the tree's scale: they are rounded to single precision
/// (2^-25) here, and once more when another tree's are moved into this frame.
constexpr float kBoxSlack = 0x1p-22f;

/// So that four numbers an element can be counted by int.
constexpr Eigen::Index kMostElements = Eigen::Index{1} << 28;

/// The smallest scale [m]: the largest coordinate (kMaxCoordinate) divided by it must be finite.
/// Smaller meshes are points here, and left to double precision.
constexpr double kMinScale = 1e-150;

/// The least power of two that is larger.
double power_of_two_above(double value) {
  int exponent = 0;
  std::frexp(value, &exponent);
  return std::ldexp(1.0, exponent);
}

/// Where node k of the face in a slot stands in [block][3][16].
std::size_t node_lane(std::size_t slot, std::size_t k) {
  return (slot / kLanes * 3 + k) * kLanes + slot % kLanes;
}

/// Elements in an order in which blocks of sixteen are compact; the last one repeated until its
/// block is full.
template <class Elements>
std::vector<int> block_order(const Elements& elements, const Eigen::Matrix3Xd& X) {
  Eigen::Matrix3Xd centres(3, elements.cols());
  for (Eigen::Index e = 0; e < elements.cols(); ++e) {
    centres.col(e).setZero();
    for (Eigen::Index k = 0; k < elements.rows(); ++k)
      centres.col(e) += X.col(elements(k, e)) / static_cast<double>(elements.rows());
  }
  std::vector<int> order = spatial_order(centres, kBlockSize);
  if (!order.empty()) order.resize(kLanes * num_groups(order.size()), order.back());
  return order;
}

}  // namespace

BlockTree::BlockTree(const Eigen::Matrix4Xi& tets, const Surface& surface,
                     const Eigen::Matrix3Xd& X_rest)
    : num_tets_(static_cast<int>(tets.cols())),
      num_faces_(static_cast<int>(surface.faces.cols())),
      num_user_nodes_(X_rest.cols()) {
  if (tets.size() > 0 && (tets.minCoeff() < 0 || tets.maxCoeff() >= X_rest.cols()))
    bad_input("node index outside [0, ", X_rest.cols(), ") in a tetrahedron");
  if (surface.faces.size() > 0 &&
      (surface.faces.minCoeff() < 0 || surface.faces.maxCoeff() >= X_rest.cols()))
    bad_input("node index outside [0, ", X_rest.cols(), ") in a face of the surface");
  if (surface.tet_face_begin.size() != static_cast<std::size_t>(num_tets_) + 1)
    bad_input("the surface belongs to a mesh of another number of tetrahedra");
  check_positions(X_rest, X_rest.cols(), "rest position");
  if (tets.cols() > kMostElements || X_rest.cols() > kMostElements)
    bad_input("a mesh of ", tets.cols(), " tetrahedra and ", X_rest.cols(), " nodes; at most ",
              kMostElements, " are possible");

  tet_order_ = block_order(tets, X_rest);
  face_order_ = block_order(surface.faces, X_rest);
  order_nodes(tets, surface);

  std::size_t num = num_groups(tet_order_.size());
  do {
    num = num_groups(num);
    tet_levels_.emplace_back(num, empty_group());
  } while (num > 1);
  face_boxes_.resize(num_groups(face_order_.size()), empty_group());
  positions_.resize(4 * node_order_.size());
  face_corners_.resize(9 * face_order_.size());
}

void BlockTree::order_nodes(const Eigen::Matrix4Xi& tets, const Surface& surface) {
  std::vector<int> own(static_cast<std::size_t>(num_user_nodes_), -1);  // by the user's node
  tet_corners_.resize(4 * tet_order_.size());
  tet_block_nodes_begin_.push_back(0);
  for (std::size_t block = 0; block < num_groups(tet_order_.size()); ++block) {
    const std::size_t begin = tet_block_nodes_.size();
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const int user = tets(static_cast<Eigen::Index>(corner), tet_order_[kLanes * block + lane]);
        int& node = own[static_cast<std::size_t>(user)];
        if (node < 0) {
          node = static_cast<int>(node_order_.size());
          node_order_.push_back(user);
        }
        const auto found = std::find(tet_block_nodes_.begin() + static_cast<std::ptrdiff_t>(begin),
                                     tet_block_nodes_.end(), node);
        const auto place = static_cast<std::size_t>(found - tet_block_nodes_.begin()) - begin;
        if (found == tet_block_nodes_.end()) tet_block_nodes_.push_back(node);
        tet_corners_[(4 * block + corner) * kLanes + lane] = static_cast<std::uint8_t>(place);
      }
    tet_block_nodes_begin_.push_back(static_cast<int>(tet_block_nodes_.size()));
  }
  tet_block_nodes_.shrink_to_fit();
  node_order_.shrink_to_fit();
  face_nodes_.resize(3 * face_order_.size());
  for (std::size_t slot = 0; slot < face_order_.size(); ++slot)
    for (std::size_t k = 0; k < 3; ++k) {
      const int user = surface.faces(static_cast<Eigen::Index>(k), face_order_[slot]);
      if (own[static_cast<std::size_t>(user)] < 0)
        bad_input("face ", face_order_[slot], " of the surface has node ", user,
                  ", which is of no tetrahedron");
      face_nodes_[node_lane(slot, k)] = own[static_cast<std::size_t>(user)];
    }
}

void BlockTree::update(const Eigen::Matrix3Xd& x, double margin) {
  move(x, margin);
  fit();
}

void BlockTree::move(const Eigen::Matrix3Xd& x, double margin) {
  if (!(margin >= 0) || !(margin <= kMaxCoordinate))
    bad_input("margin of ", margin, " m, must be finite and not negative");
  if (x.cols() != num_user_nodes_)
    bad_input("position: ", x.cols(), " nodes, expected ", num_user_nodes_);
  check_positions(x, num_user_nodes_, "position");
  ++num_updates_;
  margin_ = margin;
  if (num_tets_ == 0) return;
  is_fitted_ = false;
  copy_positions(x);
}

void BlockTree::fit() {
  if (is_fitted_) return;
  fit_boxes();
  is_fitted_ = true;
}

void BlockTree::copy_positions(const Eigen::Matrix3Xd& x) {
  bounds_ = Aabb();
  double* own = positions_.data();
  for (const int user : node_order_) {
    // By threes: put together to a vector of four, numbers take seven times as long (SSE2).
    const Eigen::Vector3d p = x.col(user);
    bounds_.include(p);
    Eigen::Vector3d::Map(own) = p;
    own += 4;
  }
  bounds_.inflate(0.5 * margin_);
  origin_ = 0.5 * (bounds_.min + bounds_.max);
  // A power of two: nothing is lost by it. Boxes then lie within -1 and 1.
  const double half_edge = std::max(0.5 * bounds_.longest_edge(), kMinScale);
  scale_ = power_of_two_above(half_edge);
}

void BlockTree::fit_boxes() {
  BoxFrame frame;
  Eigen::Vector3d::Map(frame.origin) = origin_;
  frame.inverse_scale = 1 / scale_;
  frame.half_margin = 0.5 * margin_;
  frame.slack = kBoxSlack;
  const BlockKernels& kernels = block_kernels(best_instruction_set());
  kernels.fit_faces(frame, {positions_.data(), face_nodes_.data(), num_faces_, face_corners_.data(),
                            face_boxes_.data()});
  kernels.fit_blocks(frame, {positions_.data(), tet_block_nodes_begin_.data(),
                             tet_block_nodes_.data(), num_tet_blocks(), tet_levels_[0].data()});
  for (std::size_t level = 1; level < tet_levels_.size(); ++level)
    for (std::size_t i = 0; i < tet_levels_[level - 1].size(); ++i)
      put(union_of(tet_levels_[level - 1][i]), tet_levels_[level][i / kLanes], i % kLanes);
}

void BlockTree::describe_block(int block, BlockQuery& query) const {
  const std::size_t b = static_cast<std::size_t>(block);
  Aabb box;
  for (int i = tet_block_nodes_begin_[b]; i < tet_block_nodes_begin_[b + 1]; ++i)
    box.include(node_position(tet_block_nodes_[static_cast<std::size_t>(i)]));
  Eigen::Vector3d::Map(query.centre) = 0.5 * (box.min + box.max);
  Eigen::Vector3d::Map(query.half_edges) = 0.5 * (box.max - box.min);
  const double half_edge = std::max(0.5 * (box.longest_edge() + margin_), kMinScale);
  query.inverse_size = 1 / power_of_two_above(half_edge);
  query.positions = positions_.data();
  query.nodes = &tet_block_nodes_[static_cast<std::size_t>(tet_block_nodes_begin_[b])];
  query.num_nodes = tet_block_nodes_begin_[b + 1] - tet_block_nodes_begin_[b];
  query.corners = &tet_corners_[4 * kLanes * b];
  query.num_tets = std::min(kBlockSize, num_tets_ - block * kBlockSize);
  query.margin = margin_;
}

Eigen::Matrix3d BlockTree::face_corners(int slot) const {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k)
    corners.col(k) = node_position(
        face_nodes_[node_lane(static_cast<std::size_t>(slot), static_cast<std::size_t>(k))]);
  return corners;
}

Eigen::Matrix<double, 3, 4> BlockTree::tet_corners(int slot) const {
  const std::size_t block = static_cast<std::size_t>(slot) / kLanes,
                    lane = static_cast<std::size_t>(slot) % kLanes;
  Eigen::Matrix<double, 3, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t place = tet_corners_[(4 * block + k) * kLanes + lane];
    corners.col(static_cast<Eigen::Index>(k)) = node_position(
        tet_block_nodes_[static_cast<std::size_t>(tet_block_nodes_begin_[block]) + place]);
  }
  return corners;
}

std::size_t BlockTree::memory() const {
  std::size_t bytes = sizeof(*this) + (positions_.size() + face_corners_.size()) * sizeof(double) +
                      face_boxes_.size() * sizeof(BoxGroup) + tet_corners_.size();
  for (const std::vector<BoxGroup>& level : tet_levels_) bytes += level.size() * sizeof(BoxGroup);
  for (const std::vector<int>* list : {&tet_order_, &face_order_, &node_order_,
                                       &tet_block_nodes_begin_, &tet_block_nodes_, &face_nodes_})
    bytes += list->size() * sizeof(int);
  return bytes;
}

}  // namespace articular::collision
