// What is recorded.
#include <algorithm>
#include <utility>

#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

using Names = std::vector<std::string>;

/// What probes may name, besides bodies.
struct Named {
  Names lines;     // muscles and ligaments, but for
  Names fibres;    // muscles made of a tissue's fibres
  Names wrapping;  // those that wrap around bodies
  Names supports;  // those with a name
};

std::string read_body_of_kind(const Node& node, const Context& context, Body::Kind kind,
                              std::string_view expected) {
  const Body& body = read_body_reference(node, context);
  if (body.kind != kind)
    fail(node, fmt::format("expected a {} body, body `{}` is none", expected, body.name));
  return body.name;
}

bool is_in(const std::string& name, const Names& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string read_line_reference(const Node& node, const Context& context, const Named& named) {
  std::string line = context.name(read_text(node));
  if (is_in(line, named.fibres))
    fail(node, fmt::format("muscle `{}` is made of a tissue's fibres and has no line; expected "
                           "one with a `path`",
                           line));
  if (!is_in(line, named.lines))
    fail(node, fmt::format("no muscle or ligament is called `{}`{}", one_line(line),
                           suggestion(line, named.lines)));
  return line;
}

std::string read_support_reference(const Node& node, const Context& context,
                                   const Names& supports) {
  std::string support = context.name(read_text(node));
  if (!is_in(support, supports))
    fail(node, fmt::format("no [[support]] has the name `{}`{}", one_line(support),
                           suggestion(support, supports)));
  return support;
}

/// A body that something outside the scene holds, wholly or in part.
std::string read_held_body(const Node& node, const Context& context) {
  const Body& body = read_body_reference(node, context);
  if (body.kind != Body::Kind::Fixed && !body.hold)
    fail(node, fmt::format("expected a fixed body or a rigid one with `hold`, body `{}` is {}",
                           body.name, body.kind == Body::Kind::Rigid ? "free" : "tissue"));
  return body.name;
}

/// Refuses keys of other kinds of probe.
void keep_only(const TableReader& table, std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : {"body", "point", "axis", "bodies", "line", "region", "part",
                                     "whole", "direction", "proximal", "distal", "side", "support"})
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      table.refuse({key}, fmt::format("the probe is of kind {}", found(table.at("kind"))));
}

/// Names of probes, which may come later in the file: see check_forces().
Names read_probe_names(const Node& node, const Context& context) {
  Names names;
  for (const Node& element :
       read_list(node, "a list of probes with forces, such as [\"medial\", \"lateral\"]"))
    names.push_back(context.name(read_text(element)));
  return names;
}

JointSide read_joint_side(const Node& node, const Context& context) {
  const TableReader table(node, fmt::format("`{}`", node.name), {"body", "point", "lateral", "up"});
  JointSide side;
  const Body& body = read_body_reference(table.at("body"), context);
  if (body.kind == Body::Kind::Tissue)
    fail(table.at("body"),
         fmt::format("expected a fixed or rigid body, body `{}` is tissue", body.name));
  side.body = body.name;
  side.origin = read_vector(table.at("point"), kLength);
  side.lateral = read_direction(table.at("lateral"));
  side.up = read_direction(table.at("up"));
  return side;
}

/// What a probe of one kind observes.
using Target = decltype(Probe::what);

Target read_point(const TableReader& table, const Context& context, const Named&) {
  keep_only(table, {"body", "point"});
  return PointProbe{read_anchor(table, context)};
}

Target read_angle(const TableReader& table, const Context& context, const Named&) {
  keep_only(table, {"body", "axis"});
  AngleProbe angle;
  angle.body = read_body_of_kind(table.at("body"), context, Body::Kind::Rigid, "rigid");
  table.may("axis", angle.axis, read_direction);
  return angle;
}

Target read_contact(const TableReader& table, const Context& context, const Named&) {
  keep_only(table, {"bodies", "region"});
  const Node::List& bodies = read_list(table.at("bodies"), "the names of two bodies", 2);
  ContactProbe contact;
  contact.first = read_touching_body(bodies[0], context).name;
  contact.second = read_touching_body(bodies[1], context).name;
  table.may("region", contact.region, [&](const Node& n) { return read_region(n, context); });
  if (contact.region && contact.first == contact.second)
    fail(table.at("region"), "needs two bodies: of one with itself it names no side");
  return contact;
}

Target read_line(const TableReader& table, const Context& context, const Named& named) {
  keep_only(table, {"line"});
  const Node& node = table.at("line");
  if (std::string muscle = context.name(read_text(node)); is_in(muscle, named.fibres))
    return LineProbe{std::move(muscle)};
  return LineProbe{read_line_reference(node, context, named)};
}

Target read_moment_arm(const TableReader& table, const Context& context, const Named& named) {
  keep_only(table, {"line", "body", "point", "axis"});
  table.refuse({"mirror"}, "an axis is a direction, which is not mirrored");
  MomentArmProbe arm;
  arm.line = read_line_reference(table.at("line"), context, named);
  const Body& body = read_body_reference(table.at("body"), context);
  if (body.kind == Body::Kind::Tissue)
    fail(table.at("body"),
         fmt::format("expected a fixed or rigid body, body `{}` is tissue", body.name));
  arm.body = body.name;
  arm.point = read_vector(table.at("point"), kLength);
  arm.axis = read_direction(table.at("axis"));
  return arm;
}

Target read_wrap(const TableReader& table, const Context& context, const Named& named) {
  keep_only(table, {"line"});
  WrapProbe wrap{read_line_reference(table.at("line"), context, named)};
  if (std::find(named.wrapping.begin(), named.wrapping.end(), wrap.line) == named.wrapping.end())
    fail(table.at("line"), fmt::format("`{}` has no `wrap`", wrap.line));
  return wrap;
}

