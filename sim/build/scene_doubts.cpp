#include "sim/build/scene_doubts.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "sim/base/error.hpp"
#include "sim/base/place_text.hpp"
#include "sim/build/body_doubts.hpp"
#include "sim/build/hold_doubts.hpp"
#include "sim/build/muscle_doubts.hpp"
#include "sim/build/tie_doubts.hpp"
#include "sim/build/twin_doubts.hpp"
#include "sim/mesh/chord_depth.hpp"
#include "sim/mesh/extent.hpp"
#include "sim/mesh/overlapping_parts.hpp"
#include "sim/model/ignored_overlaps.hpp"
#include "sim/model/tied_bodies.hpp"
#include "sim/model/tissue.hpp"
#include "sim/scenario/driven_motion.hpp"
#include "sim/scenario/name_pattern.hpp"

namespace articular::sim {
namespace {

/// Strains of a ligament at the start. They tear at half of the one; from the other on it gets taut
/// only when its ends are twice as far apart.
constexpr double kMostStrain = 0.4, kLeastStrain = -0.5;

/// Between what is tied, of the longest side of the tissue's box: horns of a meniscus end above the
/// tibia.
constexpr double kMostGap = 0.1;

/// Of contact's stiffness by that of the elements at a surface: below, contact gives way by more
/// than a tenth of what these do.
constexpr double kLeastContactStiffness = 10;

/// How deep parts of one mesh may lie in each other, of an element.
constexpr double kMostOfElement = 0.5;

/// How far from where it is drawn a driven body may begin: samples are rounded.
constexpr double kRoundedShift = 1e-5, kRoundedTurn = 1e-4;  // [m], [rad]

/// Cosine of a lateral axis with an axis of the world that has a name: of one that lies along it.
constexpr double kAlong = 0.5;

class Doubts {
 public:
  Doubts(const Scenario& scenario, const Model& model, const std::vector<BodyGeometry>& geometry)
      : scenario_(scenario), model_(model), geometry_(geometry) {}

  std::vector<std::string> all() {
    for (const Attachment& attachment : scenario_.attachments) look_at(attachment);
    for (const Body& body : scenario_.bodies)
      if (body.kind == Body::Kind::Tissue) look_at(body);
    look_at_overlaps();
    look_at_loads();
    for (const Sheet& sheet : scenario_.sheets) look_at(sheet);
    for (const ContactPair& pair : scenario_.contacts)
      if (!is_pattern(pair.a) && !is_pattern(pair.b)) look_at(pair);
    look_at_contact_stiffness();
    for (const Load& load : scenario_.loads)
      if (const auto* motion = std::get_if<MotionLoad>(&load)) look_at(*motion);
    for (const LigamentModel& ligament : model_.ligaments) look_at(ligament);
    for (const Probe& probe : scenario_.probes)
      if (const auto* joint = std::get_if<JointProbe>(&probe.what))
        look_at(probe, *joint);
      else if (const auto* reaction = std::get_if<ReactionProbe>(&probe.what))
        look_at(probe, *reaction);
    return std::move(lines_);
  }

 private:
  void doubt(const Location& where, const std::string& what) {
    lines_.push_back(prefix(where) + what);
  }

  void look_at_contact_stiffness() {
    const std::optional<double>& factor = scenario_.contact_stiffness_factor;
    if (!factor || !(*factor < kLeastContactStiffness)) return;
    doubt({scenario_.file.string()},
          fmt::format("`contact_stiffness_factor` = {:g} lets surfaces sink into each other {} the "
                      "elements there are pressed together: expected {:g} or more",
                      *factor,
                      *factor < 1    ? "farther than"
                      : *factor == 1 ? "as far as"
                                     : "nearly as far as",
                      kLeastContactStiffness));
  }

  std::size_t index(const std::string& body) const {
    return static_cast<std::size_t>(body_index(scenario_, body));
  }
  const Tissue& tissue(std::size_t body) const {
    return model_.tissues[static_cast<std::size_t>(model_.bodies[body].tissue)];
  }

