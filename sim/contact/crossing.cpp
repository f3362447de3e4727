#include "sim/contact/crossing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "sim/base/place_text.hpp"
#include "sim/contact/body_sweep.hpp"
#include "sim/contact/contact_search.hpp"
#include "sim/gap/passage.hpp"

namespace articular::sim {
namespace {

using Box = Eigen::AlignedBox3d;

/// Of the reach: shallower than this behind the face that it came in through nothing has crossed.
/// Contact holds depths far below it; the middle of a layer one element thick lies at the reach.
constexpr double kLeastOfReach = 0.5;
/// Of the reach: what stayed shallower than this under some face has slid along it, or off an edge.
constexpr double kShallow = 0.25;

/// Whether a point so deep below a face lies under it, and not beside the rim of an open surface.
bool is_under(const Vec3& x, const FaceBounds& face, double depth) {
  constexpr double kRounding = 1e-6;
  return face.normal.dot(face.corners.col(0) - x) > (1 - kRounding) * depth;
}

/// What moves less past each other, from such a depth, does not cross [m].
double least_motion(double reach, double depth) { return kLeastOfReach * reach - depth; }

bool look_apart(const Vec3& n, const Vec3& m) { return n.dot(m) < -kFacingNone; }

/// A node of a surface, or the middle of an edge or face.
struct SurfacePoint {
  std::array<int, 3> nodes = {0, 0, 0};
  int count = 0;
  std::vector<int> faces;  // around it

  Vec3 in(const Positions& x) const {
    Vec3 sum = x.col(nodes[0]);
    for (int k = 1; k < count; ++k) sum += x.col(nodes[static_cast<std::size_t>(k)]);
    return sum / count;
  }
};

std::vector<SurfacePoint> points_of(const Eigen::Matrix3Xi& faces) {
  std::vector<SurfacePoint> points;
  std::map<std::array<int, 2>, std::size_t> of_nodes;  // two alike: the node
  const auto point = [&](int i, int j) -> SurfacePoint& {
    const std::array key = {std::min(i, j), std::max(i, j)};
    const auto [entry, is_new] = of_nodes.try_emplace(key, points.size());
    if (is_new) points.push_back({{key[0], key[1], 0}, i == j ? 1 : 2, {}});
    return points[entry->second];
  };
  for (int f = 0; f < faces.cols(); ++f) {
    for (int k = 0; k < 3; ++k) {
      point(faces(k, f), faces(k, f)).faces.push_back(f);
      point(faces(k, f), faces((k + 1) % 3, f)).faces.push_back(f);
    }
    points.push_back({{faces(0, f), faces(1, f), faces(2, f)}, 3, {f}});
  }
  return points;
}

/// A collider between two states.
struct Moved {
  int body = 0;
  const Collider* collider = nullptr;
  bool encloses = true;              // elements; a shell has nothing below its reach
  std::vector<SurfacePoint> points;  // made when they are asked for first
  Positions from, to;                // nodes [m]
  BodySweep sweep;

  Mat3 face_from(int face) const { return from(Eigen::all, collider->surface.faces.col(face)); }
  Mat3 face_to(int face) const { return to(Eigen::all, collider->surface.faces.col(face)); }
};

/// The way of a face [m].
Box box_of_face(const Moved& surface, int face) {
  Box box;
  for (const int i : surface.collider->surface.faces.col(face))
    box.extend(Vec3(surface.from.col(i))).extend(Vec3(surface.to.col(i)));
  return box;
}

/// Of the nodes of those faces that come into a region.
BodySweep sweep_within(const Moved& surface, const Box& region) {
  BodySweep sweep;
  for (int f = 0; f < surface.collider->surface.faces.cols(); ++f) {
    if (!box_of_face(surface, f).intersects(region)) continue;
    for (const int i : surface.collider->surface.faces.col(f))
      sweep.add(surface.from.col(i), surface.to.col(i));
  }
  return sweep;
}

Box widened(const Box& box, double by) { return {box.min().array() - by, box.max().array() + by}; }

/// The faces of a surface that come into a region, in the order of their low ends along an axis.
class FacesNear {
 public:
  FacesNear(const Moved& surface, const Box& region) {
    region.sizes().maxCoeff(&axis_);
    for (int f = 0; f < surface.collider->surface.faces.cols(); ++f) {
      const Box box = box_of_face(surface, f);
      if (box.intersects(region)) entries_.push_back({f, box});
    }
    std::sort(entries_.begin(), entries_.end(), [&](const Entry& p, const Entry& q) {
      return p.box.min()[axis_] < q.box.min()[axis_];
    });
    for (const Entry& entry : entries_) {
      longest_ = std::max(longest_, entry.box.sizes()[axis_]);
      start_.push_back(face_bounds(surface.face_from(entry.face)));
    }
  }

