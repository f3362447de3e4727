// What acts on bodies from outside.
#include <functional>
#include <numbers>

#include "sim/base/pose.hpp"
#include "sim/scenario/data_path.hpp"
#include "sim/scenario/driven_motion.hpp"
#include "sim/scenario/motion_table.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

enum class LoadKind { Gravity, Force, Moment, Pressure, Traction, Motion };

void read_profile(const TableReader& table, const Context& context, Curve& profile) {
  table.read("profile", profile, [&](const Node& n) { return read_curve(n, kAny, context); });
}

/// What all loads have but motions.
std::vector<Key> keys_of_load(const char* word, LoadKind kind, std::string_view purpose,
                              const std::vector<Key>& own) {
  std::vector<Key> keys{{"kind", {form::Choice{{{word, kind}}}}, kRequired, purpose}};
  keys.insert(keys.end(), own.begin(), own.end());
  if (kind != LoadKind::Motion)
    keys.push_back({"profile", curve_or_name(), otherwise("1"), "factor over time"});
  return keys;
}

Key tissue_key() { return {"body", {form::Text{"name of a tissue"}}, kRequired, "the tissue"}; }

const KeyTable& gravity_keys() {
  static const KeyTable kTable{
      "[[load]]",
      keys_of_load("gravity", LoadKind::Gravity, "pulls at all masses",
                   {{"acceleration", {form::Vector{kAcceleration}}, kRequired, "of free fall"}})};
  return kTable;
}

const KeyTable& force_keys() {
  static const KeyTable kTable{
      "[[load]]",
      keys_of_load(
          "force", LoadKind::Force, "a force that keeps its direction",
          {{"body", {form::Text{"name of a rigid body or tissue"}}, kRequired, "what it acts on"},
           {"force", {form::Vector{kForce}}, kRequired, "the force"},
           {"region",
            {form::Table{region_keys}},
            otherwise("or `point`"),
            "tissue: nodes that share it equally"},
           {"point",
            {form::Vector{kLength}},
            otherwise("or `region`"),
            "where it acts at the start"},
           {"radius",
            {form::Quantity{kLength, kNotNegative}},
            standard("0 m"),
            "with `point`, tissue: spreads it over the surface nodes within"}})};
  return kTable;
}

const KeyTable& moment_keys() {
  static const KeyTable kTable{
      "[[load]]",
      keys_of_load("moment", LoadKind::Moment, "a moment whose axis stays in space",
                   {{"body", {form::Text{"name of a rigid body"}}, kRequired, "what it turns"},
                    {"moment", {form::Vector{kMoment}}, kRequired, "the moment"}})};
  return kTable;
}

const KeyTable& pressure_keys() {
  static const KeyTable kTable{
      "[[load]]",
      keys_of_load("pressure", LoadKind::Pressure,
                   "pushes inwards, normal to the surface as it moves, on the area that this has",
                   {tissue_key(),
                    {"region",
                     {form::Table{region_keys}},
                     kRequired,
                     "faces of its surface whose middles lie in it"},
                    {"pressure", {form::Quantity{kStress, kAny}}, kRequired, "the pressure"}})};
  return kTable;
}

const KeyTable& traction_keys() {
  static const KeyTable kTable{
      "[[load]]", keys_of_load("traction", LoadKind::Traction,
                               "a force per area at the start that keeps its direction",
                               {tissue_key(),
                                {"region",
                                 {form::Table{region_keys}},
                                 kRequired,
                                 "faces of its surface whose middles lie in it"},
                                {"traction", {form::Vector{kStress}}, kRequired, "the traction"}})};
  return kTable;
}

const KeyTable& motion_keys() {
  static const KeyTable kTable{
      "[[load]]",
      keys_of_load(
          "motion", LoadKind::Motion,
          "moves a fixed body, what `hold` of a rigid one holds, or what a support holds",
          {{"body",
            {form::Text{"name of a fixed or rigid body"}},
            otherwise("or `support`"),
            "what it moves"},
           {"support",
            {form::Text{"name of a support"}},
            otherwise("or `body`"),
            "moves the nodes that it holds, along its axes"},
           {"time", {list_of_times()}, otherwise("or `file`"), "times, in increasing order"},
           {"translation",
            {list_of({form::Vector{kLength}})},
            kNone,
            "one per time, from where the mesh is"},
           {"rotation", {list_of({form::Vector{kAngle}})}, kNone, "rotation vectors, one per time"},
           {"file", {form::Text{"path"}}, otherwise("or `time`"), "CSV table with the samples"},
           {"about",
            {form::Vector{kLength}},
            standard("0 0 0 m"),
            "the point about which a fixed body turns; a rigid one turns about `hold.at`"},
           {"interpolation",
            {form::Choice{{{"smooth", Motion::Interpolation::Smooth},
                           {"linear", Motion::Interpolation::Linear},
                           {"spline", Motion::Interpolation::Spline}}}},
            otherwise("`\"smooth\"`; with `file` `\"spline\"`"),
            "from rest to rest; at constant velocity; a cubic spline through all samples"},
           {"ends",
            {form::Choice{{{"rest", Motion::Ends::Rest}, {"moving", Motion::Ends::Moving}}}},
            standard("rest"),
            "of a spline: comes to rest, or goes on at its velocity"}})};
  return kTable;
}

