#include "sim/build/build_model.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "sim/base/available_memory.hpp"
#include "sim/base/mistakes.hpp"
#include "sim/base/place_text.hpp"
#include "sim/build/body_collider.hpp"
#include "sim/build/body_geometry.hpp"
#include "sim/build/coincident_bodies.hpp"
#include "sim/build/contact_model.hpp"
#include "sim/build/law_doubts.hpp"
#include "sim/build/linear_solver.hpp"
#include "sim/build/make_probes.hpp"
#include "sim/build/make_sheets.hpp"
#include "sim/build/make_supports.hpp"
#include "sim/build/make_surface_loads.hpp"
#include "sim/build/make_tissue.hpp"
#include "sim/build/make_wraps.hpp"
#include "sim/build/memory_need.hpp"
#include "sim/build/region.hpp"
#include "sim/build/scene_doubts.hpp"
#include "sim/build/unit_doubts.hpp"
#include "sim/build/weighted_points.hpp"
#include "sim/lines/muscle_law.hpp"
#include "sim/mesh/flat_elements.hpp"
#include "sim/mesh/mesh_defects.hpp"
#include "sim/model/constrained_rigid_body.hpp"
#include "sim/model/newton_weights.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

/// A muscle that gives less than this part of its maximal force at rest and full activation is
/// probably a table applied to another subject.
constexpr double kLeastForceAtRest = 0.1;

double trusted_motion(const Model& model) {
  double least = std::numeric_limits<double>::infinity();
  for (const Tissue& tissue : model.tissues) least = std::min(least, element_size(tissue));
  for (const BodyModel& body : model.bodies)
    if (body.collider) least = std::min(least, body.collider->reach);
  return least;
}

class Builder {
 public:
  explicit Builder(const Scenario& scenario) : scenario_(scenario) {
    model_.pool = std::make_shared<ThreadPool>(scenario.threads);
  }

  Model build() {
    model_.is_static = scenario_.analysis == Scenario::Analysis::Static;
    read_bodies();
    make_rigid_bodies();
    make_tissues();
    make_sheets(scenario_, geometry_, surface_, model_);
    attach_nodes();
    number_blocks();
    make_supports(scenario_, geometry_, surface_, model_);
    hold_rigid_bodies();
    carry_tissue_mass();
    make_colliders(scenario_, geometry_, model_);
    make_lines();
    make_loads();
    make_contacts(scenario_, model_);
    refuse_coincident_bodies(scenario_, model_);
    refuse_bodies_within_others(scenario_, model_);
    model_.probes = make_probes(scenario_, model_, geometry_, surface_, model_.warnings);
    model_.position_tolerance = position_tolerance(scenario_.integrator, model_);
    model_.detection_margin = detection_margin(model_);
    model_.trusted_motion = trusted_motion(model_);
    for (const auto& doubts :
         {scenario_.doubts, unit_doubts(scenario_, model_), law_doubts(scenario_, model_),
          scene_doubts(scenario_, model_, geometry_)})
      model_.warnings.insert(model_.warnings.end(), doubts.begin(), doubts.end());
    model_.linear_solver = choose_linear_solver(scenario_, model_);
    return std::move(model_);
  }

 private:
  static Vec3 reference_point(const RigidBody& rigid) {
    return rigid.hold && rigid.hold->at ? *rigid.hold->at : rigid.mass.center;
  }

  int body_index(const std::string& name) const { return sim::body_index(scenario_, name); }

  void read_bodies() {
    std::vector<double> num_tets;
    for (const Body& body : scenario_.bodies) num_tets.push_back(num_shape_tetrahedra(body));
    refuse_more_memory(scenario_, num_tets, available_memory());
    read_each(scenario_.bodies,
              [&](const Body& body) { geometry_.push_back(read_geometry(body)); });
    for (std::size_t b = 0; b < num_tets.size(); ++b)
      num_tets[b] = static_cast<double>(geometry_[b].mesh.tets.cols());
    refuse_more_memory(scenario_, num_tets, available_memory());
    for (const Body& body : scenario_.bodies) {
      BodyModel entry;
      entry.name = body.name;
      entry.kind = body.kind;
      entry.touches_as_drawn = body.contact_meshes.empty();
      model_.bodies.push_back(std::move(entry));
    }
  }