  /// Indices for what follows, of those whose way meets a box.
  void find(const Box& box, std::vector<int>& found) const {
    found.clear();
    const double low = box.min()[axis_] - longest_, high = box.max()[axis_];
    auto entry =
        std::lower_bound(entries_.begin(), entries_.end(), low,
                         [&](const Entry& e, double least) { return e.box.min()[axis_] < least; });
    for (; entry != entries_.end() && entry->box.min()[axis_] <= high; ++entry)
      if (entry->box.intersects(box)) found.push_back(static_cast<int>(entry - entries_.begin()));
  }
  int face(int index) const { return entries_[static_cast<std::size_t>(index)].face; }
  const std::vector<FaceBounds>& at_start() const { return start_; }

 private:
  struct Entry {
    int face;
    Box box;  // of its way
  };
  Eigen::Index axis_ = 0;
  double longest_ = 0;  // of the boxes along the axis [m]
  std::vector<Entry> entries_;
  std::vector<FaceBounds> start_;
};

/// The points of one body on their way past the faces of another, or of the same.
class Passing {
 public:
  /// @param depth  of any point at the start [m]
  Passing(const Moved& body, const Moved& through, double reach, double depth)
      : body_(body),
        through_(through),
        reach_(reach),
        least_motion_(least_motion(reach, depth)),
        known_(
            std::max(reach, through.encloses ? depth : std::min(depth, through.collider->reach))),
        region_(widened(body.sweep.way.intersection(through.sweep.way), known_)),
        faces_near_(through, region_) {}

  void find(std::optional<Crossing>& deepest) {
    for (const SurfacePoint& point : body_.points) {
      from_ = point.in(body_.from);
      to_ = point.in(body_.to);
      Box way;
      way.extend(from_).extend(to_);
      if (!way.intersects(region_)) continue;
      faces_near_.find(widened(way, known_), candidates_);
      std::erase_if(candidates_,
                    [&](int index) { return is_tied(point, faces_near_.face(index)); });
      if (most_relative_motion() < least_motion_) continue;
      const std::optional<Crossing> crossing = crossing_of(point);
      if (crossing && !(deepest && deepest->depth >= crossing->depth)) deepest = crossing;
    }
  }

 private:
  struct Entry {
    int face = 0;
    double when = 0;
    bool at_start = false;  // it lay behind the face already
  };
  struct Event {
    Passage passage;
    int face;
  };

  bool is_itself() const { return &body_ == &through_; }

  bool is_tied(const SurfacePoint& point, int face) const {
    return std::any_of(point.faces.begin(), point.faces.end(), [&](int own) {
      return are_tied(*body_.collider, own, *through_.collider, face);
    });
  }

  /// Of the point past the corners of the faces on its way [m].
  double most_relative_motion() const {
    double most = 0;
    for (const int index : candidates_) {
      const int face = faces_near_.face(index);
      const Mat3 motion = through_.face_to(face) - through_.face_from(face);
      most = std::max(most, (motion.colwise() - (to_ - from_)).colwise().squaredNorm().maxCoeff());
    }
    return std::sqrt(most);
  }

  std::optional<Crossing> crossing_of(const SurfacePoint& point) {
    std::optional<Entry> entry = entry_at_start(point);
    find_events();
    for (const Event& event : events_) {
      if (event.passage.inward) {
        if (!entry) entry = Entry{event.face, event.passage.when, false};
        continue;
      }
      if (entry && is_behind(*entry) && leads_away(*entry, event.face) &&
          goes_deep(*entry, event.passage.when))
        return crossing(*entry);
      entry.reset();
    }
    if (entry && is_behind(*entry) && is_lost(*entry) && goes_deep(*entry, 1))
      return crossing(*entry);
    return std::nullopt;
  }

