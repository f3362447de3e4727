// Each kind of probe has two functions: measure() says what it observes now, and list() goes
// through the columns of that, each with its name, unit and value. So the header lists what a
// reading that nobody took would show.
#include "sim/output/probe_columns.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "fem/material/von_mises.hpp"
#include "sim/base/error.hpp"
#include "sim/contact/pressed_area.hpp"
#include "sim/contact/pressure_spot.hpp"
#include "sim/model/relative_motion.hpp"

namespace articular::sim {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();  // an empty cell
constexpr double kDegree = std::numbers::pi / 180;                     // [rad]

/// Takes a probe's columns one after another. A vector makes three.
class Columns {
 public:
  explicit Columns(const LengthUnit& unit)
      : length_(unit.name),
        area_(unit.name + "^2"),
        volume_(unit.name + "^3"),
        speed_(unit.name + "/s"),
        per_metre_(1 / unit.metres) {}
  virtual ~Columns() = default;

  /// Without a value the cell stays empty; a value that is given is a finite number.
  virtual void number(std::string_view what, std::string_view unit,
                      const std::optional<double>& value) = 0;
  virtual void vector(std::string_view what, std::string_view unit,
                      const std::optional<Vec3>& value) = 0;

  // Of values in m, m² and m/s, in the user's unit of length.
  void length(std::string_view what, std::optional<double> x) {
    if (x) *x *= per_metre_;
    number(what, length_, x);
  }
  void area(std::string_view what, double A) { number(what, area_, A * per_metre_ * per_metre_); }
  void volume(std::string_view what, double V) {
    number(what, volume_, V * per_metre_ * per_metre_ * per_metre_);
  }
  void place(std::string_view what, std::optional<Vec3> x) {
    if (x) *x *= per_metre_;
    vector(what, length_, x);
  }
  void speed(std::string_view what, std::optional<double> v) {
    if (v) *v *= per_metre_;
    number(what, speed_, v);
  }
  void velocity(std::string_view what, const Vec3& v) { vector(what, speed_, v * per_metre_); }

 private:
  std::string length_, area_, volume_, speed_;  // names
  double per_metre_;
};

/// Takes what they are called.
class Header : public Columns {
 public:
  Header(const std::string& probe, const LengthUnit& unit) : Columns(unit), probe_(probe) {}

  void number(std::string_view what, std::string_view unit, const std::optional<double>&) override {
    names_.push_back(fmt::format("{}.{} [{}]", probe_, what, unit));
  }
  void vector(std::string_view what, std::string_view unit, const std::optional<Vec3>&) override {
    for (const char axis : {'x', 'y', 'z'})
      names_.push_back(fmt::format("{}.{}.{} [{}]", probe_, what, axis, unit));
  }

  const std::vector<std::string>& names() const { return names_; }

 private:
  const std::string& probe_;
  std::vector<std::string> names_;
};

/// Takes what they show.
class Row : public Columns {
 public:
  Row(const std::string& probe, const LengthUnit& unit, std::vector<double>& values)
      : Columns(unit), probe_(probe), values_(values) {}

  void number(std::string_view what, std::string_view,
              const std::optional<double>& value) override {
    append(what, value);
  }
  void vector(std::string_view what, std::string_view, const std::optional<Vec3>& value) override {
    for (int k = 0; k < 3; ++k) append(what, value ? std::optional((*value)[k]) : std::nullopt);
  }

 private:
  void append(std::string_view what, const std::optional<double>& value) {
    if (value && !std::isfinite(*value))
      throw SimulationError(
          fmt::format("the simulation cannot go on: {} of probe `{}` is not finite", what, probe_));
    values_.push_back(value.value_or(kNothing));
  }

  const std::string& probe_;
  std::vector<double>& values_;
};

/// What is observed.
struct Now {
  const Model& model;
  const State& state;
  const Stepper& stepper;