  void make_rigid_bodies() {
    // Rigid ones first: their blocks are unknowns.
    for (const Body::Kind kind : {Body::Kind::Rigid, Body::Kind::Fixed})
      for (std::size_t b = 0; b < scenario_.bodies.size(); ++b) {
        const Body& body = scenario_.bodies[b];
        if (body.kind != kind) continue;
        RigidBody rigid;
        rigid.body = static_cast<int>(b);
        rigid.unknown = kind == Body::Kind::Rigid;
        if (rigid.unknown) {
          rigid.mass = rigid_mass(body, geometry_[b].mesh);
          rigid.hold = body.hold;
          rigid.rest.p = reference_point(rigid);
          rigid.start = {body.velocity, body.angular_velocity};
          ++model_.layout.num_rigid;
        } else if (geometry_[b].mesh.X.cols() > 0) {
          const auto& X = geometry_[b].mesh.X;
          rigid.rest.p = 0.5 * (X.rowwise().minCoeff() + X.rowwise().maxCoeff());
        }
        model_.bodies[b].rigid = static_cast<int>(model_.rigid_bodies.size());
        model_.rigid_bodies.push_back(rigid);
      }
    for (const Load& load : scenario_.loads)
      if (const auto* motion = std::get_if<MotionLoad>(&load);
          motion != nullptr && !motion->body.empty())
        drive(*motion);
  }