  /// Once for each two bodies.
  void look_at(const Attachment& attachment) {
    const std::size_t a = index(attachment.body), b = index(attachment.to);
    const MeshData& bone = geometry_[b].mesh;
    if (bone.triangles.cols() == 0 || !tied_.insert({a, b}).second) return;
    const double enough = std::max(element_size(tissue(a)), kMostGap * extent(tissue(a).X));
    const double gap = gap_between(tissue(a), bone, model_.bodies[b].rigid, enough);
    if (gap > enough)
      doubt(attachment.where,
            fmt::format("`{}` is tied to `{}` across a gap of {:.3g} mm: is it the right body, and "
                        "do both meshes have the same unit?",
                        attachment.body, attachment.to, 1e3 * gap));
  }

  /// From the nearest node that is tied; 0 where one lies within, or as near as `enough`.
  static double gap_between(const Tissue& tissue, const MeshData& bone, int rigid, double enough) {
    const TriangleTree tree(bone.X, bone.triangles);
    std::vector<Vec3> tied;
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      if (tissue.nodes[i].rigid == rigid)
        tied.push_back(tissue.X.col(static_cast<Eigen::Index>(i)));
    const auto is_near = [&](const Vec3& x) { return tree.is_within(x, enough); };
    if (std::any_of(tied.begin(), tied.end(), is_near)) return 0;
    double gap = std::numeric_limits<double>::infinity();
    for (const Vec3& x : tied) {  // what lies deep within asks every triangle: last
      if (depth_inside(bone.X, bone.triangles, tree, x) > 0) return 0;
      gap = std::min(gap, tree.distance(x));
    }
    return gap;
  }

  void look_at(const Body& body) {
    const std::vector<NodeRef>& nodes = tissue(index(body.name)).nodes;
    if (std::ranges::all_of(nodes, is_attached))
      doubt(body.where,
            fmt::format("every node of `{}` is attached to a body: it can't deform", body.name));
  }

  /// Of a body that no [[contact]] names, and of the parts of one mesh.
  void look_at_overlaps() {
    for (const IgnoredOverlap& overlap : IgnoredOverlaps(scenario_, model_).at_start()) {
      const auto& [inner, outer, x, depth, is_whole, t] = overlap;
      if (is_whole) continue;  // a tumour in an organ
      const int forgotten = model_.contacts.touches(inner) ? outer : inner;
      if (model_.contacts.touches(forgotten)) continue;  // whoever named both left them out
      doubt(scenario_.bodies[static_cast<std::size_t>(forgotten)].where,
            fmt::format("`{}` lies in `{}` at the start, to {:.3g} mm at {}, and nothing will part "
                        "them: no [[contact]] names `{}`; expected one, `collides = false`, or "
                        "another place",
                        name(inner), name(outer), 1e3 * depth, place_text(x), name(forgotten)));
    }
    for (const Tissue& tissue : model_.tissues)
      if (const auto found = deepest_in_another_part(tissue.X, tissue.elements.tets(),
                                                     kMostOfElement * element_size(tissue)))
        doubt(scenario_.bodies[static_cast<std::size_t>(tissue.body)].where,
              fmt::format("the mesh of `{}` has parts that share no node and lie in each other, to "
                          "{:.3g} mm at {}: what is there twice is as stiff and as heavy as two; "
                          "expected one mesh, or a body for each part",
                          name(tissue.body), 1e3 * found->depth, place_text(found->x)));
  }
  const std::string& name(int body) const {
    return model_.bodies[static_cast<std::size_t>(body)].name;
  }

  void look_at_loads() {
    std::size_t forces = 0, surfaces = 0;  // in the order of the scenario, as in the model
    for (const Load& load : scenario_.loads) {
      if (const auto* force = std::get_if<ForceLoad>(&load)) {
        const WeightedPoint& point = model_.forces[forces++].point;
        if (const auto* region = std::get_if<TissueRegion>(&force->at))
          look_at(*force, point.nodes, region->tissue);
      } else if (const auto* surface = std::get_if<SurfaceLoad>(&load)) {
        const auto& faces = model_.surface_loads[surfaces++].faces;
        if (std::ranges::all_of(
                faces, [](const auto& face) { return std::ranges::all_of(face, is_attached); }))
          doubt_load(surface->where, "face", faces.size(), surface->at.tissue);
      }
    }
  }

