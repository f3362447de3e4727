#include "collision/article/bucket_tree.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "collision/mesh/bad_input.hpp"

namespace articular::collision {
namespace {

// A rest element is flat if its volume is below this part of its longest edge cubed. A regular one
// has 0.118; slivers that mesh generators leave have 1e-6.
constexpr double kFlatVolume = 1e-12;

// The smallest root [m]: its inverse must be finite. Smaller meshes are points to the mapping.
constexpr double kMinRootEdge = 1e-290;

// Round-off of p ↦ (p - o)·scale and of o + i·step, in units of ε times the largest magnitude
// involved.
constexpr double kMappingRoundOff = 8;

// A refitted root is at most this times as large as the mesh, however small the mesh became.
constexpr double kMaxRootSlack = 4;

Aabb cube(const Eigen::Vector3d& min, double edge) {
  Aabb box;
  box.min = min;
  box.max = min.array() + edge;
  return box;
}

}  // namespace

double mean_tetrahedron_radius(const Eigen::Matrix4Xi& tets, const Eigen::Matrix3Xd& X_rest) {
  double sum = 0;
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = X_rest.col(tets(k + 1, e)) - X_rest.col(tets(0, e));
    const double volume = edges.determinant() / 6;
    const double longest = edges.colwise().norm().maxCoeff();
    if (!(volume > kFlatVolume * longest * longest * longest))
      bad_input("tetrahedron ", e, " is inverted or flat at rest: volume ", volume,
                " m³, must be positive");
    sum += volume;
  }
  if (tets.cols() == 0) return 0;
  const double mean_volume = sum / static_cast<double>(tets.cols());
  return std::cbrt(3 * mean_volume / (4 * std::numbers::pi));
}

int choose_num_levels(double root_edge, double mean_radius, double bucket_ratio) {
  const double buckets_along_edge = root_edge / (2 * mean_radius * bucket_ratio);
  if (!(buckets_along_edge >= 1)) return 1;
  const double levels = std::floor(1 + std::log2(buckets_along_edge));
  return static_cast<int>(std::min<double>(levels, BucketTree::kMaxLevels));
}

BucketTree::BucketTree(const Eigen::Matrix4Xi& tets, const Surface& surface,
                       const Eigen::Matrix3Xd& X_rest, BucketTreeOptions options)
    : tets_(tets), surface_(surface), options_(std::move(options)), x_(X_rest) {
  if (!(options_.bucket_ratio > 0) || !std::isfinite(options_.bucket_ratio))
    bad_input("bucket ratio ", options_.bucket_ratio, ", must be positive and finite");
  if (tets.size() > 0 && (tets.minCoeff() < 0 || tets.maxCoeff() >= X_rest.cols()))
    bad_input("node index outside [0, ", X_rest.cols(), ") in a tetrahedron");
  if (surface.tet_face_begin.size() != static_cast<std::size_t>(tets.cols()) + 1)
    bad_input("the surface belongs to a mesh of another number of tetrahedra");
  check_positions(X_rest, X_rest.cols(), "rest position");

  Aabb rest_bounds;
  for (Eigen::Index e = 0; e < tets.cols(); ++e)
    rest_bounds.include(element_box(X_rest, tets.col(e), 0));
  double root_edge = rest_bounds.longest_edge();
  if (options_.fixed_root) {
    root_edge = options_.fixed_root->longest_edge();
    if (!(root_edge > 0) || !std::isfinite(root_edge) ||
        (options_.fixed_root->max.array() < options_.fixed_root->min.array()).any())
      bad_input("fixed root with a longest edge of ", root_edge, " m, must be positive and finite");
  }
  const double mean_radius = mean_tetrahedron_radius(tets, X_rest);
  num_levels_ = choose_num_levels(root_edge, mean_radius, options_.bucket_ratio);
  smallest_root_edge_ = 2 * mean_radius * options_.bucket_ratio * (1 << (num_levels_ - 1));
  if (options_.mapping == Mapping::CoordinateSorting) sort_.emplace();

  const std::size_t num_buckets = std::size_t{1} << (3 * (num_levels_ - 1));
  flags_.resize(level_begin(num_levels_) + num_buckets);
  for (Flags& flags : flags_) flags.stamp = -1;  // older than a tree without updates
  begin_.resize(num_buckets);
  count_.resize(num_buckets);
  for (std::vector<double>& list : interval_lists_)
    list.resize((std::size_t{1} << (num_levels_ - 1)) + 1);
  tet_boxes_.resize(static_cast<std::size_t>(num_tets()));
  intervals_.resize(static_cast<std::size_t>(num_tets()));
  face_boxes_.resize(static_cast<std::size_t>(num_faces()));
}

void BucketTree::update(const Eigen::Matrix3Xd& x, double margin) {
  update(x, margin, [](int, std::span<const int>) {});
}

void BucketTree::begin_remap(const Eigen::Matrix3Xd& x, double margin) {
  check_positions(x, x_.cols(), "position");
  if (!(margin >= 0) || !(margin <= kMaxCoordinate))
    bad_input("margin ", margin, " m, must be finite and not negative");
  ++now_;
  margin_ = margin;
  x_ = x;
  update_boxes();
  update_root();
  update_interval_lists();
  if (sort_)
    sort_->update_bucket_indices(interval_lists_, intervals_);
  else
    map_directly();
  count_in_buckets();
}

void BucketTree::update_boxes() {
  for (Eigen::Index e = 0; e < tets_.cols(); ++e)
    tet_boxes_[static_cast<std::size_t>(e)] = element_box(x_, tets_.col(e), margin_);
  for (Eigen::Index f = 0; f < surface_.faces.cols(); ++f)
    face_boxes_[static_cast<std::size_t>(f)] = element_box(x_, surface_.faces.col(f), margin_);
  if (sort_) {
    sort_->sort(tet_boxes_);
    bounds_ = sort_->bounds();
  } else {
    bounds_ = Aabb();
    for (const Aabb& box : tet_boxes_) bounds_.include(box);
  }
}