  std::optional<Entry> entry_at_start(const SurfacePoint& point) {
    const std::vector<FaceBounds>& faces = faces_near_.at_start();
    among_ = candidates_;
    if (is_itself()) {
      Vec3 normal = Vec3::Zero();
      for (const int own : point.faces) normal += face_bounds(body_.face_from(own)).normal;
      std::erase_if(among_, [&](int index) {
        return !look_apart(normal.normalized(), faces[static_cast<std::size_t>(index)].normal);
      });
    }
    const NearestFace nearest = nearest_face(from_, faces, among_);
    if (!(nearest.depth > 0 && nearest.depth <= known_)) return std::nullopt;
    if (!through_.encloses &&
        !is_under(from_, faces[static_cast<std::size_t>(nearest.face)], nearest.depth))
      return std::nullopt;
    return Entry{faces_near_.face(nearest.face), 0, true};
  }

  void find_events() {
    events_.clear();
    for (const int index : candidates_) {
      const int face = faces_near_.face(index);
      const Passages found = passages(from_, to_, through_.face_from(face), through_.face_to(face));
      for (int k = 0; k < found.count; ++k)
        events_.push_back({found.of[static_cast<std::size_t>(k)], face});
    }
    std::stable_sort(events_.begin(), events_.end(), [](const Event& p, const Event& q) {
      return p.passage.when < q.passage.when;
    });
  }

  /// [m] at the end, behind the plane of the face that it came in through.
  double depth_behind(const Entry& entry) const {
    const Mat3 q = through_.face_to(entry.face);
    return face_bounds(q).normal.dot(q.col(0) - to_);
  }
  bool is_behind(const Entry& entry) const { return depth_behind(entry) > kLeastOfReach * reach_; }

  bool leads_away(const Entry& entry, int face) const {
    return look_apart(face_bounds(through_.face_to(entry.face)).normal,
                      face_bounds(through_.face_to(face)).normal);
  }

  /// It ends inside, where contact does not push it back.
  bool is_lost(const Entry& entry) {
    if (is_itself()) return !entry.at_start && depth_behind(entry) > reach_;
    if (at_end_.empty())
      for (int f = 0; f < through_.collider->surface.faces.cols(); ++f)
        at_end_.push_back(face_bounds(through_.face_to(f)));
    const NearestFace nearest = nearest_face(to_, at_end_);
    if (leads_away(entry, nearest.face)) return true;
    return !through_.encloses && nearest.depth > through_.collider->reach &&
           is_under(to_, at_end_[static_cast<std::size_t>(nearest.face)], nearest.depth);
  }

  /// Half-way between the entry and a time. On its own surface a point has no depth.
  bool goes_deep(const Entry& entry, double until) const {
    if (is_itself()) return true;
    const double s = 0.5 * (entry.when + until);
    const Eigen::Index num_faces = through_.collider->surface.faces.cols();
    std::vector<FaceBounds> faces;
    faces.reserve(static_cast<std::size_t>(num_faces));
    for (int f = 0; f < num_faces; ++f)
      faces.push_back(face_bounds((1 - s) * through_.face_from(f) + s * through_.face_to(f)));
    return nearest_face(at(s), faces).depth > kShallow * reach_;
  }

  Vec3 at(double s) const { return (1 - s) * from_ + s * to_; }

  Crossing crossing(const Entry& entry) const {
    return {body_.body, through_.body, at(entry.when), depth_behind(entry)};
  }

  const Moved &body_, &through_;
  double reach_;         // [m]
  double least_motion_;  // [m]
  double known_;         // [m] no point lies deeper at the start without having lost its side
  Box region_;           // both come into it
  FacesNear faces_near_;
  Vec3 from_ = Vec3::Zero(), to_ = Vec3::Zero();  // the point
  std::vector<int> candidates_, among_;
  std::vector<Event> events_;
  std::vector<FaceBounds> at_end_;  // of all faces, once a point asks
};

}  // namespace

class CrossingSearch::Search {
 public:
  explicit Search(const Model& model) : model_(model) {
    of_body_.assign(model.bodies.size(), -1);
    ways_.resize(model.bodies.size());
    for (int body = 0; body < static_cast<int>(model.bodies.size()); ++body)
      if (model.contacts.touches(body)) watch(body);
  }