Load read_gravity(const TableReader& table, const Context& context) {
  GravityLoad load{table.get<Vec3>("acceleration"), table.node().where};
  read_profile(table, context, load.profile);
  return load;
}

Load read_force(const TableReader& table, const Context& context) {
  ForceLoad load;
  load.where = table.node().where;
  const Body& body = read_body_reference(table.at("body"), context);
  if (body.kind == Body::Kind::Fixed)
    fail(table.at("body"),
         fmt::format("a force moves a rigid body or tissue, body `{}` is fixed", body.name));
  table.exactly_one({"region", "point"});
  if (const Node* region = table.find("region")) {
    if (body.kind != Body::Kind::Tissue)
      fail(*region,
           fmt::format("a force on a region acts on tissue; body `{}` is rigid and takes a `point`",
                       body.name));
    table.refuse({"radius"}, "it goes with `point`");
    load.at = TissueRegion{body.name, read_region(*region, context)};
  } else {
    load.at = read_anchor(table, context);
  }
  table.read("force", load.force);
  read_profile(table, context, load.profile);
  return load;
}

Load read_moment(const TableReader& table, const Context& context) {
  MomentLoad load;
  load.where = table.node().where;
  const Body& body = read_body_reference(table.at("body"), context);
  if (body.kind != Body::Kind::Rigid)
    fail(table.at("body"), fmt::format("a moment turns a rigid body, body `{}` is {}", body.name,
                                       body.kind == Body::Kind::Fixed ? "fixed" : "tissue"));
  load.body = body.name;
  table.read("moment", load.moment);
  read_profile(table, context, load.profile);
  return load;
}

/// All but its stress.
SurfaceLoad read_surface_load(const TableReader& table, const Context& context) {
  SurfaceLoad load;
  load.where = table.node().where;
  const Body& body = read_body_reference(table.at("body"), context);
  if (body.kind != Body::Kind::Tissue)
    fail(table.at("body"),
         fmt::format("it acts on the surface of a tissue, and body `{}` is none", body.name));
  load.at = TissueRegion{body.name, read_region(table.at("region"), context)};
  read_profile(table, context, load.profile);
  return load;
}

Load read_pressure(const TableReader& table, const Context& context) {
  SurfaceLoad load = read_surface_load(table, context);
  load.stress = table.get<double>("pressure");
  return load;
}

Load read_traction(const TableReader& table, const Context& context) {
  SurfaceLoad load = read_surface_load(table, context);
  load.stress = table.get<Vec3>("traction");
  return load;
}

/// The poses of a motion: as many as its times.
std::vector<Vec3> read_poses(const Node& node, const QuantityKind& kind, std::size_t count) {
  std::vector<Vec3> poses;
  for (const Node& element : read_list(node, fmt::format("a list of {} texts such as {}", count,
                                                         in_quotes(kind.vector_example))))
    poses.push_back(read_vector(element, kind));
  if (poses.size() != count)
    fail(node,
         fmt::format("expected as many entries as times ({}), found {}", count, poses.size()));
  return poses;
}

/// Refuses the k-th sample of a motion's translation (0) or rotation (1) with a message.
using RefuseSample = std::function<void(std::size_t k, int part, const std::string& message)>;