  void drive(const MotionLoad& load) {
    RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(
        model_.bodies[static_cast<std::size_t>(body_index(load.body))].rigid)];
    if (rigid.motion)
      throw InputError(load.where, fmt::format("body `{}` is driven twice", load.body));
    rigid.motion = load.motion;
    if (rigid.hold) {
      for (Vec3& shift : rigid.motion->translation) shift = rigid.hold->axes * shift;
      for (Vec3& turn : rigid.motion->rotation) turn = rigid.hold->axes * turn;
    }
    fit_spline(*rigid.motion);
  }

  void make_tissues() {
    for (std::size_t b = 0; b < scenario_.bodies.size(); ++b) {
      if (scenario_.bodies[b].kind != Body::Kind::Tissue) continue;
      const MeshData& mesh = geometry_[b].mesh;
      surface_.push_back(collision::build_surface(mesh.tets, static_cast<int>(mesh.X.cols())));
      model_.bodies[b].tissue = static_cast<int>(model_.tissues.size());
      model_.tissues.push_back(
          make_tissue(scenario_, model_, geometry_, surface_.back(), static_cast<int>(b)));
      tell_locking(scenario_.bodies[b], model_.tissues.back());
      tell_flat_elements(scenario_.bodies[b], mesh);
      tell_coincident_nodes(scenario_.bodies[b], mesh);
    }
  }

  /// Linear tetrahedra can't keep their volume and yet bend [Hughes, The Finite Element
  /// Method, 4.4].
  void tell_locking(const Body& body, const Tissue& tissue) {
    constexpr double kMost = 0.45;  // of Poisson's ratio
    const double K = tissue.bulk_modulus, G = tissue.shear_modulus;
    const double nu = (3 * K - 2 * G) / (6 * K + 2 * G);
    if (tissue.elements.smoothed() != nullptr || !(nu > kMost * (1 + 1e-9))) return;
    model_.warnings.push_back(
        prefix(body.material->where) +
        fmt::format(
            "plain elements of `{}` lock at Poisson's ratio {:.5g}: it bends and bulges less "
            "than it should; element = \"smoothed\" does not",
            body.name, nu));
  }

  void tell_flat_elements(const Body& body, const MeshData& mesh) {
    const FlatElements flat = flat_elements(mesh.X, mesh.tets);
    if (flat.count == 0) return;
    model_.warnings.push_back(
        prefix(body.where) +
        fmt::format("{} of {} tetrahedra of `{}` are flat (height below 1/50 of an edge), the "
                    "flattest at {}: pressures beside them are uneven",
                    flat.count, mesh.tets.cols(), body.name, place_text(flat.flattest)));
  }

  /// A slit may be meant, so that this is no error.
  void tell_coincident_nodes(const Body& body, const MeshData& mesh) {
    const CoincidentNodes coincident = coincident_nodes(mesh.X);
    if (coincident.count == 0) return;
    model_.warnings.push_back(
        prefix(body.where) +
        fmt::format(
            "{} of {} nodes of `{}` lie where another of its nodes lies, one at {}: nothing "
            "holds the tissue together there; merge them unless a slit is meant",
            coincident.count, mesh.X.cols(), body.name, place_text(coincident.place)));
  }

  /// The nodes in each region belong to a rigid body from now on.
  void attach_nodes() {
    std::vector<std::vector<const Attachment*>> taken(model_.tissues.size());  // by tissue and node
    read_each(scenario_.attachments, [&](const Attachment& attachment) {
      const auto b = static_cast<std::size_t>(body_index(attachment.body));
      const auto t = static_cast<std::size_t>(model_.bodies[b].tissue);
      taken[t].resize(model_.tissues[t].nodes.size());
      attach(attachment, surface_[t], model_.tissues[t], taken[t]);
    });
  }

  /// @param taken  by node: the entry that has attached it, if any
  void attach(const Attachment& attachment, const collision::Surface& surface, Tissue& tissue,
              std::vector<const Attachment*>& taken) const {
    const int rigid = model_.bodies[static_cast<std::size_t>(body_index(attachment.to))].rigid;
    const RegionTest test(attachment.region, tissue.body, model_, geometry_);
    const std::vector<char> on_surface = surface_nodes(tissue, surface);
    int count = 0;
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
      const Vec3 x = tissue.X.col(static_cast<Eigen::Index>(i));
      if (!test.contains_node(static_cast<int>(i), x, on_surface[i] != 0)) continue;
      ++count;
      if (taken[i] != nullptr && taken[i]->to != attachment.to)
        throw InputError(
            attachment.where,
            fmt::format("the node of `{}` at {} is attached to `{}` and, by "
                        "the [[attach]] at {}, to `{}`: expected regions without common nodes",
                        attachment.body, place_text(x), attachment.to, place_text(taken[i]->where),
                        taken[i]->to));
      taken[i] = &attachment;
      tissue.nodes[i].rigid = rigid;
      tissue.nodes[i].local = x - model_.rigid_bodies[static_cast<std::size_t>(rigid)].rest.p;
    }
    if (count == 0)
      throw InputError(attachment.where,
                       fmt::format("no node of tissue `{}` lies in the region attached to `{}`",
                                   attachment.body, attachment.to));
  }

  /// Blocks for the nodes that are not attached, then those of the rigid bodies.
  void number_blocks() {
    int block = 0;
    for (Tissue& tissue : model_.tissues)
      for (NodeRef& node : tissue.nodes)
        if (node.rigid < 0) node.block = block++;
    model_.layout.num_free_nodes = block;
    model_.node_mass.resize(block);
    for (const Tissue& tissue : model_.tissues)
      for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
        if (tissue.nodes[i].rigid < 0)
          model_.node_mass[tissue.nodes[i].block] =
              tissue.lumped_mass[static_cast<Eigen::Index>(i)];
    for (RigidBody& rigid : model_.rigid_bodies) {
      rigid.block = block;
      block += 2;
    }
    model_.num_blocks = block;
    for (Tissue& tissue : model_.tissues)
      for (NodeRef& node : tissue.nodes)
        if (node.rigid >= 0)
          node.block = model_.rigid_bodies[static_cast<std::size_t>(node.rigid)].block;
    model_.layout.num_muscles = static_cast<int>(scenario_.muscles.size());
    for (Tissue& tissue : model_.tissues) {
      if (!tissue.relaxation) continue;
      tissue.first_internal_variable = model_.layout.num_internal_variables;
      model_.layout.num_internal_variables += tissue.relaxation->num_internal_variables();
    }
  }

  /// After what supports hold: held blocks are in the order of the blocks.
  void hold_rigid_bodies() {
    for (const RigidBody& rigid : model_.rigid_bodies)
      if (rigid.hold)
        for (int k = 0; k < 2; ++k)
          model_.held_blocks.push_back(
              {rigid.block + k, free_projection(*rigid.hold, static_cast<std::size_t>(k))});
  }

  /// Tissue nodes attached to a body add their mass to it; a rigid one's centre of mass moves.
  void carry_tissue_mass() {
    for (const Tissue& tissue : model_.tissues)
      for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
        if (tissue.nodes[i].rigid < 0) continue;
        RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(tissue.nodes[i].rigid)];
        const auto column = static_cast<Eigen::Index>(i);
        rigid.mass =
            join(rigid.mass, {tissue.lumped_mass[column], tissue.X.col(column), Mat3::Zero()});
      }
    std::vector<Vec3> shift(model_.rigid_bodies.size(), Vec3::Zero());
    for (std::size_t r = 0; r < model_.rigid_bodies.size(); ++r) {
      RigidBody& rigid = model_.rigid_bodies[r];
      if (!rigid.unknown) continue;
      const Vec3 old_center = rigid.rest.p;
      rigid.rest.p = reference_point(rigid);
      rigid.start.linear += rigid.start.angular.cross(rigid.rest.p - old_center);
      shift[r] = old_center - rigid.rest.p;
    }
    for (Tissue& tissue : model_.tissues)
      for (NodeRef& node : tissue.nodes)
        if (node.rigid >= 0) node.local += shift[static_cast<std::size_t>(node.rigid)];
    for (const RigidBody& rigid : model_.rigid_bodies) {
      const auto b = static_cast<std::size_t>(rigid.body);
      model_.bodies[b].X = geometry_[b].mesh.X.colwise() - rigid.rest.p;
      model_.bodies[b].triangles = geometry_[b].mesh.triangles;
    }
  }

  /// The point of a body that a force acts on.
  WeightedPoint resolve(const Anchor& anchor) {
    WeightedPoint point =
        anchored_point(anchor, body_index(anchor.body), model_, surface_, model_.warnings);
    if (anchor.radius == 0) doubt_single_point(anchor, point);
    return point;
  }

  /// Once a body. Of an elastic solid the point that a force acts on goes infinitely far.
  void doubt_single_point(const Anchor& anchor, const WeightedPoint& point) {
    const auto is_tied = [](const NodeRef& node) { return node.rigid >= 0; };
    if (std::ranges::all_of(point.nodes, is_tied)) return;
    if (!pulled_at_a_point_.insert(anchor.body).second) return;
    model_.warnings.push_back(
        prefix(anchor.where) +
        fmt::format("a force acts on one point of `{}`: how far it takes that along depends on the "
                    "size of elements; expected a `radius` over which it is spread",
                    anchor.body));
  }

  Vec3 start_position(const WeightedPoint& point) const {
    Vec3 x = Vec3::Zero();
    for (std::size_t k = 0; k < point.nodes.size(); ++k)
      x += point.weights[k] * start_position(point.nodes[k]);
    return x;
  }

  Vec3 start_position(const NodeRef& node) const {
    if (node.rigid >= 0)
      return model_.rigid_bodies[static_cast<std::size_t>(node.rigid)].rest.p + node.local;
    return free_node_start().col(node.block);
  }

  const Positions& free_node_start() const {
    if (free_start_.cols() == 0) {
      free_start_.resize(3, model_.layout.num_free_nodes);
      for (const Tissue& tissue : model_.tissues)
        for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
          if (tissue.nodes[i].rigid < 0)
            free_start_.col(tissue.nodes[i].block) = tissue.X.col(static_cast<Eigen::Index>(i));
    }
    return free_start_;
  }

  void tell_line_of_one_bone(const std::string& name, const std::vector<Anchor>& path,
                             const Location& where) {
    const std::string& first = path.front().body;
    const auto is_first = [&](const Anchor& anchor) { return anchor.body == first; };
    const bool is_bone = model_.bodies[static_cast<std::size_t>(body_index(first))].rigid >= 0;
    if (is_bone && std::all_of(path.begin(), path.end(), is_first))
      model_.warnings.push_back(
          prefix(where) + fmt::format("all points of `{}` lie on `{}`: its length never changes, "
                                      "and what it pulls moves nothing",
                                      name, first));
  }

  Line make_line(const std::string& name, const std::vector<Anchor>& path,
                 const std::vector<std::string>& wrap, const Location& where) {
    Line line;
    line.name = name;
    for (const Anchor& anchor : path) line.path.push_back(resolve(anchor));
    for (std::size_t i = 1; i < line.path.size(); ++i)
      line.start_length += (start_position(line.path[i]) - start_position(line.path[i - 1])).norm();
    if (!(line.start_length > 0))
      throw InputError(where, fmt::format("`{}` has no length: its points coincide", name));
    tell_line_of_one_bone(name, path, where);
    if (wrap.empty()) return line;
    std::vector<int> bodies;
    bodies.reserve(wrap.size());
    for (const std::string& body : wrap) bodies.push_back(body_index(body));
    std::vector<Vec3> points;
    points.reserve(line.path.size());
    for (const WeightedPoint& point : line.path) points.push_back(start_position(point));
    make_wrap(wrap, bodies, points, where, model_, line);
    return line;
  }

  void make_fibre_muscle(const Muscle& muscle) {
    const BodyModel& body = model_.bodies[static_cast<std::size_t>(body_index(muscle.tissue))];
    Tissue& tissue = model_.tissues[static_cast<std::size_t>(body.tissue)];
    if (tissue.muscle >= 0)
      throw InputError(
          muscle.where,
          fmt::format("the fibres of `{}` have two muscles, `{}` and "
                      "`{}`",
                      body.name, model_.muscles[static_cast<std::size_t>(tissue.muscle)].given.name,
                      muscle.name));
    tissue.muscle = static_cast<int>(model_.muscles.size());
    model_.muscles.push_back({.given = muscle});
  }

  void make_line_muscle(const Muscle& muscle) {
    Line line = make_line(muscle.name, muscle.path, muscle.wrap, muscle.where);
    line.muscle = static_cast<int>(model_.muscles.size());
    const double start_length = line.start_length + length_beyond(muscle, 0);
    MuscleModel m{muscle, muscle.optimal_length.value_or(start_length),
                  static_cast<int>(model_.lines.size())};
    const double rest = active_force_length(muscle.force_length_curve, start_length,
                                            m.optimal_length, muscle.tendon_ratio)
                            .value;
    if (muscle.force_length && rest < kLeastForceAtRest)
      model_.warnings.push_back(
          prefix(muscle.where) +
          fmt::format("muscle `{}` can give only {:.1f} % of its active force at rest (length "
                      "{:.1f} mm, optimal {:.1f} mm); does the table belong to this geometry?",
                      muscle.name, 100 * rest, 1e3 * start_length, 1e3 * m.optimal_length));
    model_.muscles.push_back(std::move(m));
    model_.lines.push_back(std::move(line));
  }

  void make_ligament(const Ligament& ligament) {
    Line line = make_line(ligament.name, ligament.path, ligament.wrap, ligament.where);
    line.ligament = static_cast<int>(model_.ligaments.size());
    double slack = line.start_length;
    if (ligament.slack_length)
      slack = *ligament.slack_length;
    else if (ligament.slack_extension)
      slack += *ligament.slack_extension;
    else if (ligament.reference_strain)
      slack /= 1 + *ligament.reference_strain;
    if (!(slack > 0))
      throw InputError(ligament.where,
                       fmt::format("ligament `{}` has slack length {:g} mm; expected more than 0",
                                   ligament.name, 1e3 * slack));
    model_.ligaments.push_back({ligament, slack, static_cast<int>(model_.lines.size())});
    model_.lines.push_back(std::move(line));
  }

  void make_bolus(const Bolus& bolus) {
    Line line = make_line(bolus.name, bolus.path, {}, bolus.where);
    line.bolus = static_cast<int>(model_.boluses.size());
    if (!(bolus.from > 0) && bolus.height.value_or(0) > line.start_length)
      throw InputError(bolus.where,
                       fmt::format("bolus `{}` is {:.4g} mm high, but there are {:.4g} "
                                   "mm between its points at the start: a time `from` "
                                   "puts it in later",
                                   bolus.name, 1e3 * *bolus.height, 1e3 * line.start_length));
    model_.boluses.push_back({bolus, static_cast<int>(model_.lines.size())});
    model_.lines.push_back(std::move(line));
  }

  void make_lines() {
    Mistakes mistakes;
    for (const Muscle& muscle : scenario_.muscles)
      mistakes.in([&] {
        if (muscle.tissue.empty())
          make_line_muscle(muscle);
        else
          make_fibre_muscle(muscle);
      });
    for (const Ligament& ligament : scenario_.ligaments)
      mistakes.in([&] { make_ligament(ligament); });
    for (const Bolus& bolus : scenario_.boluses) mistakes.in([&] { make_bolus(bolus); });
    mistakes.tell();
  }

  void make_loads() {
    for (const Load& load : scenario_.loads) {
      const auto* gravity = std::get_if<GravityLoad>(&load);
      if (gravity != nullptr && !gravity->acceleration.isZero(0))
        model_.gravity.push_back({gravity->acceleration, gravity->profile});
      if (const auto* force = std::get_if<ForceLoad>(&load))
        model_.forces.push_back({loaded_point(*force), force->force, force->profile});
      if (const auto* moment = std::get_if<MomentLoad>(&load))
        model_.moments.push_back(
            {model_.bodies[static_cast<std::size_t>(body_index(moment->body))].rigid,
             moment->moment, moment->profile});
      if (const auto* surface = std::get_if<SurfaceLoad>(&load))
        model_.surface_loads.push_back(make_surface_load(*surface, body_index(surface->at.tissue),
                                                         model_, geometry_, surface_));
    }
  }

  WeightedPoint loaded_point(const ForceLoad& load) {
    if (const auto* anchor = std::get_if<Anchor>(&load.at)) return resolve(*anchor);
    const auto& [name, region] = std::get<TissueRegion>(load.at);
    const int tissue = model_.bodies[static_cast<std::size_t>(body_index(name))].tissue;
    WeightedPoint point =
        region_point(region, tissue, model_, geometry_, surface_[static_cast<std::size_t>(tissue)]);
    if (point.nodes.empty())
      throw InputError(load.where,
                       fmt::format("no node of tissue `{}` lies in the loaded region", name));
    return point;
  }

  const Scenario& scenario_;
  Model model_;
  std::vector<BodyGeometry> geometry_;       // one a body
  std::vector<collision::Surface> surface_;  // one a tissue
  std::set<std::string> pulled_at_a_point_;  // tissues
  mutable Positions free_start_;             // of the free tissue nodes, by block
};

}  // namespace

Model build_model(const Scenario& scenario) { return Builder(scenario).build(); }

Model with_pointwise_contact(Model model, Scenario scenario) {
  scenario.analysis = Scenario::Analysis::Dynamic;
  scenario.contact_response = Scenario::Response::Pointwise;
  model.is_static = false;
  make_contacts(scenario, model);
  model.linear_solver = choose_linear_solver(scenario, model);
  return model;
}

StepSettings step_settings(const Scenario& scenario) {
  const Integrator& integrator = scenario.integrator;
  return {.scheme = integrator.scheme,
          .step = integrator.step,
          .max_iterations = integrator.max_iterations,
          .tree = scenario.detection.tree};
}

}  // namespace articular::sim