  std::optional<Crossing> find(const Configuration& from, const Configuration& to,
                               const ContactDepths& depths) {
    for (Moved& moved : moved_) {
      move(moved, from, to);
      ways_[static_cast<std::size_t>(moved.body)] = box_of_way(moved.sweep);
    }
    std::optional<Crossing> deepest;
    for (const ContactId id : near_.find(model_.contacts, ways_)) {
      const ContactModel contact = model_.contacts[id];
      Moved &a = moved_of(contact.a), &b = moved_of(contact.b);
      const double of_a = reach(a, b, contact), of_b = reach(b, a, contact), depth = depths.of(id);
      const double least = least_motion(std::min(of_a, of_b), depth);
      if (most_relative_motion(a.sweep, b.sweep) < least) continue;
      // What swings is slow where it touches.
      const Box region =
          widened(a.sweep.way.intersection(b.sweep.way), std::max({of_a, of_b, depth}));
      const BodySweep part_of_a = sweep_within(a, region), part_of_b = sweep_within(b, region);
      if (part_of_a.way.isEmpty() || part_of_b.way.isEmpty()) continue;
      const double motion = most_relative_motion(part_of_a, part_of_b);
      if (motion < least) continue;
      ++pairs;
      if (motion >= least_motion(of_a, depth)) look(a, b, of_a, depth, deepest);
      if (&a != &b && motion >= least_motion(of_b, depth)) look(b, a, of_b, depth, deepest);
    }
    return deepest;
  }

  std::int64_t pairs = 0;

 private:
  void watch(int body) {
    int& index = of_body_[static_cast<std::size_t>(body)];
    if (index >= 0) return;
    index = static_cast<int>(moved_.size());
    Moved moved;
    moved.body = body;
    moved.collider = &*model_.bodies[static_cast<std::size_t>(body)].collider;
    const collision::Surface whole =
        collision::build_surface(moved.collider->tets, static_cast<int>(moved.collider->X.cols()));
    moved.encloses = whole.faces.cols() == moved.collider->surface.faces.cols();
    moved_.push_back(std::move(moved));
  }
  Moved& moved_of(int body) {
    return moved_[static_cast<std::size_t>(of_body_[static_cast<std::size_t>(body)])];
  }
  static void move(Moved& moved, const Configuration& from, const Configuration& to) {
    positions_of(from, moved.collider->nodes, moved.from);
    positions_of(to, moved.collider->nodes, moved.to);
    moved.sweep = {};
    for (Eigen::Index i = 0; i < moved.from.cols(); ++i)
      moved.sweep.add(moved.from.col(i), moved.to.col(i));
  }
  static double reach(const Moved& body, const Moved& through, const ContactModel& contact) {
    return depth_range(*body.collider, *through.collider, contact.averaged).reach;
  }
  static void look(Moved& body, const Moved& through, double reach, double depth,
                   std::optional<Crossing>& deepest) {
    if (body.points.empty()) body.points = points_of(body.collider->surface.faces);
    Passing(body, through, reach, depth).find(deepest);
  }

  const Model& model_;
  std::vector<int> of_body_;  // index into moved_, or -1
  std::vector<Moved> moved_;
  NearContacts near_;
  std::vector<collision::Aabb> ways_;  // by body
};

CrossingSearch::CrossingSearch(const Model& model) : search_(std::make_unique<Search>(model)) {}
CrossingSearch::~CrossingSearch() = default;

std::optional<Crossing> CrossingSearch::find(const Configuration& from, const Configuration& to,
                                             const ContactDepths& depths) {
  return search_->find(from, to, depths);
}

std::int64_t CrossingSearch::pairs_looked_at() const { return search_->pairs; }

std::string words_for(const Model& model, const Crossing& crossing) {
  const auto& body = model.bodies[static_cast<std::size_t>(crossing.body)].name;
  const std::string where =
      fmt::format("at {}, by {:.3g} mm", place_text(crossing.place), 1e3 * crossing.depth);
  if (crossing.body == crossing.through)
    return fmt::format("`{}` goes through itself {}", body, where);
  return fmt::format("`{}` goes through `{}` {}", body,
                     model.bodies[static_cast<std::size_t>(crossing.through)].name, where);
}

}  // namespace articular::sim