  const Moment& moment() const { return stepper.now(); }
  const Configuration& configuration() const { return moment().configuration; }
  const Pose& pose(int rigid) const {
    return configuration().poses[static_cast<std::size_t>(rigid)];
  }
  const LineState& line(int index) const { return moment().lines[static_cast<std::size_t>(index)]; }
};

struct Position {
  Vec3 x = Vec3::Zero();  // [m]
};

Position measure(const ObservedPoint& point, const Now& now) {
  return {position_of(point.place, now.model, now.configuration())};
}

void list(const Position& position, Columns& columns) { columns.place("position", position.x); }

struct WayReading {
  Vec3 velocity = Vec3::Zero();  // [m/s]
  double straight = 0;           // from where it began [m]
  double length = 0;             // [m]
};

WayReading measure(const ObservedWay& observed, const Now& now) {
  const Way& way = now.state.ways[static_cast<std::size_t>(observed.way)];
  const Vec3 x = position_of(observed.place, now.model, now.configuration());
  return {velocity_of(observed.place, now.configuration()), (x - Vec3(way.x, way.y, way.z)).norm(),
          way.length};
}

void list(const WayReading& way, Columns& columns) {
  columns.velocity("velocity", way.velocity);
  columns.speed("speed", way.velocity.norm());
  columns.length("straight", way.straight);
  columns.length("length", way.length);
}

struct Turn {
  double degrees = 0;
};

Turn measure(const ObservedAngle& angle, const Now& now) {
  const Eigen::AngleAxisd turn(now.pose(angle.rigid).R);
  return {turn.angle() * turn.axis().dot(angle.axis) * 180 / std::numbers::pi};
}

void list(const Turn& turn, Columns& columns) { columns.number("angle", "deg", turn.degrees); }

/// Of an axis there is none where a body does not turn.
struct HelicalReading {
  double turn = 0, speed = 0;             // [rad], [rad/s]
  std::optional<HelicalAxis> since, now;  // since the start; now
};

HelicalReading measure(const ObservedHelicalAxis& observed, const Now& now) {
  // Beneath, round-off and the tolerance of a step decide where an axis lies.
  constexpr double kLeastTurn = 0.1 * kDegree, kLeastSpeed = 0.1 * kDegree;  // [rad], [rad/s]
  const Configuration& configuration = now.configuration();
  const auto b = static_cast<std::size_t>(observed.rigid);
  const Pose& pose = now.pose(observed.rigid);
  const RigidVelocity& velocity = configuration.velocities[b];
  const Mat3 to_frame =
      observed.frame < 0 ? Mat3(Mat3::Identity()) : Mat3(now.pose(observed.frame).R.transpose());
  const Vec3 lever = pose.R * (observed.point - now.model.rigid_bodies[b].rest.p);
  const Vec3 x = pose.p + lever, v = velocity.linear + velocity.angular.cross(lever);
  const Vec3 q_now = position_in(observed.frame, now.model, configuration, x);
  const Mat3 R = to_frame * pose.R;
  Vec3 omega = to_frame * velocity.angular;
  if (observed.frame >= 0)
    omega -= to_frame * configuration.velocities[static_cast<std::size_t>(observed.frame)].angular;
  HelicalReading reading{Eigen::AngleAxisd(R).angle(), omega.norm(), {}, {}};
  if (reading.turn > kLeastTurn) reading.since = helical_axis(R, observed.point, q_now);
  if (reading.speed > kLeastSpeed)
    reading.now = instant_axis(omega, q_now, velocity_in(observed.frame, configuration, x, v));
  return reading;
}

void list(const HelicalReading& reading, Columns& columns) {
  const auto of = [](const std::optional<HelicalAxis>& axis, auto member) {
    return axis ? std::optional((*axis).*member) : std::nullopt;
  };
  columns.number("angle", "deg", reading.turn / kDegree);
  columns.length("slide", of(reading.since, &HelicalAxis::slide));
  columns.vector("direction", "-", of(reading.since, &HelicalAxis::direction));
  columns.place("center", of(reading.since, &HelicalAxis::center));
  columns.number("speed", "deg/s", reading.speed / kDegree);
  columns.speed("slide_now", of(reading.now, &HelicalAxis::slide));
  columns.vector("direction_now", "-", of(reading.now, &HelicalAxis::direction));
  columns.place("center_now", of(reading.now, &HelicalAxis::center));
}

ContactSummary summary_of(const ObservedContact& observed, const Now& now) {
  ContactSummary sum = summary_through(now.model, now.moment().contact, now.configuration(),
                                       observed.contact, observed.body, observed.faces);
  if (now.model.contacts[observed.contact].a != observed.body) {
    sum.force *= -1;
    sum.moment *= -1;
    std::swap(sum.center_on_a, sum.center_on_b);
  }
  return sum;
}

/// What is asked for of a sensor's numbers.
struct SensorReading {
  std::optional<double> max_spot_pressure;     // [Pa]
  std::optional<double> area_above_threshold;  // [m²]
};

/// Of one that nobody has read yet.
SensorReading no_sensor_reading(const PressureSensor& sensor) {
  SensorReading reading;
  if (sensor.spot > 0) reading.max_spot_pressure = 0;
  if (sensor.threshold > 0) reading.area_above_threshold = 0;
  return reading;
}

/// Of contacts together.
SensorReading read_sensor(std::span<const ObservedContact> contacts, const PressureSensor& sensor,
                          const Now& now) {
  SensorReading reading = no_sensor_reading(sensor);
  const Moment& moment = now.moment();
  if (sensor.spot > 0) {
    std::vector<PressedTriangle> triangles;
    for (const ObservedContact& observed : contacts)
      add_pressed_triangles(now.model, moment.contact, now.configuration(), observed.contact,
                            observed.body, observed.faces, triangles);
    reading.max_spot_pressure = largest_spot_pressure(triangles, sensor.spot / 2);
  }
  if (sensor.threshold > 0)
    for (const ObservedContact& observed : contacts)
      *reading.area_above_threshold += area_above(now.model, moment.contact, observed.contact,
                                                  observed.body, observed.faces, sensor.threshold);
  return reading;
}

struct ContactReading {
  ContactSummary sum;
  SensorReading sensor;
};

ContactReading measure(const ObservedContact& observed, const Now& now) {
  return {summary_of(observed, now), read_sensor({&observed, 1}, observed.sensor, now)};
}

std::optional<Vec3> where_it_carries(const ContactSummary& sum, const Vec3& x) {
  return sum.normal_force > 0 ? std::optional(x) : std::nullopt;
}

// Shares read a force from the first three columns.
void list_load(const ContactSummary& sum, Columns& columns) {
  columns.vector("force", "N", sum.force);
  columns.vector("moment", "N m", sum.moment);
  columns.place("center", where_it_carries(sum, sum.center));
  columns.area("area", sum.area);
  const auto pressure = [&](const char* what, double p) {
    columns.number(what, "Pa", sum.is_resolved ? std::optional(p) : std::nullopt);
  };
  pressure("mean_pressure", sum.area > 0 ? sum.normal_force / sum.area : 0);
  pressure("max_pressure", sum.max_pressure);
  pressure("max_face_pressure", sum.max_face_pressure);
}

void list_sensor(const SensorReading& reading, Columns& columns) {
  if (reading.max_spot_pressure)
    columns.number("max_spot_pressure", "Pa", reading.max_spot_pressure);
  if (reading.area_above_threshold)
    columns.area("area_above_threshold", *reading.area_above_threshold);
}

void list(const ContactReading& reading, Columns& columns) {
  const ContactSummary& sum = reading.sum;
  list_load(sum, columns);
  columns.length("max_penetration", sum.max_depth);
  columns.place("max_penetration_at", where_it_carries(sum, sum.deepest));
  columns.length("max_point_penetration", sum.max_point_depth);
  columns.place("center_at_start", where_it_carries(sum, sum.center_on_a));
  list_sensor(reading.sensor, columns);
}

/// Of several contacts as one: fewer columns.
struct ContactsReading : ContactReading {};

ContactsReading measure(const ObservedContacts& observed, const Now& now) {
  ContactSummary sum;
  std::vector<ContactSummary> parts;
  for (const ObservedContact& contact : observed.of) {
    const ContactSummary& part = parts.emplace_back(summary_of(contact, now));
    sum.force += part.force;
    sum.normal_force += part.normal_force;
    sum.center += part.normal_force * part.center;
    sum.area += part.area;
    sum.max_pressure = std::max(sum.max_pressure, part.max_pressure);
    sum.max_face_pressure = std::max(sum.max_face_pressure, part.max_face_pressure);
    sum.is_resolved = sum.is_resolved && part.is_resolved;
  }
  if (sum.normal_force > 0) sum.center /= sum.normal_force;
  for (const ContactSummary& part : parts)
    sum.moment += part.moment + (part.center - sum.center).cross(part.force);
  return {{sum, read_sensor(observed.of, observed.sensor, now)}};
}

// Shares read a force from the first three columns.
void list(const ContactsReading& reading, Columns& columns) {
  list_load(reading.sum, columns);
  list_sensor(reading.sensor, columns);
}

struct MuscleReading {
  double force = 0;   // [N]
  double length = 0;  // [m]
  double activation = 0;
};

MuscleReading measure(const ObservedMuscle& muscle, const Now& now) {
  const LineState& line = now.line(muscle.line);
  return {line.tension, line.length, now.configuration().activation[muscle.muscle]};
}

void list(const MuscleReading& muscle, Columns& columns) {
  columns.number("force", "N", muscle.force);
  columns.length("length", muscle.length);
  columns.number("activation", "-", muscle.activation);
}

struct FibreReading {
  double activation = 0;
  double stretch = 0;  // mean over the volume at rest
};

/// Of a number that each element of a tissue has.
struct OverElements {
  double mean = 0, least = 0, largest = 0;  // the mean over the volume at rest
};

Eigen::Map<const Eigen::VectorXd> rest_volume(const TissueElements& elements) {
  return {elements.rest_volume().data(), static_cast<Eigen::Index>(elements.rest_volume().size())};
}

OverElements over_elements(const TissueElements& elements, const Eigen::VectorXd& value) {
  const auto volume = rest_volume(elements);
  return {value.dot(volume) / volume.sum(), value.minCoeff(), value.maxCoeff()};
}

struct Stretch : OverElements {};

Stretch measure(const ObservedStretch& observed, const Now& now) {
  const auto t = static_cast<std::size_t>(observed.tissue);
  const TissueElements& elements = now.model.tissues[t].elements;
  return {over_elements(elements, elements.fibre_stretch(now.moment().tissues[t].x))};
}

void list(const Stretch& stretch, Columns& columns) {
  columns.number("stretch", "-", stretch.mean);
  columns.number("largest_stretch", "-", stretch.largest);
  columns.number("least_stretch", "-", stretch.least);
}

struct VolumeReading {
  double volume = 0;  // [m³]
  OverElements ratio;
  double spread = 0;  // standard deviation of the ratio over the volume at rest
};

VolumeReading measure(const ObservedVolume& observed, const Now& now) {
  const auto t = static_cast<std::size_t>(observed.tissue);
  const TissueElements& elements = now.model.tissues[t].elements;
  const Eigen::VectorXd ratios = elements.volume_ratio(now.moment().tissues[t].x);
  const OverElements ratio = over_elements(elements, ratios);
  const double variance =
      over_elements(elements, (ratios.array() - ratio.mean).square().matrix()).mean;
  return {ratio.mean * rest_volume(elements).sum(), ratio, std::sqrt(variance)};
}

void list(const VolumeReading& reading, Columns& columns) {
  columns.volume("volume", reading.volume);
  columns.number("ratio", "-", reading.ratio.mean);
  columns.number("least_ratio", "-", reading.ratio.least);
  columns.number("largest_ratio", "-", reading.ratio.largest);
  columns.number("ratio_spread", "-", reading.spread);
}

struct SheetReading {
  double mean = 0, largest = 0;  // stretch; the mean over the area at rest
  double tension = 0;            // the largest [N/m]
};

SheetReading measure(const ObservedSheet& observed, const Now& now) {
  const auto t = static_cast<std::size_t>(observed.tissue);
  const fem::FibreSheet& sheet =
      now.model.tissues[t].sheets[static_cast<std::size_t>(observed.sheet)].fibres;
  const Positions& x = now.moment().tissues[t].x;
  const Eigen::VectorXd stretch = sheet.stretch(x);
  return {stretch.dot(sheet.area()) / sheet.area().sum(), stretch.maxCoeff(),
          sheet.tension(x).maxCoeff()};
}

void list(const SheetReading& sheet, Columns& columns) {
  columns.number("stretch", "-", sheet.mean);
  columns.number("largest_stretch", "-", sheet.largest);
  columns.number("largest_tension", "N/m", sheet.tension);
}

FibreReading measure(const ObservedFibres& fibres, const Now& now) {
  return {now.configuration().activation[fibres.muscle],
          measure(ObservedStretch{fibres.tissue}, now).mean};
}

void list(const FibreReading& fibres, Columns& columns) {
  columns.number("activation", "-", fibres.activation);
  columns.number("stretch", "-", fibres.stretch);
}

struct LigamentReading {
  double force = 0;   // [N]
  double length = 0;  // [m]
  double strain = 0;
};

LigamentReading measure(const ObservedLigament& ligament, const Now& now) {
  const LineState& line = now.line(ligament.line);
  const double slack =
      now.model.ligaments[static_cast<std::size_t>(ligament.ligament)].slack_length;
  return {line.tension, line.length, line.length / slack - 1};
}

void list(const LigamentReading& ligament, Columns& columns) {
  columns.number("force", "N", ligament.force);
  columns.length("length", ligament.length);
  columns.number("strain", "-", ligament.strain);
}

struct BolusReading {
  double force = 0;    // [N] with which it pushes
  double depth = 0;    // [m] by which it is pressed together now
  double deepest = 0;  // [m] so far
  double strength = 1;
};

BolusReading measure(const ObservedBolus& bolus, const Now& now) {
  const LineState& line = now.line(bolus.line);
  const BolusState& state = now.state.boluses[static_cast<std::size_t>(bolus.bolus)];
  if (!(state.height > 0)) return {};
  return {std::abs(line.tension), state.height - line.length, state.deepest, state.strength};
}

void list(const BolusReading& bolus, Columns& columns) {
  columns.number("force", "N", bolus.force);
  columns.length("depth", bolus.depth);
  columns.length("deepest", bolus.deepest);
  columns.number("strength", "-", bolus.strength);
}

struct MomentArm {
  double arm = 0;  // [m]
};

/// The moment that a tension of 1 N puts on the body, about the axis.
MomentArm measure(const ObservedMomentArm& observed, const Now& now) {
  const BodyAxis& axis = observed.axis;
  const Pose& pose = now.pose(axis.rigid);
  const Vec3 point = pose.p + pose.R * axis.point;
  return {(pose.R * axis.direction)
              .dot(moment_of_line(path_of(now.moment(), static_cast<std::size_t>(observed.line)),
                                  now.configuration(), axis.rigid, point))};
}

void list(const MomentArm& arm, Columns& columns) { columns.length("moment_arm", arm.arm); }

struct NetMoment {
  double moment = 0;  // [N m]
};

NetMoment measure(const ObservedMuscleMoment& observed, const Now& now) {
  double moment = 0;
  for (const int line : observed.lines)
    moment += now.line(line).tension * measure(ObservedMomentArm{line, observed.axis}, now).arm;
  return {moment};
}

void list(const NetMoment& net, Columns& columns) { columns.number("moment", "N m", net.moment); }

struct WrapReading {
  int edges = 0;
  double length = 0;               // [m]
  std::optional<Vec3> begin, end;  // [m]
};

WrapReading measure(const ObservedWrap& wrap, const Now& now) {
  const auto l = static_cast<std::size_t>(wrap.line);
  const LinePath& path = now.moment().paths[l];
  WrapReading reading;
  reading.length = contact_length(path);
  for (std::size_t k = 0; k < path.strings.size(); ++k) {
    const std::size_t count = path.strings[k].crossings.size();
    if (count == 0) continue;
    reading.edges += static_cast<int>(count);
    if (!reading.begin) reading.begin = path.works[k].shape.P[1];
    reading.end = path.works[k].shape.P[count];
  }
  return reading;
}

void list(const WrapReading& wrap, Columns& columns) {
  columns.number("edges", "-", wrap.edges);
  columns.length("contact_length", wrap.length);
  columns.place("begin", wrap.begin);
  columns.place("end", wrap.end);
}

struct Energies {
  StoredEnergy stored;
  EnergyLedger ledger;
  double numerical_loss = 0;  // [J]
};

Energies measure(const ObservedEnergy&, const Now& now) {
  const StoredEnergy stored = now.stepper.stored_energy();
  return {stored, now.state.energy, numerical_loss(now.state, stored)};
}

void list(const Energies& energies, Columns& columns) {
  const auto& [stored, ledger, numerical_loss] = energies;
  columns.number("kinetic", "J", stored.kinetic);
  columns.number("elastic", "J", stored.elastic);
  columns.number("gravity", "J", stored.gravity);
  columns.number("contact", "J", stored.contact);
  columns.number("lines", "J", stored.lines);
  columns.number("muscle_work", "J", ledger.muscle_work);
  columns.number("load_work", "J", ledger.load_work);
  columns.number("motion_work", "J", ledger.motion_work);
  columns.number("ligament_loss", "J", ledger.ligament_loss);
  columns.number("bolus_loss", "J", ledger.bolus_loss);
  columns.number("tissue_loss", "J", ledger.tissue_loss);
  columns.number("contact_loss", "J", ledger.contact_loss);
  columns.number("settling_loss", "J", ledger.settling_loss);
  columns.number("numerical_loss", "J", numerical_loss);
}

struct ForceAndMoment {
  Vec3 force = Vec3::Zero();   // [N]
  Vec3 moment = Vec3::Zero();  // [N m]
};

ForceAndMoment measure(const ObservedReaction& reaction, const Now& now) {
  const Vec6 both = reaction_of(now.moment(), reaction.rigid);
  return {both.head<3>(), both.tail<3>()};
}

ForceAndMoment measure(const ObservedSupport& observed, const Now& now) {
  const auto [force, moment] = force_on_support(
      now.moment(), now.model.supports[static_cast<std::size_t>(observed.support)]);
  return {force, moment};
}

ForceAndMoment measure(const ObservedAttachment& attachment, const Now& now) {
  const auto [force, moment] = attachment_force(now.moment(), attachment.tissue, attachment.rigid);
  return {force, moment};
}

// Shares read a force from the first three columns.
void list(const ForceAndMoment& reading, Columns& columns) {
  columns.vector("force", "N", reading.force);
  columns.vector("moment", "N m", reading.moment);
}

struct StressReading {
  double mean_von_mises = 0, max_von_mises = 0;       // [Pa]
  double mean_pressure = 0;                           // [Pa], positive in compression
  double least_principal = 0, largest_principal = 0;  // [Pa], negative in compression
};

/// Means are over the volume at rest.
StressReading measure(const ObservedStress& observed, const Now& now) {
  const auto t = static_cast<std::size_t>(observed.tissue);
  const Tissue& tissue = now.model.tissues[t];
  const Eigen::MatrixXd stress =
      cauchy_stress(tissue, now.moment().tissues[t], now.configuration());
  const Eigen::VectorXd von_mises = fem::von_mises(stress);
  StressReading reading;
  double volume = 0;
  reading.least_principal = std::numeric_limits<double>::infinity();
  reading.largest_principal = -reading.least_principal;
  for (const int e : observed.elements) {
    const auto s = stress.col(e);  // xx yy zz xy yz xz
    Mat3 sigma;
    sigma << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(sigma, Eigen::EigenvaluesOnly)
                               .eigenvalues();  // increasing
    const double V = tissue.elements.rest_volume()[static_cast<std::size_t>(e)];
    volume += V;
    reading.mean_von_mises += V * von_mises[e];
    reading.mean_pressure -= V * sigma.trace() / 3;
    reading.max_von_mises = std::max(reading.max_von_mises, von_mises[e]);
    reading.least_principal = std::min(reading.least_principal, principal[0]);
    reading.largest_principal = std::max(reading.largest_principal, principal[2]);
  }
  reading.mean_von_mises /= volume;
  reading.mean_pressure /= volume;
  return reading;
}

void list(const StressReading& stress, Columns& columns) {
  columns.number("mean_von_mises", "Pa", stress.mean_von_mises);
  columns.number("max_von_mises", "Pa", stress.max_von_mises);
  columns.number("mean_pressure", "Pa", stress.mean_pressure);
  columns.number("least_principal", "Pa", stress.least_principal);
  columns.number("largest_principal", "Pa", stress.largest_principal);
}

struct Extent {
  double largest = 0, least = 0;  // [m]
};

Extent measure(const ObservedExtent& observed, const Now& now) {
  const auto& [rigid, point, direction] = observed.axis;
  const Pose& pose = now.pose(rigid);
  const Vec3 along = pose.R * direction;
  const double begin = along.dot(pose.p + pose.R * point);
  const Positions& x = now.moment().tissues[static_cast<std::size_t>(observed.tissue)].x;
  const Eigen::RowVectorXd reach = along.transpose() * x;
  return {reach.maxCoeff() - begin, reach.minCoeff() - begin};
}

void list(const Extent& extent, Columns& columns) {
  columns.length("largest", extent.largest);
  columns.length("least", extent.least);
}

/// Known when the row is complete: see History.
struct Share {};

Share measure(const ObservedShare&, const Now&) { return {}; }

void list(const Share&, Columns& columns) { columns.number("share", "-", std::nullopt); }

JointCoordinates measure(const ObservedJoint& joint, const Now& now) {
  return joint_coordinates(joint.proximal, now.pose(joint.proximal.rigid), joint.distal,
                           now.pose(joint.distal.rigid), joint.is_right);
}

// Without a floating axis all but the abduction is undefined.
void list(const JointCoordinates& q, Columns& columns) {
  const auto defined = [&](double value) {
    return std::isnan(q.flexion) ? std::nullopt : std::optional(value);
  };
  columns.number("flexion", "deg", defined(q.flexion / kDegree));
  columns.number("abduction", "deg", q.abduction / kDegree);
  columns.number("internal_rotation", "deg", defined(q.internal_rotation / kDegree));
  columns.length("lateral", defined(q.lateral));
  columns.length("anterior", defined(q.anterior));
  columns.length("distraction", defined(q.distraction));
}

/// What measure() of a kind of probe gives.
template <class Kind>
using Reading = decltype(measure(std::declval<const Kind&>(), std::declval<const Now&>()));

/// A reading that nobody took.
template <class Kind>
Reading<Kind> no_reading(const Kind& observed) {
  Reading<Kind> reading;
  if constexpr (requires { observed.sensor; }) reading.sensor = no_sensor_reading(observed.sensor);
  return reading;
}

}  // namespace

std::vector<std::string> column_names(const ProbeModel& probe, const LengthUnit& unit) {
  Header header(probe.name, unit);
  std::visit([&](const auto& kind) { list(no_reading(kind), header); }, probe.what);
  return header.names();
}

void append_values(const ProbeModel& probe, const Model& model, const LengthUnit& unit,
                   const State& state, const Stepper& stepper, std::vector<double>& values) {
  const Now now{model, state, stepper};
  Row row(probe.name, unit, values);
  std::visit([&](const auto& kind) { list(measure(kind, now), row); }, probe.what);
}

}  // namespace articular::sim