/// Eq. 1.5.9-1.5.10 for a cube (erratum 2): one with the body's own proportions has flat buckets. A
/// body that is folded up keeps its elements' size, so the root keeps the edge that Eq. 1.5.2 asks
/// for (within kMaxRootSlack): in buckets smaller than elements every element is many times. What
/// leaves a fixed root is not pushed back into it (erratum 4); the root follows.
void BucketTree::update_root() {
  if (tets_.cols() == 0) return;
  const double extent = bounds_.longest_edge();
  Eigen::Vector3d origin = bounds_.min;
  root_edge_ = std::max(extent, std::min(smallest_root_edge_, kMaxRootSlack * extent));
  if (options_.fixed_root) {
    root_edge_ = options_.fixed_root->longest_edge();
    origin = options_.fixed_root->min;
    if (!contains(cube(origin, root_edge_), bounds_)) {
      ++num_root_refits_;
      root_edge_ = std::max(root_edge_, extent);
      origin = 0.5 * (bounds_.min + bounds_.max).array() - 0.5 * root_edge_;
    }
  }
  const double largest =
      std::max(bounds_.min.cwiseAbs().maxCoeff(), bounds_.max.cwiseAbs().maxCoeff());
  const double epsilon = std::numeric_limits<double>::epsilon();
  // The bounds of the buckets must differ, also for a mesh that is shrunk to a point.
  const double smallest = std::max(kMinRootEdge, 1024 * epsilon * largest);
  root_edge_ = std::max(root_edge_, smallest);
  round_off_ =
      kMappingRoundOff * epsilon * (std::max(largest, origin.cwiseAbs().maxCoeff()) + root_edge_);
  root_ = cube(origin, root_edge_);
}

/// Listing 1.5.6 with erratum 10: every bound from the origin, as a sum of steps drifts.
void BucketTree::update_interval_lists() {
  const double step = root_edge_ / (1 << (num_levels_ - 1));
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < interval_lists_[axis].size(); ++i)
      interval_lists_[axis][i] =
          root_.min[static_cast<Eigen::Index>(axis)] + static_cast<double>(i) * step;
}

/// Eq. 1.5.7-1.5.8. Clamping takes back round-off only: the root contains all boxes (erratum 4).
void BucketTree::map_directly() {
  const double last = (1 << (num_levels_ - 1)) - 1;
  const double scale = (last + 1) / root_edge_;
  const auto place = [&](double coordinate, double origin) {
    return static_cast<std::uint8_t>(std::clamp((coordinate - origin) * scale, 0.0, last));
  };
  for (std::size_t e = 0; e < intervals_.size(); ++e)
    for (unsigned axis = 0; axis < 3; ++axis) {
      intervals_[e].min[axis] = place(tet_boxes_[e].min[axis], root_.min[axis]);
      intervals_[e].max[axis] = place(tet_boxes_[e].max[axis], root_.min[axis]);
    }
}

/// The bookkeeping of Listing 1.5.2: a bucket touched for the first time in this remap drops its
/// old content and surface flag and enters B once (erratum 6). Counting first lets the contents of
/// all buckets lie in one array.
void BucketTree::count_in_buckets() {
  non_empty_.clear();
  Flags* bucket_flags = flags_.data() + level_begin(num_levels_);
  for (int Q = 0; Q < num_tets(); ++Q) {
    const bool on_surface = !faces_of(Q).empty();
    for_each_bucket(Q, [&](std::size_t bucket) {
      Flags& flags = bucket_flags[bucket];
      if (flags.stamp != now_) {
        flags = {now_, false};
        count_[bucket] = 0;
        non_empty_.push_back(bucket);
      }
      flags.surface = flags.surface || on_surface;
      ++count_[bucket];
    });
  }
  std::size_t num_entries = 0;
  for (std::size_t bucket : non_empty_) {
    begin_[bucket] = num_entries;
    num_entries += static_cast<std::size_t>(count_[bucket]);
    count_[bucket] = 0;
  }
  entries_.resize(num_entries);
}

/// Listing 1.5.5 with erratum 9: from each bucket up to the root, or to a node that has it all
/// already. The first visit overwrites, later ones only raise the surface flag.
void BucketTree::update_flags() {
  const int bits = num_levels_ - 1;
  const std::size_t mask = (std::size_t{1} << bits) - 1;
  const Flags* bucket_flags = flags_.data() + level_begin(num_levels_);
  for (std::size_t bucket : non_empty_) {
    const bool surface = bucket_flags[bucket].surface;
    std::array<std::size_t, 3> place = {bucket & mask, bucket >> bits & mask, bucket >> 2 * bits};
    for (int level = num_levels_ - 1; level >= 1; --level) {
      Node parent{static_cast<std::uint8_t>(level), {}};
      for (std::size_t axis = 0; axis < 3; ++axis)
        parent.place[axis] = static_cast<std::uint8_t>(place[axis] >>= 1);
      Flags& p = flags(parent);
      if (p.stamp == now_ && (p.surface || !surface)) break;
      p = {now_, surface};
    }
  }
}

Aabb BucketTree::box(Node node) const {
  const int shift = num_levels_ - node.level;
  Aabb box;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const std::vector<double>& X = interval_lists_[axis];
    box.min[axis] = X[std::size_t{node.place[axis]} << shift];
    box.max[axis] = X[(std::size_t{node.place[axis]} + 1) << shift];
  }
  box.inflate(round_off_);
  return box;
}

}  // namespace articular::collision
