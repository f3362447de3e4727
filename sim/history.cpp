#include "sim/history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "sim/convergence.hpp"

namespace articular::sim {
namespace {

std::vector<std::string> columns_of(const ProbeModel& probe, const Model& model) {
  const std::string& length = model.scenario.output.length_unit_name;
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
      names.push_back(scalar("max_pressure", "Pa"));
      names.push_back(scalar("max_penetration", length));
      for (auto& name : vector("max_penetration_at", length)) names.push_back(name);
      names.push_back(scalar("max_point_penetration", length));
      return names;
    }
    case Probe::Kind::Line: {
      std::vector<std::string> names = {scalar("force", "N"), scalar("length", length)};
      if (model.lines[static_cast<std::size_t>(probe.line)].muscle >= 0)
        names.push_back(scalar("activation", "-"));
      return names;
    }
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
  const std::vector<ContactSummary> contacts = stepper.dynamics().contacts();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const ContactModel& contact = model.contacts[c];
    if (contact.a == probe.body && contact.b == probe.other) return contacts[c];
    if (contact.b == probe.body && contact.a == probe.other) {
      ContactSummary swapped = contacts[c];
      swapped.force *= -1;
      swapped.moment *= -1;
      return swapped;
    }
  }
  return {};
}

}  // namespace

History::History(const Model& model) : model_(model), columns_{"time [s]"} {
  for (const ProbeModel& probe : model.probes)
    for (auto& name : columns_of(probe, model)) columns_.push_back(name);
}

void History::record(const State& state, const Stepper& stepper) {
  values_.assign(1, state.t);
  for (const ProbeModel& probe : model_.probes) append(probe, state, stepper);
  fmt::format_to(std::back_inserter(rows_), "{:.12g}", state.t);
  for (std::size_t i = 1; i < values_.size(); ++i) {
    rows_ += ',';
    if (!std::isnan(values_[i])) fmt::format_to(std::back_inserter(rows_), "{:.9g}", values_[i]);
  }
  rows_ += '\n';
}

void History::append(const ProbeModel& probe, const State& state, const Stepper& stepper) {
  const double unit = 1 / model_.scenario.output.length_unit;
  const Configuration& now = stepper.dynamics().configuration();
  const auto push = [&](const Vec3& v) { values_.insert(values_.end(), {v.x(), v.y(), v.z()}); };
  switch (probe.given.kind) {
    case Probe::Kind::Point:
      push(unit * now.position(probe.point));
      return;
    case Probe::Kind::Angle: {
      const int bone = model_.bodies[static_cast<std::size_t>(probe.body)].bone;
      const Eigen::AngleAxisd turn(now.poses[static_cast<std::size_t>(bone)].R);
      values_.push_back(turn.angle() * turn.axis().dot(probe.given.axis) * 180 / std::numbers::pi);
      return;
    }
    case Probe::Kind::Contact: {
      const ContactSummary sum = summary_of(probe, model_, stepper);
      // Places where nothing is.
      const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
      push(sum.force);
      push(sum.moment);
      push(sum.area > 0 ? Vec3(unit * sum.center) : nowhere);
      values_.insert(values_.end(),
                     {sum.area * unit * unit, sum.max_pressure, sum.max_depth * unit});
      push(sum.area > 0 ? Vec3(unit * sum.deepest) : nowhere);
      values_.push_back(sum.max_point_depth * unit);
      return;
    }
    case Probe::Kind::Line: {
      const LineState& line = stepper.dynamics().lines()[static_cast<std::size_t>(probe.line)];
      values_.insert(values_.end(), {line.tension, unit * line.length});
      const int muscle = model_.lines[static_cast<std::size_t>(probe.line)].muscle;
      if (muscle >= 0) values_.push_back(now.activation[muscle]);
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
          model_.bodies[static_cast<std::size_t>(probe.other)].bone);
      push(force);
      push(moment);
      return;
    }
    case Probe::Kind::Reaction: {
      const int bone = model_.bodies[static_cast<std::size_t>(probe.body)].bone;
      const Vec6 reaction = stepper.dynamics().reaction(bone);
      push(reaction.head<3>());
      push(reaction.tail<3>());
      return;
    }
  }
}

std::string History::text() const { return fmt::format("{}\n", fmt::join(columns_, ",")) + rows_; }

void History::resume(const std::string& earlier, double time) { rows_ = rows_until(earlier, time); }

}  // namespace articular::sim
