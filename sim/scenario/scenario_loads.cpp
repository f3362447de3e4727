// What acts on bodies from outside.
#include "sim/base/pose.hpp"
#include "sim/scenario/driven_motion.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

Load read_gravity(const Node& node, const Context&) {
  const TableReader table(node, "[[load]] of kind \"gravity\"", {"kind", "acceleration"});
  return GravityLoad{read_vector(table.at("acceleration"), kAcceleration), node.where};
}

Load read_force(const Node& node, const Context& context) {
  const TableReader table(node, "[[load]] of kind \"force\"",
                          {"kind", "body", "region", "point", "radius", "force", "profile"});
  ForceLoad load;
  load.where = node.where;
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
  load.force = read_vector(table.at("force"), kForce);
  table.may("profile", load.profile, [](const Node& n) { return read_curve(n, kAny); });
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

/// A rigid body's motion is along and about the axes of its hold.
void check_driven(const Body& body, const Node& list, const std::vector<Vec3>& values,
                  std::size_t first) {
  for (std::size_t k = 0; k < values.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      if (values[k][static_cast<Eigen::Index>(i)] != 0 && !body.hold->held[first + i])
        fail((*list.list())[k],
             fmt::format("drives `{}`, which `hold` of body `{}` leaves free; expected 0 there, or "
                         "the freedom among those that are held",
                         freedom_name(first + i), body.name));
}

void check_held_motion(const TableReader& table, const Body& body, const Motion& motion) {
  table.refuse({"about"}, "a rigid body turns about the point `at` of its `hold`");
  if (const Node* translation = table.find("translation"))
    check_driven(body, *translation, motion.translation, 0);
  if (const Node* rotation = table.find("rotation"))
    check_driven(body, *rotation, motion.rotation, 3);
  const Pose start = driven_pose(motion, Pose{}, 0);
  if (!start.p.isZero(0) || !start.R.isIdentity(0))
    throw InputError(
        table.node().where,
        fmt::format("{}: body `{}` starts where its mesh is, and its motion counts from there: "
                    "expected 0 at t = 0",
                    table.what(), body.name));
}

void check_can_be_driven(const Node& node, const Body& body) {
  if (body.kind == Body::Kind::Fixed || body.hold) return;
  fail(node,
       fmt::format("a motion drives a fixed body, or what `hold` of a rigid one holds; body "
                   "`{}` is {}",
                   body.name, body.kind == Body::Kind::Rigid ? "rigid, without `hold`" : "tissue"));
}

Load read_motion(const Node& node, const Context& context) {
  const TableReader table(
      node, "[[load]] of kind \"motion\"",
      {"kind", "body", "time", "translation", "rotation", "about", "interpolation"});
  MotionLoad load;
  load.where = node.where;
  const Body& body = read_body_reference(table.at("body"), context);
  check_can_be_driven(table.at("body"), body);
  load.body = body.name;
  Motion& motion = load.motion;
  motion.time = read_times(table.at("time"));
  const auto poses = [&](const QuantityKind& kind) {
    return
        [&kind, count = motion.time.size()](const Node& n) { return read_poses(n, kind, count); };
  };
  table.may("translation", motion.translation, poses(kLength));
  table.may("rotation", motion.rotation, poses(kAngle));
  if (motion.translation.empty() && motion.rotation.empty())
    throw InputError(node.where, table.what() + ": expected `translation`, `rotation` or both");
  table.may("about", motion.about, as_vector(kLength));
  table.may("interpolation", motion.smooth, [](const Node& n) {
    return read_choice<bool>(n, {{"smooth", true}, {"linear", false}});
  });
  if (body.kind == Body::Kind::Rigid) check_held_motion(table, body, motion);
  return load;
}

Load read_load(const Node& node, const Context& context) {
  if (node.table() == nullptr) fail(node, "expected a table, found " + found(node));
  const Node* kind = node.find("kind");
  if (kind == nullptr) throw InputError(node.where, "[[load]]: `kind` is missing");
  const auto read = read_choice<Load (*)(const Node&, const Context&)>(
      *kind, {{"gravity", read_gravity}, {"force", read_force}, {"motion", read_motion}});
  return read(node, context);
}

/// Throws at `node` if one of the loads so far drives the body.
void check_not_driven(const Node& node, const std::string& body, const std::vector<Load>& so_far) {
  for (const Load& load : so_far)
    if (const auto* other = std::get_if<MotionLoad>(&load); other != nullptr && other->body == body)
      fail(node, fmt::format("body `{}` already has a motion, at {}", body, place(other->where)));
}

}  // namespace

std::vector<Load> read_loads(const TableReader& document, const Context& context) {
  std::vector<Load> loads;
  read_each(entries(document, "load"), [&](const Node& node) {
    Load load = read_load(node, context);
    if (const auto* motion = std::get_if<MotionLoad>(&load))
      check_not_driven(*node.find("body"), motion->body, loads);
    loads.push_back(std::move(load));
  });
  return loads;
}

}  // namespace articular::sim