Target read_energy(const TableReader& table, const Context&, const Named&) {
  keep_only(table, {});
  return EnergyProbe{};
}

Target read_reaction(const TableReader& table, const Context& context, const Named& named) {
  keep_only(table, {"body", "support"});
  table.exactly_one({"body", "support"});
  if (const Node* support = table.find("support"))
    return SupportProbe{read_support_reference(*support, context, named.supports)};
  return ReactionProbe{read_held_body(table.at("body"), context)};
}

Target read_attachment(const TableReader& table, const Context& context, const Named&) {
  keep_only(table, {"bodies"});
  const Node::List& bodies = read_list(table.at("bodies"), "a tissue and a bone", 2);
  AttachmentProbe attachment;
  attachment.tissue = read_body_of_kind(bodies[0], context, Body::Kind::Tissue, "tissue");
  const Body& rigid = read_body_reference(bodies[1], context);
  if (rigid.kind == Body::Kind::Tissue)
    fail(bodies[1], fmt::format("expected a fixed or rigid body, body `{}` is tissue", rigid.name));
  attachment.rigid = rigid.name;
  return attachment;
}

Target read_share(const TableReader& table, const Context& context, const Named&) {
  keep_only(table, {"part", "whole", "direction"});
  ShareProbe share;
  share.part = read_probe_names(table.at("part"), context);
  share.whole = read_probe_names(table.at("whole"), context);
  share.direction = read_direction(table.at("direction"));
  return share;
}

Target read_joint(const TableReader& table, const Context& context, const Named&) {
  keep_only(table, {"proximal", "distal", "side"});
  table.refuse({"mirror"}, "axes of a joint are directions, which are not mirrored");
  JointProbe joint;
  joint.proximal = read_joint_side(table.at("proximal"), context);
  joint.distal = read_joint_side(table.at("distal"), context);
  if (joint.proximal.body == joint.distal.body)
    fail(table.at("distal"), "a joint needs two bodies");
  joint.is_right = read_choice<bool>(table.at("side"), {{"right", true}, {"left", false}});
  return joint;
}

Probe read_probe(const TableReader& table, const Context& context, const Named& named) {
  Probe probe;
  probe.where = table.node().where;
  probe.name = read_name(table.at("name")) + side_suffix(table, context.side);
  const auto read = read_choice<Target (*)(const TableReader&, const Context&, const Named&)>(
      table.at("kind"), {{"point", read_point},
                         {"angle", read_angle},
                         {"contact", read_contact},
                         {"line", read_line},
                         {"moment_arm", read_moment_arm},
                         {"wrap", read_wrap},
                         {"energy", read_energy},
                         {"reaction", read_reaction},
                         {"attachment", read_attachment},
                         {"share", read_share},
                         {"joint", read_joint}});
  probe.what = read(table, context, named);
  return probe;
}

bool has_force(const Probe& probe) {
  return std::holds_alternative<ContactProbe>(probe.what) ||
         std::holds_alternative<AttachmentProbe>(probe.what) ||
         std::holds_alternative<ReactionProbe>(probe.what) ||
         std::holds_alternative<SupportProbe>(probe.what);
}

/// Shares are of probes that have a force.
void check_forces(const std::vector<Probe>& probes) {
  Names with_force;
  for (const Probe& probe : probes)
    if (has_force(probe)) with_force.push_back(probe.name);
  for (const Probe& probe : probes) {
    const auto* share = std::get_if<ShareProbe>(&probe.what);
    if (share == nullptr) continue;
    for (const Names* names : {&share->part, &share->whole})
      for (const std::string& name : *names)
        if (std::find(with_force.begin(), with_force.end(), name) == with_force.end())
          throw InputError(probe.where,
                           fmt::format("[[probe]] `{}`: expected names of contact, attachment or "
                                       "reaction probes, found `{}`{}",
                                       probe.name, one_line(name), suggestion(name, with_force)));
  }
}

void append_probes(const Node& node, const Context& context, const Named& named,
                   std::vector<Probe>& probes) {
  const TableReader table(
      node, label(node, "probe"),
      {"name", "kind", "body", "point", "axis", "bodies", "line", "region", "part", "whole",
       "direction", "proximal", "distal", "side", "support", "mirror"});
  for (const Side side : read_sides(table)) {
    Context here = context;
    here.side = side;
    Probe probe = read_probe(table, here, named);
    check_new_name(table.at("name"), "probe", probe.name, probes);
    probes.push_back(std::move(probe));
  }
}

}  // namespace

std::vector<Probe> read_probes(const TableReader& document, const Context& context,
                               const Scenario& read_so_far) {
  Named named;
  for (const Muscle& muscle : read_so_far.muscles)
    (muscle.tissue.empty() ? named.lines : named.fibres).push_back(muscle.name);
  for (const Ligament& ligament : read_so_far.ligaments) named.lines.push_back(ligament.name);
  for (const Muscle& muscle : read_so_far.muscles)
    if (!muscle.wrap.empty()) named.wrapping.push_back(muscle.name);
  for (const Ligament& ligament : read_so_far.ligaments)
    if (!ligament.wrap.empty()) named.wrapping.push_back(ligament.name);
  for (const Support& support : read_so_far.supports)
    if (!support.name.empty()) named.supports.push_back(support.name);
  std::vector<Probe> probes;
  read_each(entries(document, "probe"),
            [&](const Node& node) { append_probes(node, context, named, probes); });
  check_forces(probes);
  return probes;
}

}  // namespace articular::sim
