#include "sim/lines/line_force.hpp"

#include <algorithm>

#include "sim/lines/bolus_law.hpp"
#include "sim/lines/ligament_law.hpp"
#include "sim/lines/muscle_law.hpp"
#include "sim/scenario/curve.hpp"

namespace articular::sim {
namespace {

/// @param beyond_rate  of LineState::beyond [m/s]
void muscle_tension(const MuscleModel& muscle, double activation, double beyond_rate,
                    LineState& s) {
  const Muscle& m = muscle.given;
  // The tendon does not stretch: fibres take up the whole rate.
  const double l0 = muscle.optimal_length, speed = m.max_velocity * (1 - m.tendon_ratio) * l0;
  const double a = std::clamp(activation, 0.0, 1.0);
  if (!m.force_length) {
    s.tension_per_activation = m.max_force;
    s.tension = s.active = a * m.max_force;
    return;
  }
  const double length = s.length + s.beyond;
  const ValueSlope fl = active_force_length(m.force_length_curve, length, l0, m.tendon_ratio);
  const ValueSlope fv = force_velocity((s.rate + beyond_rate) / speed);
  const ValueSlope fp = passive_force_length(length, l0, m.max_length_ratio);
  const double passive = m.max_force * m.passive_fraction;
  s.tension_per_activation = m.max_force * fl.value * fv.value;
  s.active = a * s.tension_per_activation;
  s.tension = s.active + passive * fp.value;
  s.stored = passive * passive_energy_length(length, l0, m.max_length_ratio);
  s.stiffness = std::max(0.0, m.max_force * a * fl.slope * fv.value + passive * fp.slope);
  s.viscosity = m.max_force * a * fl.value * fv.slope / speed;
}

void ligament_tension(const LigamentModel& ligament, LineState& s) {
  const Ligament& g = ligament.given;
  const double l0 = ligament.slack_length;
  ValueSlope elastic;
  if (g.law == Ligament::Law::Linear) {
    elastic = linear_ligament(s.length, l0, g.stiffness);
    s.stored = linear_ligament_energy(s.length, l0, g.stiffness);
  } else {
    elastic = blankevoort_ligament(s.length, l0, g.stiffness, g.toe_strain);
    s.stored = blankevoort_ligament_energy(s.length, l0, g.stiffness, g.toe_strain);
  }
  const Damper damper = ligament_damper(elastic, s.rate, g.damping);
  s.damping = damper.force;
  s.viscosity = damper.by_rate;
  s.stiffness = elastic.slope + damper.by_length;
  s.tension = elastic.value + s.damping;
}

void bolus_tension(const Bolus& bolus, const BolusState& state, LineState& s) {
  if (!(state.height > 0)) return;
  const double depth = state.height - s.length;
  const ValueSlope push = bolus_force(bolus, state, depth);
  s.tension = -push.value;
  s.stored = bolus_energy(bolus, state, depth);
  s.stiffness = std::max(0.0, push.slope);
}

}  // namespace

Segment segment(std::span<const WeightedPoint> path, std::size_t i,
                const Configuration& configuration) {
  const Vec3 d = configuration.position(path[i + 1]) - configuration.position(path[i]);
  const double length = d.norm();
  return {length > 0 ? Vec3(d / length) : Vec3::Zero(), length};
}

LineState line_state(const Model& model, const Line& line, std::span<const WeightedPoint> path,
                     const Configuration& configuration, std::span<const BolusState> boluses) {
  LineState s;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Segment part = segment(path, i, configuration);
    s.length += part.length;
    s.rate +=
        part.direction.dot(configuration.velocity(path[i + 1]) - configuration.velocity(path[i]));
  }
  if (line.muscle >= 0) {
    const MuscleModel& muscle = model.muscles[static_cast<std::size_t>(line.muscle)];
    s.beyond = length_beyond(muscle.given, configuration.t);
    // In statics time only orders the loads.
    const double rate = model.is_static ? 0 : slope_at(muscle.given.beyond, configuration.t);
    muscle_tension(muscle, configuration.activation[line.muscle], rate, s);
  } else if (line.ligament >= 0) {
    ligament_tension(model.ligaments[static_cast<std::size_t>(line.ligament)], s);
  } else if (!boluses.empty()) {
    const auto b = static_cast<std::size_t>(line.bolus);
    bolus_tension(model.boluses[b].given, boluses[b], s);
  }
  return s;
}

void add_line_force(std::span<const WeightedPoint> path, const Configuration& configuration,
                    double tension, Eigen::VectorXd& f) {
  for_each_pull(path, configuration, tension, [&](const WeightedPoint& point, const Vec3& force) {
    add_force(configuration, point, force, f);
  });
}

Vec3 moment_of_line(std::span<const WeightedPoint> path, const Configuration& configuration,
                    int rigid, const Vec3& about) {
  Vec3 moment = Vec3::Zero();
  for_each_pull(path, configuration, 1, [&](const WeightedPoint& point, const Vec3& force) {
    for (std::size_t k = 0; k < point.nodes.size(); ++k)
      if (point.nodes[k].rigid == rigid)
        moment += point.weights[k] * (configuration.position(point.nodes[k]) - about).cross(force);
  });
  return moment;
}

void add_line_stiffness(const Model& model, const Line& line, const Configuration& configuration,
                        const LineState& state, const SystemScale& scale, fem::BlockMatrix& A) {
  // l = Σ |P_i+1 − P_i|: ∂l/∂P_i = u_i−1 − u_i, and the Hessian couples the ends of each segment.
  const std::size_t n = line.path.size();
  std::vector<Segment> parts;
  for (std::size_t i = 0; i + 1 < n; ++i) parts.push_back(segment(line.path, i, configuration));
  const auto gradient = [&](std::size_t i) {
    Vec3 g = Vec3::Zero();
    if (i > 0) g += parts[i - 1].direction;
    if (i + 1 < n) g -= parts[i].direction;
    return g;
  };
  const auto transverse = [&](std::size_t k) -> Mat3 {
    if (!(parts[k].length > 0)) return Mat3::Zero();
    return scale.stiffness * state.tension / parts[k].length *
           (Mat3::Identity() - parts[k].direction * parts[k].direction.transpose());
  };
  const double axial = scale.stiffness * state.stiffness + scale.damping * state.viscosity;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      Mat3 K = axial * gradient(i) * gradient(j).transpose();
      if (i == j && i > 0) K += transverse(i - 1);
      if (i == j && i + 1 < n) K += transverse(i);
      if (j == i + 1) K -= transverse(i);
      if (i == j + 1) K -= transverse(j);
      const WeightedPoint &P = line.path[i], &Q = line.path[j];
      for (std::size_t a = 0; a < P.nodes.size(); ++a)
        for (std::size_t b = 0; b < Q.nodes.size(); ++b)
          add_stiffness(model, configuration, P.nodes[a], Q.nodes[b],
                        P.weights[a] * Q.weights[b] * K, A);
    }
}

void append_stencil(const Model& model, const Line& line, Stencils& stencils) {
  for (const WeightedPoint& point : line.path)
    for (const NodeRef& node : point.nodes) append_blocks(model, node, stencils.blocks);
  stencils.close();
}

}  // namespace articular::sim