/// A rigid body's motion is along and about the axes of its hold.
void check_driven(const Body& body, const std::vector<Vec3>& values, std::size_t first,
                  const RefuseSample& refuse) {
  for (std::size_t k = 0; k < values.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      if (values[k][static_cast<Eigen::Index>(i)] != 0 && !body.hold->held[first + i])
        refuse(
            k, first == 0 ? 0 : 1,
            fmt::format("drives `{}`, which `hold` of body `{}` leaves free; expected 0 there, or "
                        "the freedom among those that are held",
                        freedom_name(first + i), body.name));
}

/// @param what  "body `femur`"
void check_start(const TableReader& table, const Motion& motion, const std::string& what) {
  const Pose start = driven_pose(motion, Pose{}, 0);
  if (!start.p.isZero(0) || !start.R.isIdentity(0))
    throw InputError(table.node().where,
                     fmt::format("{}: {} starts where its mesh is, and its motion counts from "
                                 "there: expected 0 at t = 0",
                                 table.what(), what));
}

void check_held_motion(const TableReader& table, const Body& body, const Motion& motion,
                       const RefuseSample& refuse) {
  table.refuse({"about"}, "a rigid body turns about the point `at` of its `hold`");
  check_driven(body, motion.translation, 0, refuse);
  check_driven(body, motion.rotation, 3, refuse);
  check_start(table, motion, fmt::format("body `{}`", body.name));
}

/// Of nodes that a support holds: along its axes, which are those of the samples.
void read_motion_of_support(const TableReader& table, const Support& support,
                            const RefuseSample& refuse, Motion& motion) {
  table.refuse({"about"}, "what a support holds does not turn");
  for (std::size_t k = 0; k < motion.rotation.size(); ++k)
    if (!motion.rotation[k].isZero(0))
      refuse(k, 1, "nodes of tissue have no rotation: expected translations only");
  motion.rotation.clear();
  for (std::size_t k = 0; k < motion.translation.size(); ++k) {
    Vec3 rest = motion.translation[k], way = Vec3::Zero();
    for (std::size_t a = 0; a < support.freedoms.size(); ++a) {
      double& along = rest[support.freedoms[a]];
      way += along * support.held.col(static_cast<Eigen::Index>(a));
      along = 0;
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (rest[static_cast<Eigen::Index>(i)] != 0)
        refuse(k, 0,
               fmt::format("drives `{}`, which support `{}` leaves free; expected 0 there, or the "
                           "freedom among those that are held",
                           freedom_name(i), support.name));
    motion.translation[k] = way;
  }
  fit_spline(motion);
  check_start(table, motion, fmt::format("support `{}`", support.name));
}

void check_can_be_driven(const Node& node, const Body& body) {
  if (body.kind == Body::Kind::Fixed || body.hold) return;
  fail(node,
       fmt::format("a motion drives a fixed body, or what `hold` of a rigid one holds; body "
                   "`{}` is {}",
                   body.name, body.kind == Body::Kind::Rigid ? "rigid, without `hold`" : "tissue"));
}

/// `time`, `translation` and `rotation` of a table.
RefuseSample read_written_samples(const TableReader& table, Motion& motion) {
  motion.time = read_times(table.at("time"));
  const auto poses = [&](const QuantityKind& kind) {
    return
        [&kind, count = motion.time.size()](const Node& n) { return read_poses(n, kind, count); };
  };
  table.read("translation", motion.translation, poses(kLength));
  table.read("rotation", motion.rotation, poses(kAngle));
  if (motion.translation.empty() && motion.rotation.empty())
    throw InputError(table.node().where,
                     table.what() + ": expected `translation`, `rotation` or both");
  return [&table](std::size_t k, int part, const std::string& message) {
    fail((*table.at(part == 0 ? "translation" : "rotation").list())[k], message);
  };
}

/// A recorded turn of more than 180 degrees between two samples is the other way round: a rotation
/// vector that jumped.
void check_turns(const std::vector<Vec3>& rotation, const RefuseSample& refuse) {
  constexpr double kDegree = std::numbers::pi / 180;
  for (std::size_t k = 1; k < rotation.size(); ++k) {
    const double jump = (rotation[k] - rotation[k - 1]).norm();
    if (jump > std::numbers::pi)
      refuse(
          k, 1,
          fmt::format("the rotation vector changes by {:.4g} deg from the sample before; expected "
                      "less than 180: one that goes on where it was, beyond 180 deg if need be",
                      jump / kDegree));
  }
}

/// The samples of its `file`.
RefuseSample read_recorded_samples(const TableReader& table, const Context& context,
                                   Motion& motion) {
  table.refuse({"time", "translation", "rotation"}, "the samples are those of `file`");
  const Node& file = table.at("file");
  MotionTable samples = read_motion_table(read_path(file, context.folder), file.where);
  motion.time = std::move(samples.time);
  motion.translation = std::move(samples.translation);
  motion.rotation = std::move(samples.rotation);
  motion.interpolation = Motion::Interpolation::Spline;
  RefuseSample refuse = [rows = std::move(samples.rows)](std::size_t k, int part,
                                                         const std::string& message) {
    throw InputError(rows[k],
                     fmt::format("{}: {}", part == 0 ? "translation" : "rotation", message));
  };
  check_turns(motion.rotation, refuse);
  return refuse;
}

void read_interpolation(const TableReader& table, Motion& motion) {
  constexpr std::size_t kFewest = 3;
  using Interpolation = Motion::Interpolation;
  table.read("interpolation", motion.interpolation);
  if (motion.interpolation != Interpolation::Spline) {
    table.refuse({"ends"}, "only a spline has them to choose");
    return;
  }
  if (motion.time.size() < kFewest)
    fail(table.exactly_one({"time", "file"}),
         fmt::format("a spline needs {} samples or more, found {}", kFewest, motion.time.size()));
  table.read("ends", motion.ends);
  fit_spline(motion);
}

RefuseSample read_samples(const TableReader& table, const Context& context, Motion& motion) {
  RefuseSample refuse = table.find("file") != nullptr
                            ? read_recorded_samples(table, context, motion)
                            : read_written_samples(table, motion);
  table.read("about", motion.about);
  read_interpolation(table, motion);
  return refuse;
}

Load read_motion(const TableReader& table, const Context& context,
                 const std::vector<Support>& supports) {
  MotionLoad load;
  load.where = table.node().where;
  table.exactly_one({"body", "support"});
  if (const Node* const named = table.find("support")) {
    const Support& support = read_support_reference(*named, context, supports);
    load.support = support.name;
    const RefuseSample refuse = read_samples(table, context, load.motion);
    read_motion_of_support(table, support, refuse, load.motion);
    return load;
  }
  const Body& body = read_body_reference(table.at("body"), context);
  check_can_be_driven(table.at("body"), body);
  load.body = body.name;
  const RefuseSample refuse = read_samples(table, context, load.motion);
  if (body.kind == Body::Kind::Rigid) check_held_motion(table, body, load.motion, refuse);
  return load;
}

Load read_load(const Node& node, const Context& context, const std::vector<Support>& supports) {
  const Node* kind = node.find("kind");
  const TableReader table(node, load_variants(),
                          kind != nullptr && kind->text() != nullptr
                              ? fmt::format("[[load]] of kind {}", found(*kind))
                              : "[[load]]");
  switch (table.get<LoadKind>("kind")) {
    case LoadKind::Gravity:
      return read_gravity(table, context);
    case LoadKind::Force:
      return read_force(table, context);
    case LoadKind::Moment:
      return read_moment(table, context);
    case LoadKind::Pressure:
      return read_pressure(table, context);
    case LoadKind::Traction:
      return read_traction(table, context);
    case LoadKind::Motion:
      return read_motion(table, context, supports);
  }
  return {};
}

/// Throws at `node` if one of the loads so far drives the same.
void check_not_driven(const Node& node, const MotionLoad& motion, const std::vector<Load>& so_far) {
  const bool is_of_body = motion.support.empty();
  for (const Load& load : so_far)
    if (const auto* other = std::get_if<MotionLoad>(&load);
        other != nullptr && other->body == motion.body && other->support == motion.support)
      fail(*node.find(is_of_body ? "body" : "support"),
           fmt::format("{} `{}` already has a motion, at {}", is_of_body ? "body" : "support",
                       is_of_body ? motion.body : motion.support, place_text(other->where)));
}

}  // namespace

const form::Variants& load_variants() {
  static const form::Variants kVariants{"[[load]]",
                                        "kind",
                                        "the load is of kind",
                                        {{"gravity", gravity_keys},
                                         {"force", force_keys},
                                         {"moment", moment_keys},
                                         {"pressure", pressure_keys},
                                         {"traction", traction_keys},
                                         {"motion", motion_keys}}};
  return kVariants;
}

std::vector<Load> read_loads(const TableReader& document, const Context& context,
                             const std::vector<Support>& supports) {
  std::vector<Load> loads;
  read_each(entries(document, "load"), [&](const Node& node) {
    Load load = read_load(node, context, supports);
    if (const auto* motion = std::get_if<MotionLoad>(&load)) check_not_driven(node, *motion, loads);
    loads.push_back(std::move(load));
  });
  return loads;
}

}  // namespace articular::sim
