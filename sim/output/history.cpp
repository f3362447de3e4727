#include "sim/output/history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "sim/output/convergence.hpp"

namespace articular::sim {
namespace {

std::vector<std::string> columns_of(const ProbeModel& probe, const Model& model,
                                    const std::string& length) {
  const auto vector = [&](const std::string& what, const std::string& unit) {
    std::vector<std::string> names;
    for (const char axis : {'x', 'y', 'z'})
      names.push_back(fmt::format("{}.{}.{} [{}]", probe.given.name, what, axis, unit));
    return names;
  };
  const auto scalar = [&](const std::string& what, const std::string& unit) {
    return fmt::format("{}.{} [{}]", probe.given.name, what, unit);
  };
  switch (probe.given.kind) {
    case Probe::Kind::Point:
      return vector("position", length);
    case Probe::Kind::Angle:
      return {scalar("angle", "deg")};
    case Probe::Kind::Contact: {
      auto names = vector("force", "N");
      for (auto& name : vector("moment", "N m")) names.push_back(name);
      for (auto& name : vector("center", length)) names.push_back(name);
      names.push_back(scalar("area", length + "^2"));
      names.push_back(scalar("mean_pressure", "Pa"));
      names.push_back(scalar("max_pressure", "Pa"));
      names.push_back(scalar("max_face_pressure", "Pa"));
      names.push_back(scalar("max_penetration", length));
      for (auto& name : vector("max_penetration_at", length)) names.push_back(name);
      names.push_back(scalar("max_point_penetration", length));
      return names;
    }
    case Probe::Kind::Line: {
      std::vector<std::string> names = {scalar("force", "N"), scalar("length", length)};
      if (model.lines[static_cast<std::size_t>(probe.line)].muscle >= 0)
        names.push_back(scalar("activation", "-"));
      else
        names.push_back(scalar("strain", "-"));
      return names;
    }
    case Probe::Kind::Share:
      return {scalar("share", "-")};
    case Probe::Kind::Joint:
      return {scalar("flexion", "deg"),           scalar("abduction", "deg"),
              scalar("internal_rotation", "deg"), scalar("lateral", length),
              scalar("anterior", length),         scalar("distraction", length)};
    case Probe::Kind::Energy: {
      std::vector<std::string> names;
      for (const char* what : {"kinetic", "elastic", "gravity", "contact", "lines", "muscle_work",
                               "load_work", "motion_work", "ligament_loss", "tissue_loss",
                               "contact_loss", "settling_loss", "numerical_loss"})
        names.push_back(scalar(what, "J"));
      return names;
    }
    case Probe::Kind::Attachment:
    case Probe::Kind::Reaction: {
      auto names = vector("force", "N");
      for (auto& name : vector("moment", "N m")) names.push_back(name);
      return names;
    }
  }
  return {};
}

/// What the pair of a contact probe carries, with force and moment on the first body named.
ContactSummary summary_of(const ProbeModel& probe, const Model& model, const Stepper& stepper) {
  const auto pair =
      std::find_if(model.contacts.begin(), model.contacts.end(), [&](const ContactModel& contact) {
        return std::minmax(contact.a, contact.b) == std::minmax(probe.body, probe.other);
      });
  if (pair == model.contacts.end()) return {};
  const auto contact = static_cast<int>(pair - model.contacts.begin());
  ContactSummary sum = stepper.dynamics().contact_through(contact, probe.body, probe.faces);
  if (pair->a != probe.body) {
    sum.force *= -1;
    sum.moment *= -1;
  }
  return sum;
}

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();  // an empty cell

}  // namespace

History::History(const Model& model, LengthUnit unit)
    : model_(model), unit_(std::move(unit)), columns_{"time [s]"} {
  for (const ProbeModel& probe : model.probes)
    for (auto& name : columns_of(probe, model, unit_.name)) columns_.push_back(name);
}

void History::record(const State& state, const Stepper& stepper) {
  values_.assign(1, state.t);
  std::vector<std::size_t> begin;  // of each probe's columns
  for (const ProbeModel& probe : model_.probes) {
    begin.push_back(values_.size());
    append(probe, state, stepper);
  }
  for (std::size_t p = 0; p < model_.probes.size(); ++p)
    if (model_.probes[p].given.kind == Probe::Kind::Share)
      values_[begin[p]] = share_of(model_.probes[p], begin);
  fmt::format_to(std::back_inserter(rows_), "{:.12g}", state.t);
  for (std::size_t i = 1; i < values_.size(); ++i) {
    rows_ += ',';
    if (!std::isnan(values_[i])) fmt::format_to(std::back_inserter(rows_), "{:.9g}", values_[i]);
  }
  rows_ += '\n';
}

/// Of the row so far, in which each probe with a force begins with it.
double History::share_of(const ProbeModel& probe, const std::vector<std::size_t>& begin) const {
  const auto along = [&](const std::vector<int>& probes) {
    double sum = 0;
    for (const int p : probes)
      sum += Eigen::Map<const Vec3>(&values_[begin[static_cast<std::size_t>(p)]])
                 .dot(probe.given.direction);
    return sum;
  };
  const double whole = along(probe.whole);
  return whole != 0 ? along(probe.part) / whole : kNothing;
}

void History::append(const ProbeModel& probe, const State& state, const Stepper& stepper) {
  const double unit = 1 / unit_.metres;
  const Configuration& now = stepper.dynamics().configuration();
  const auto push = [&](const Vec3& v) { values_.insert(values_.end(), {v.x(), v.y(), v.z()}); };
  switch (probe.given.kind) {
    case Probe::Kind::Point:
      push(unit * now.position(probe.point));
      return;
    case Probe::Kind::Angle: {
      const int rigid = model_.bodies[static_cast<std::size_t>(probe.body)].rigid;
      const Eigen::AngleAxisd turn(now.poses[static_cast<std::size_t>(rigid)].R);
      values_.push_back(turn.angle() * turn.axis().dot(probe.given.axis) * 180 / std::numbers::pi);
      return;
    }
    case Probe::Kind::Contact: {
      const ContactSummary sum = summary_of(probe, model_, stepper);
      // Places where nothing is.
      const Vec3 nowhere = Vec3::Constant(kNothing);
      push(sum.force);
      push(sum.moment);
      push(sum.area > 0 ? Vec3(unit * sum.center) : nowhere);
      values_.insert(values_.end(),
                     {sum.area * unit * unit, sum.area > 0 ? sum.normal_force / sum.area : 0,
                      sum.max_pressure, sum.max_face_pressure, sum.max_depth * unit});
      push(sum.area > 0 ? Vec3(unit * sum.deepest) : nowhere);
      values_.push_back(sum.max_point_depth * unit);
      return;
    }
    case Probe::Kind::Line: {
      const LineState& line = stepper.dynamics().lines()[static_cast<std::size_t>(probe.line)];
      values_.insert(values_.end(), {line.tension, unit * line.length});
      const int muscle = model_.lines[static_cast<std::size_t>(probe.line)].muscle;
      const int ligament = model_.lines[static_cast<std::size_t>(probe.line)].ligament;
      values_.push_back(
          muscle >= 0
              ? now.activation[muscle]
              : line.length / model_.ligaments[static_cast<std::size_t>(ligament)].slack_length -
                    1);
      return;
    }
    case Probe::Kind::Share:
      values_.push_back(kNothing);  // record() puts it here when the row is there
      return;
    case Probe::Kind::Joint: {
      const auto pose = [&](const JointFrame& frame) {
        return now.poses[static_cast<std::size_t>(frame.rigid)];
      };
      const JointCoordinates q =
          joint_coordinates(probe.proximal, pose(probe.proximal), probe.distal, pose(probe.distal),
                            probe.given.is_right);
      constexpr double kDegree = std::numbers::pi / 180;
      values_.insert(values_.end(),
                     {q.flexion / kDegree, q.abduction / kDegree, q.internal_rotation / kDegree,
                      q.lateral * unit, q.anterior * unit, q.distraction * unit});
      return;
    }
    case Probe::Kind::Energy: {
      const StoredEnergy e = stepper.stored_energy();
      const EnergyLedger& l = state.energy;
      values_.insert(values_.end(),
                     {e.kinetic, e.elastic, e.gravity, e.contact, e.lines, l.muscle_work,
                      l.load_work, l.motion_work, l.ligament_loss, l.tissue_loss, l.contact_loss,
                      l.settling_loss, numerical_loss(state, e)});
      return;
    }
    case Probe::Kind::Attachment: {
      const auto [force, moment] = stepper.dynamics().attachment_force(
          model_.bodies[static_cast<std::size_t>(probe.body)].tissue,
          model_.bodies[static_cast<std::size_t>(probe.other)].rigid);
      push(force);
      push(moment);
      return;
    }
    case Probe::Kind::Reaction: {
      const int rigid = model_.bodies[static_cast<std::size_t>(probe.body)].rigid;
      const Vec6 reaction = stepper.dynamics().reaction(rigid);
      push(reaction.head<3>());
      push(reaction.tail<3>());
      return;
    }
  }
}

std::string History::text() const { return fmt::format("{}\n", fmt::join(columns_, ",")) + rows_; }

void History::resume(const std::string& earlier, double time) { rows_ = rows_until(earlier, time); }

}  // namespace articular::sim
