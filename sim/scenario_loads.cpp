// What acts on bodies from outside, which bodies can meet, and what is recorded.
#include <algorithm>

#include "sim/scenario_reader.hpp"

namespace articular::sim {
namespace {

Load read_gravity(const Node& node) {
  const TableReader table(node, "[[load]] of kind \"gravity\"", {"kind", "acceleration"});
  Load load;
  load.kind = Load::Kind::Gravity;
  load.acceleration = read_vector(table.at("acceleration"), kAcceleration);
  return load;
}

Load read_force(const Node& node, const Context& context) {
  const TableReader table(node, "[[load]] of kind \"force\"",
                          {"kind", "body", "region", "point", "radius", "force", "profile"});
  Load load;
  load.kind = Load::Kind::Force;
  const Body& body = read_body_reference(table.at("body"), context);
  if (body.kind == Body::Kind::Fixed)
    fail(table.at("body"),
         fmt::format("a force moves a rigid body or tissue, body `{}` is fixed", body.name));
  load.body = body.name;
  table.exactly_one({"region", "point"});
  if (const Node* region = table.find("region")) {
    if (body.kind != Body::Kind::Tissue)
      fail(*region,
           fmt::format("a force on a region acts on tissue; body `{}` is rigid and takes a `point`",
                       body.name));
    table.refuse({"radius"}, "it goes with `point`");
    load.region = read_region(*region, context);
  } else {
    load.anchor = read_anchor(table, context);
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

Load read_motion(const Node& node, const Context& context) {
  const TableReader table(
      node, "[[load]] of kind \"motion\"",
      {"kind", "body", "time", "translation", "rotation", "about", "interpolation"});
  Load load;
  load.kind = Load::Kind::Motion;
  const Body& body = read_body_reference(table.at("body"), context);
  if (body.kind != Body::Kind::Fixed)
    fail(table.at("body"), fmt::format("a motion drives a fixed body, body `{}` is {}", body.name,
                                       body.kind == Body::Kind::Rigid ? "rigid" : "tissue"));
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
  table.may("about", motion.about, vector(kLength));
  table.may("interpolation", motion.smooth, [](const Node& n) {
    return read_choice<bool>(n, {{"smooth", true}, {"linear", false}});
  });
  return load;
}

Load read_load(const Node& node, const Context& context) {
  if (node.table() == nullptr) fail(node, "expected a table, found " + found(node));
  const Node* kind = node.find("kind");
  if (kind == nullptr) throw InputError(node.where, "[[load]]: `kind` is missing");
  switch (read_choice<Load::Kind>(*kind, {{"gravity", Load::Kind::Gravity},
                                          {"force", Load::Kind::Force},
                                          {"motion", Load::Kind::Motion}})) {
    case Load::Kind::Force:
      return read_force(node, context);
    case Load::Kind::Motion:
      return read_motion(node, context);
    case Load::Kind::Gravity:
      break;
  }
  return read_gravity(node);
}

/// A body that can touch something.
const Body& read_touching_body(const Node& node, const Context& context) {
  const Body& body = read_body_reference(node, context);
  if (!has_surface(body))
    fail(node, fmt::format("body `{}` has no surface that could touch", body.name));
  if (!body.collides) fail(node, fmt::format("body `{}` has collides = false", body.name));
  return body;
}

ContactPair read_contact(const Node& node, const Context& context) {
  const TableReader table(node, "[[contact]]", {"bodies", "self", "stiffness"});
  ContactPair pair;
  pair.where = node.where;
  const Node& which = table.exactly_one({"bodies", "self"});
  const bool is_self = table.find("self") != nullptr;
  const Node& first = is_self ? which : read_list(which, "the names of two bodies", 2)[0];
  const Node& second = is_self ? which : (*which.list())[1];
  const Body& a = read_touching_body(first, context);
  const Body& b = read_touching_body(second, context);
  if (&a == &b && a.kind != Body::Kind::Tissue)
    fail(second, fmt::format("only tissue can touch itself, body `{}` is rigid", a.name));
  pair.a = a.name;
  pair.b = b.name;
  table.may("stiffness", pair.stiffness, quantity(kContactStiffness, kPositive));
  return pair;
}

Probe read_probe(const TableReader& table, const Context& context,
                 const std::vector<std::string>& lines) {
  Probe probe;
  probe.where = table.node().where;
  probe.name = read_name(table.at("name")) + side_suffix(table, context.side);
  probe.kind = read_choice<Probe::Kind>(table.at("kind"), {{"point", Probe::Kind::Point},
                                                           {"angle", Probe::Kind::Angle},
                                                           {"contact", Probe::Kind::Contact},
                                                           {"line", Probe::Kind::Line},
                                                           {"energy", Probe::Kind::Energy},
                                                           {"reaction", Probe::Kind::Reaction}});
  const auto keep_only = [&](std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : {"body", "point", "axis", "bodies", "line"})
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        table.refuse({key}, fmt::format("the probe is of kind {}", found(table.at("kind"))));
  };
  const auto body_of_kind = [&](Body::Kind kind, std::string_view expected) {
    const Body& body = read_body_reference(table.at("body"), context);
    if (body.kind != kind)
      fail(table.at("body"), fmt::format("expected a {} body, `{}` is none", expected, body.name));
    return body.name;
  };
  switch (probe.kind) {
    case Probe::Kind::Point:
      keep_only({"body", "point"});
      probe.anchor = read_anchor(table, context);
      break;
    case Probe::Kind::Angle:
      keep_only({"body", "axis"});
      probe.body = body_of_kind(Body::Kind::Rigid, "rigid");
      table.may("axis", probe.axis, read_direction);
      break;
    case Probe::Kind::Contact: {
      keep_only({"bodies"});
      const Node::List& bodies = read_list(table.at("bodies"), "the names of two bodies", 2);
      probe.body = read_touching_body(bodies[0], context).name;
      probe.other = read_touching_body(bodies[1], context).name;
      break;
    }
    case Probe::Kind::Line: {
      keep_only({"line"});
      const Node& node = table.at("line");
      probe.line = context.name(read_text(node));
      if (std::find(lines.begin(), lines.end(), probe.line) == lines.end())
        fail(node, fmt::format("no muscle or ligament is called `{}`{}", one_line(probe.line),
                               suggestion(probe.line, lines)));
      break;
    }
    case Probe::Kind::Energy:
      keep_only({});
      break;
    case Probe::Kind::Reaction:
      keep_only({"body"});
      probe.body = body_of_kind(Body::Kind::Fixed, "fixed");
      break;
  }
  return probe;
}

}  // namespace

std::vector<Load> read_loads(const TableReader& document, const Context& context) {
  std::vector<Load> loads;
  for (const Node& node : entries(document, "load")) {
    Load load = read_load(node, context);
    load.where = node.where;
    for (const Load& other : loads)
      if (load.kind == Load::Kind::Motion && other.kind == Load::Kind::Motion &&
          load.body == other.body)
        fail(*node.find("body"), fmt::format("body `{}` already has a motion, at line {}",
                                             load.body, other.where.line));
    loads.push_back(std::move(load));
  }
  return loads;
}

void read_contacts(const TableReader& document, const Context& context, Scenario& scenario) {
  const Node* node = document.find("contact");
  if (node == nullptr) return;
  if (std::holds_alternative<bool>(node->value)) {
    scenario.contact = read_boolean(*node);
    return;
  }
  if (node->list() == nullptr)
    fail(*node, fmt::format("expected false or entries that start with [[contact]], found {}",
                            found(*node)));
  for (const Node& element : *node->list()) {
    ContactPair pair = read_contact(element, context);
    for (const ContactPair& other : scenario.contacts)
      if (std::minmax(pair.a, pair.b) == std::minmax(other.a, other.b))
        throw InputError(
            element.where,
            fmt::format("[[contact]]: the pair `{}`, `{}` is given twice, first at line {}", pair.a,
                        pair.b, other.where.line));
    scenario.contacts.push_back(std::move(pair));
  }
}

std::vector<Probe> read_probes(const TableReader& document, const Context& context,
                               const std::vector<Muscle>& muscles,
                               const std::vector<Ligament>& ligaments) {
  std::vector<std::string> lines;
  for (const Muscle& muscle : muscles) lines.push_back(muscle.name);
  for (const Ligament& ligament : ligaments) lines.push_back(ligament.name);
  std::vector<Probe> probes;
  for (const Node& node : entries(document, "probe")) {
    const TableReader table(node, label(node, "probe"),
                            {"name", "kind", "body", "point", "axis", "bodies", "line", "mirror"});
    for (const Side side : read_sides(table)) {
      Context here = context;
      here.side = side;
      Probe probe = read_probe(table, here, lines);
      check_new_name(table.at("name"), "probe", probe.name, probes);
      probes.push_back(std::move(probe));
    }
  }
  return probes;
}

}  // namespace articular::sim