  template <class Nodes>
  void look_at(const ForceLoad& load, const Nodes& nodes, const std::string& tissue) {
    const auto is_held = [&](const NodeRef& node) { return is_held_along(node, load.force); };
    if (std::ranges::all_of(nodes, is_attached))
      doubt_load(load.where, "node", nodes.size(), tissue);
    else if (std::ranges::all_of(nodes, is_held))
      doubt(load.where,
            fmt::format("every loaded node of `{}` ({} in the region) is held along the force by a "
                        "support: it takes the load, which deforms nothing",
                        tissue, nodes.size()));
  }

  static bool is_attached(const NodeRef& node) { return node.rigid >= 0; }

  bool is_held_along(const NodeRef& node, const Vec3& direction) const {
    constexpr double kRoundOff = 1e-9;
    if (is_attached(node)) return true;
    const auto held = std::ranges::find(model_.held_blocks, node.block, &HeldBlock::block);
    return held != model_.held_blocks.end() &&
           (held->free * direction).norm() <= kRoundOff * direction.norm();
  }

  void look_at(const ContactPair& pair) {
    if (pair.a == pair.b) return;
    for (const std::string& name : {pair.a, pair.b})
      if (model_.bodies[index(name)].kind != Body::Kind::Fixed) return;
    doubt(pair.where, fmt::format("`{}` and `{}` are both fixed: nothing gives way where they "
                                  "touch, and what no [[contact]] names does not touch",
                                  pair.a, pair.b));
  }

  void doubt_load(const Location& where, const char* part, std::size_t count,
                  const std::string& tissue) {
    doubt(where,
          fmt::format("every loaded {} of `{}` ({} in the region) is attached to a body: the "
                      "load acts on that body, and deforms nothing",
                      part, tissue, count));
  }

  void look_at(const Sheet& sheet) {
    const Tissue& under = tissue(index(sheet.at.tissue));
    const auto made = std::ranges::find(under.sheets, sheet.name, &SheetModel::name);
    const auto rigid = [&](int node) { return under.nodes[static_cast<std::size_t>(node)].rigid; };
    const auto goes_with_one = [&](const auto& face) {
      return rigid(face[0]) >= 0 && rigid(face[1]) == rigid(face[0]) &&
             rigid(face[2]) == rigid(face[0]);
    };
    const auto faces = made->fibres.faces().colwise();
    if (std::all_of(faces.begin(), faces.end(), goes_with_one))
      doubt(sheet.where, fmt::format("every face of sheet `{}` is attached to a body: it can't "
                                     "stretch",
                                     sheet.name));
  }

  void look_at(const LigamentModel& ligament) {
    const double length = model_.lines[static_cast<std::size_t>(ligament.line)].start_length;
    const double strain = length / ligament.slack_length - 1;
    if (strain > kMostStrain)
      doubt(ligament.given.where,
            fmt::format("ligament `{}` starts drawn out by {:.0f} %, from {:.4g} mm slack to "
                        "{:.4g} mm",
                        ligament.given.name, 100 * strain, 1e3 * ligament.slack_length,
                        1e3 * length));
    if (strain < kLeastStrain)
      doubt(ligament.given.where,
            fmt::format("ligament `{}` is slack until it is {:.3g} times as long: its slack length "
                        "is {:.4g} mm, and it starts with {:.4g} mm",
                        ligament.given.name, ligament.slack_length / length,
                        1e3 * ligament.slack_length, 1e3 * length));
  }

  void look_at(const Probe& probe, const ReactionProbe& reaction) {
    if (is_loaded(index(reaction.body))) return;
    doubt(probe.where, fmt::format("the reaction of `{}` is always 0: nothing touches it, is tied "
                                   "to it or ends on it",
                                   reaction.body));
  }

  /// Whether anything can push or pull on a fixed body.
  bool is_loaded(std::size_t body) const {
    const BodyModel& made = model_.bodies[body];
    if (made.kind != Body::Kind::Fixed || model_.contacts.touches(static_cast<int>(body)))
      return true;
    const auto is_tied = [&](const Tissue& tissue) { return is_tied_to(tissue, made.rigid); };
    const auto pulls = [&](const Line& line) { return pulls_on(model_, line, made.rigid); };
    return std::ranges::any_of(model_.tissues, is_tied) || std::ranges::any_of(model_.lines, pulls);
  }

  void look_at(const Probe& probe, const JointProbe& joint) {
    const auto look = [&](const char* name, const Vec3& p, const Vec3& q) {
      if (p.dot(q) < 0)
        doubt(probe.where, fmt::format("`{}` of `{}` and of `{}` point opposite ways: the joint "
                                       "coordinates `{}` turn by 180 degrees",
                                       name, joint.proximal.body, joint.distal.body, probe.name));
    };
    look("lateral", joint.proximal.lateral, joint.distal.lateral);
    look("up", joint.proximal.up, joint.distal.up);
    for (const JointSide* side : {&joint.proximal, &joint.distal})
      for (std::size_t k = 0; k < scenario_.output.directions.size(); ++k) {
        const std::string& word = scenario_.output.directions[k];
        const double along = side->lateral[static_cast<Eigen::Index>(k)];
        if (outwards(word, joint.is_right) * along >= -kAlong) continue;
        return doubt(
            probe.where,
            fmt::format("`lateral` of `{}` points inwards, as `directions` of [output] "
                        "has \"{}\" for +{} and the joint `{}` is a {} one: expected "
                        "another `side`, `lateral` or `directions`",
                        side->body, word, "xyz"[k], probe.name, joint.is_right ? "right" : "left"));
      }
  }

  /// 1, or −1, where a direction of the body is away from its middle, or to it, on that side; else
  /// 0.
  static double outwards(const std::string& direction, bool is_right) {
    if (direction == "lateral" || direction == (is_right ? "right" : "left")) return 1;
    if (direction == "medial" || direction == (is_right ? "left" : "right")) return -1;
    return 0;
  }

  /// Of a rigid body and of a support the reader refuses it.
  void look_at(const MotionLoad& load) {
    if (load.body.empty()) return;
    const RigidBody& rigid =
        model_.rigid_bodies[static_cast<std::size_t>(model_.bodies[index(load.body)].rigid)];
    const Pose begin = driven_pose(*rigid.motion, rigid.rest, 0);
    const double shift = (begin.p - rigid.rest.p).norm(), turn = Eigen::AngleAxisd(begin.R).angle();
    if (shift > kRoundedShift || turn > kRoundedTurn)
      doubt(load.where,
            fmt::format("the motion of `{}` does not begin at 0: at the start the body jumps by "
                        "{:.3g} mm and {:.3g} degrees from where it is drawn, and takes along "
                        "what is tied to it",
                        load.body, 1e3 * shift, 180 / std::numbers::pi * turn));
  }

  const Scenario& scenario_;
  const Model& model_;
  const std::vector<BodyGeometry>& geometry_;
  std::set<std::pair<std::size_t, std::size_t>> tied_;
  std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> scene_doubts(const Scenario& scenario, const Model& model,
                                      const std::vector<BodyGeometry>& geometry) {
  std::vector<std::string> doubts = Doubts(scenario, model, geometry).all();
  for (std::vector<std::string>& more : std::array{
           muscle_doubts(scenario, model), body_doubts(scenario, geometry),
           tie_doubts(scenario, model), twin_doubts(scenario, model), hold_doubts(scenario, model)})
    std::move(more.begin(), more.end(), std::back_inserter(doubts));
  return doubts;
}

}  // namespace articular::sim
