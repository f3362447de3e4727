// What is recorded.
#include <algorithm>
#include <utility>

#include "sim/scenario/name_pattern.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

using Names = std::vector<std::string>;

/// What probes may name, besides bodies.
struct Named {
  Names lines;     // muscles, ligaments and boluses, but for
  Names fibres;    // muscles made of a tissue's fibres
  Names wrapping;  // those that wrap around bodies
  Names muscles;   // with a line
  Names sheets;
  const std::vector<Support>& supports;
};

std::string read_body_of_kind(const Node& node, const Context& context, Body::Kind kind,
                              std::string_view expected) {
  const Body& body = read_body_reference(node, context);
  if (body.kind != kind)
    fail(node, fmt::format("expected a {} body, body `{}` is none", expected, body.name));
  return body.name;
}

/// A fixed or rigid body.
std::string read_bone(const Node& node, const Context& context) {
  const Body& body = read_body_reference(node, context);
  if (body.kind == Body::Kind::Tissue)
    fail(node, fmt::format("expected a fixed or rigid body, body `{}` is tissue", body.name));
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
                           missing_hint(context, {"muscle", "ligament"}, line, named.lines)));
  return line;
}

/// A body that something outside the scene holds, wholly or in part.
std::string read_held_body(const Node& node, const Context& context) {
  const Body& body = read_body_reference(node, context);
  if (body.kind != Body::Kind::Fixed && !body.hold)
    fail(node, fmt::format("expected a fixed body or a rigid one with `hold`, body `{}` is {}",
                           body.name, body.kind == Body::Kind::Rigid ? "free" : "tissue"));
  return body.name;
}

/// Names of probes, which may come later in the file: see check_forces().
Names read_probe_names(const Node& node, const Context& context) {
  Names names;
  for (const Node& element :
       read_list(node, "a list of probes with forces, such as [\"medial\", \"lateral\"]")) {
    std::string name = context.name(read_text(element));
    if (is_in(name, names))
      fail(element, fmt::format("probe `{}` is named twice, and would count twice: expected each "
                                "once",
                                one_line(name)));
    names.push_back(std::move(name));
  }
  return names;
}

const KeyTable& joint_side_keys() {
  static const KeyTable kTable{
      "side of a joint",
      {{"body", {form::Text{"name of a fixed or rigid body"}}, kRequired, "the body"},
       {"point", {form::Vector{kLength}}, kRequired, "its origin, at the start"},
       {"lateral", {form::Direction{}}, kRequired, "outwards, at the start"},
       {"up", {form::Direction{}}, kRequired, "to the trunk, at the start"}}};
  return kTable;
}

JointSide read_joint_side(const Node& node, const Context& context) {
  const TableReader table(node, joint_side_keys(), fmt::format("`{}`", node.name));
  JointSide side;
  side.body = read_bone(table.at("body"), context);
  table.read("point", side.origin);
  table.read("lateral", side.lateral);
  table.read("up", side.up);
  return side;
}

/// What a probe of one kind observes.
using Target = decltype(Probe::what);

/// The frame that a place or an axis is seen in; "" without one: the world's.
std::string read_frame(const TableReader& table, const Context& context) {
  const Node* frame = table.find("frame");
  return frame == nullptr ? "" : read_bone(*frame, context);
}

Target read_point(const TableReader& table, const Context& context, const Named&) {
  return PointProbe{read_anchor(table, context), read_frame(table, context)};
}

Target read_way(const TableReader& table, const Context& context, const Named&) {
  return WayProbe{read_anchor(table, context), read_frame(table, context)};
}

Target read_helical_axis(const TableReader& table, const Context& context, const Named&) {
  HelicalAxisProbe axis;
  axis.body = read_bone(table.at("body"), context);
  axis.frame = read_frame(table, context);
  table.read("point", axis.point);
  return axis;
}

Target read_angle(const TableReader& table, const Context& context, const Named&) {
  AngleProbe angle;
  angle.body = read_body_of_kind(table.at("body"), context, Body::Kind::Rigid, "rigid");
  table.read("axis", angle.axis);
  return angle;
}

void read_sensor(const TableReader& table, PressureSensor& sensor) {
  table.read("spot", sensor.spot);
  table.read("threshold", sensor.threshold);
}

Target read_contact(const TableReader& table, const Context& context, const Named&) {
  const Node::List& bodies = read_list(table.at("bodies"), "the names of two bodies", 2);
  ContactProbe contact;
  contact.first = read_touching_body(bodies[0], context).name;
  contact.second = read_touching_body(bodies[1], context).name;
  table.read("region", contact.region, [&](const Node& n) { return read_region(n, context); });
  read_sensor(table, contact.sensor);
  if (contact.region && contact.first == contact.second)
    fail(table.at("region"), "needs two bodies: of one with itself it names no side");
  return contact;
}

Target read_line(const TableReader& table, const Context& context, const Named& named) {
  const Node& node = table.at("line");
  if (std::string muscle = context.name(read_text(node)); is_in(muscle, named.fibres))
    return LineProbe{std::move(muscle)};
  return LineProbe{read_line_reference(node, context, named)};
}

Target read_moment_arm(const TableReader& table, const Context& context, const Named& named) {
  MomentArmProbe arm;
  arm.line = read_line_reference(table.at("line"), context, named);
  arm.body = read_bone(table.at("body"), context);
  table.read("point", arm.point);
  table.read("axis", arm.axis);
  return arm;
}

/// Muscles with a line that a pattern fits, each once.
Names muscles_that_fit(const Node& node, const Context& context, const Named& named) {
  Names found;
  for (const Node& element : read_list(node, "names of muscles such as [\"l*\"]")) {
    const std::string pattern = context.name(read_text(element));
    bool fits_one = false;
    for (const std::string& muscle : named.muscles) {
      if (!fits(pattern, muscle)) continue;
      fits_one = true;
      if (!is_in(muscle, found)) found.push_back(muscle);
    }
    if (!fits_one)
      fail(element, fmt::format("no muscle with a `path` is called `{}`{}", one_line(pattern),
                                suggestion(pattern, named.muscles)));
  }
  return found;
}

Target read_muscle_moment(const TableReader& table, const Context& context, const Named& named) {
  MuscleMomentProbe net;
  const Node* muscles = table.find("muscles");
  net.muscles = muscles == nullptr ? named.muscles : muscles_that_fit(*muscles, context, named);
  if (net.muscles.empty())
    fail(table.node(),
         "no muscle of the scene is a line, and fibres of tissue have no arm: expected "
         "a probe \"attachment\" of the tissue and the bone");
  net.body = read_bone(table.at("body"), context);
  table.read("point", net.point);
  table.read("axis", net.axis);
  return net;
}

Target read_wrap(const TableReader& table, const Context& context, const Named& named) {
  WrapProbe wrap{read_line_reference(table.at("line"), context, named)};
  if (std::find(named.wrapping.begin(), named.wrapping.end(), wrap.line) == named.wrapping.end())
    fail(table.at("line"), fmt::format("`{}` has no `wrap`", wrap.line));
  return wrap;
}

Target read_energy(const TableReader&, const Context&, const Named&) { return EnergyProbe{}; }

Target read_reaction(const TableReader& table, const Context& context, const Named& named) {
  table.exactly_one({"body", "support"});
  if (const Node* support = table.find("support"))
    return SupportProbe{read_support_reference(*support, context, named.supports).name};
  return ReactionProbe{read_held_body(table.at("body"), context)};
}

Target read_attachment(const TableReader& table, const Context& context, const Named&) {
  const Node::List& bodies = read_list(table.at("bodies"), "a tissue and a bone", 2);
  AttachmentProbe attachment;
  attachment.tissue = read_body_of_kind(bodies[0], context, Body::Kind::Tissue, "tissue");
  attachment.rigid = read_bone(bodies[1], context);
  return attachment;
}

Target read_fibres_probe(const TableReader& table, const Context& context, const Named&) {
  const Node& node = table.at("body");
  const Body& body = read_body_reference(node, context);
  if (!body.material || !body.material->fibres)
    fail(node, fmt::format("expected a tissue with fibres, body `{}` has none", body.name));
  return FibresProbe{body.name};
}

Target read_volume_probe(const TableReader& table, const Context& context, const Named&) {
  return VolumeProbe{read_body_of_kind(table.at("body"), context, Body::Kind::Tissue, "tissue")};
}

Target read_sheet_probe(const TableReader& table, const Context& context, const Named& named) {
  const Node& node = table.at("sheet");
  const std::string sheet = context.name(read_text(node));
  if (!is_in(sheet, named.sheets))
    fail(node, fmt::format("no [[sheet]] has the name `{}`{}", one_line(sheet),
                           suggestion(sheet, named.sheets)));
  return SheetProbe{sheet};
}

Target read_contacts(const TableReader& table, const Context& context, const Named&) {
  ContactsProbe contacts{read_probe_names(table.at("of"), context)};
  read_sensor(table, contacts.sensor);
  return contacts;
}

Target read_stress(const TableReader& table, const Context& context, const Named&) {
  StressProbe stress;
  stress.tissue = read_body_of_kind(table.at("body"), context, Body::Kind::Tissue, "tissue");
  table.read("region", stress.region, [&](const Node& n) { return read_region(n, context); });
  return stress;
}

Target read_extent(const TableReader& table, const Context& context, const Named&) {
  ExtentProbe extent;
  extent.tissue = read_body_of_kind(table.at("body"), context, Body::Kind::Tissue, "tissue");
  extent.frame = read_bone(table.at("frame"), context);
  table.read("point", extent.point);
  table.read("direction", extent.direction);
  return extent;
}

Target read_share(const TableReader& table, const Context& context, const Named&) {
  ShareProbe share;
  share.part = read_probe_names(table.at("part"), context);
  share.whole = read_probe_names(table.at("whole"), context);
  table.read("direction", share.direction);
  return share;
}

Target read_joint(const TableReader& table, const Context& context, const Named&) {
  JointProbe joint;
  joint.proximal = read_joint_side(table.at("proximal"), context);
  joint.distal = read_joint_side(table.at("distal"), context);
  if (joint.proximal.body == joint.distal.body)
    fail(table.at("distal"), "a joint needs two bodies");
  table.read("side", joint.is_right);
  return joint;
}

struct ProbeKind {
  std::string_view word;
  Target (*read)(const TableReader&, const Context&, const Named&);
  bool has_mirror;
  std::string_view purpose;
};
constexpr ProbeKind kProbeKinds[] = {
    {"point", read_point, true, "motion of a place"},
    {"way", read_way, true, "velocity of a place, and how far it has come"},
    {"angle", read_angle, true, "rotation of a body since the start, in (-180, 180] deg"},
    {"helical_axis", read_helical_axis, false,
     "the axis about which a body has turned since the start, by at most 180 deg, and turns now"},
    {"contact", read_contact, true,
     "what passes between two bodies; area and mean pressure are by the area before deformation, "
     "other pressures by the area now"},
    {"contacts", read_contacts, true, "what passes in several contact probes together"},
    {"line", read_line, true,
     "force and length of a muscle or ligament; activation of a muscle, strain of a ligament"},
    {"moment_arm", read_moment_arm, false,
     "moment of a tension of 1 N in a line on a body, about an axis that goes with it"},
    {"muscle_moment", read_muscle_moment, false,
     "moment of muscles on a body, about an axis that goes with it"},
    {"wrap", read_wrap, true, "where a line lies on the bodies that it wraps around"},
    {"energy", read_energy, true, "energies of the scene, work done and losses"},
    {"reaction", read_reaction, true, "force and moment on what holds a body or tissue"},
    {"attachment", read_attachment, true, "force and moment of a tissue on a bone at tied nodes"},
    {"fibres", read_fibres_probe, true, "stretch of a tissue's fibres from their free length"},
    {"volume", read_volume_probe, true, "volume of a tissue, and by that at rest of its elements"},
    {"sheet", read_sheet_probe, true,
     "stretch of a sheet's fibres, and their pull by the sheet's width"},
    {"stress", read_stress, true, "stress in a tissue or a part of it"},
    {"extent", read_extent, false,
     "how far a tissue reaches along an axis that goes with a fixed or rigid body"},
    {"share", read_share, true, "forces of some probes by those of others"},
    {"joint", read_joint, false, "joint coordinates after Grood and Suntay (1983)"}};

/// Those of a kind alone.
std::vector<Key> own_keys(std::string_view kind) {
  const Key body{"body", {form::Text{"name of a body"}}, kRequired, "the body"};
  const Key tissue{"body", {form::Text{"name of a tissue"}}, kRequired, "the tissue"};
  const Key line{"line", {form::Text{"name of a muscle or ligament"}}, kRequired, "the line"};
  const Key point{"point", {form::Vector{kLength}}, kRequired, "where it is at the start"};
  const KeyType names = {list_of({form::Text{"name of a probe with forces"}})};
  const Key frame{"frame",
                  {form::Text{"name of a fixed or rigid body"}},
                  otherwise("the world"),
                  "seen from this body, in axes that go with it and are the world's at the start"};
  const Key spot{"spot",
                 {form::Quantity{kLength, kPositive}},
                 otherwise("no such column"),
                 "diameter of a spot: adds `max_spot_pressure`, the largest mean over one"};
  const Key threshold{"threshold",
                      {form::Quantity{kStress, kPositive}},
                      otherwise("no such column"),
                      "a pressure: adds `area_above_threshold`, where at least this much acts"};
  if (kind == "point" || kind == "way") return {body, point, frame};
  if (kind == "helical_axis")
    return {body,
            frame,
            {"point",
             {form::Vector{kLength}},
             kRequired,
             "of the body, at the start: the axis is shown where it is nearest to it"}};
  if (kind == "fibres") return {body};
  if (kind == "volume") return {tissue};
  if (kind == "sheet") return {{"sheet", {form::Text{"name of a sheet"}}, kRequired, "the sheet"}};
  if (kind == "angle")
    return {body, {"axis", {form::Direction{}}, standard({1, 0, 0}), "about which it turns"}};
  if (kind == "contact")
    return {{"bodies",
             {names_of_bodies(2)},
             kRequired,
             "two bodies; results are on the first. The same name twice: a tissue with itself"},
            {"region",
             {form::Table{region_keys}},
             otherwise("all"),
             "counts only what passes through this part of the first body"},
            spot,
            threshold};
  if (kind == "contacts")
    return {{"of",
             {list_of({form::Text{"name of a contact probe"}})},
             kRequired,
             "contact probes whose forces and areas are added, and of whose pressures the largest "
             "counts; those of the same two bodies name the same one first, and share no face"},
            spot,
            threshold};
  if (kind == "muscle_moment")
    return {{"muscles",
             {list_of({form::Text{"name of a muscle"}})},
             otherwise("all with a `path`"),
             "those that count; `*` in a name stands for any characters"},
            body,
            point,
            {"axis", {form::Direction{}}, kRequired, "the axis"}};
  if (kind == "stress")
    return {tissue,
            {"region",
             {form::Table{region_keys}},
             otherwise("all"),
             "counts only elements whose middle lies there at the start"}};
  if (kind == "line" || kind == "wrap") return {line};
  if (kind == "moment_arm")
    return {line, body, point, {"axis", {form::Direction{}}, kRequired, "the axis"}};
  if (kind == "extent")
    return {tissue,
            {"frame",
             {form::Text{"name of a fixed or rigid body"}},
             kRequired,
             "the body that the axis goes with"},
            {"point", {form::Vector{kLength}}, kRequired, "where the axis begins, at the start"},
            {"direction", {form::Direction{}}, kRequired, "of the axis, at the start"}};
  if (kind == "reaction")
    return {{"body",
             {form::Text{"name of a fixed body, or a rigid one with `hold`"}},
             otherwise("or `support`"),
             "the body"},
            {"support", {form::Text{"name of a support"}}, otherwise("or `body`"), "the support"}};
  if (kind == "attachment")
    return {{"bodies", {names_of_bodies(2)}, kRequired, "the tissue, then the bone"}};
  if (kind == "share")
    return {{"part", names, kRequired, "whose forces are divided"},
            {"whole", names, kRequired, "by whose forces"},
            {"direction", {form::Direction{}}, kRequired, "along which both count"}};
  if (kind == "joint")
    return {{"proximal", {form::Table{joint_side_keys}}, kRequired, "the body that is the base"},
            {"distal", {form::Table{joint_side_keys}}, kRequired, "the body that moves"},
            {"side",
             {form::Choice{{{"left", false}, {"right", true}}}},
             kRequired,
             "of the human body"}};
  return {};
}

template <std::size_t I>
const KeyTable& probe_keys() {
  static const KeyTable kTable = [] {
    const ProbeKind& kind = kProbeKinds[I];
    KeyTable table{"[[probe]]",
                   {{"name", {form::Text{"name"}}, kRequired, "its columns begin with it"},
                    {"kind", {form::Choice{{{kind.word, I}}}}, kRequired, kind.purpose}}};
    for (Key& key : own_keys(kind.word)) table.keys.push_back(std::move(key));
    if (kind.has_mirror) table.keys.push_back(mirror_key());
    return table;
  }();
  return kTable;
}

template <std::size_t... I>
form::Variants variants_of_probes(std::index_sequence<I...>) {
  return {"[[probe]]", "kind", "the probe is of kind", {{kProbeKinds[I].word, probe_keys<I>}...}};
}

Probe read_probe(const TableReader& table, const Context& context, const Named& named) {
  Probe probe;
  probe.where = table.node().where;
  probe.name = read_name(table.at("name")) + side_suffix(table, context.side);
  for (const ProbeKind& kind : kProbeKinds)
    if (kind.word == *table.at("kind").text()) probe.what = kind.read(table, context, named);
  return probe;
}

bool has_force(const Probe& probe) {
  return std::holds_alternative<ContactProbe>(probe.what) ||
         std::holds_alternative<ContactsProbe>(probe.what) ||
         std::holds_alternative<AttachmentProbe>(probe.what) ||
         std::holds_alternative<ReactionProbe>(probe.what) ||
         std::holds_alternative<SupportProbe>(probe.what);
}

void check_named(const Probe& probe, const Names& names, const Names& allowed,
                 std::string_view expected) {
  for (const std::string& name : names)
    if (!is_in(name, allowed))
      throw InputError(
          probe.where,
          fmt::format("[[probe]] `{}`: expected names of {} probes, found `{}`{}", probe.name,
                      expected, one_line(name), suggestion(name, allowed)));
}

/// Shares are of probes that have a force; contacts are put together of contact probes.
void check_forces(const std::vector<Probe>& probes) {
  Names with_force, contacts;
  for (const Probe& probe : probes) {
    if (has_force(probe)) with_force.push_back(probe.name);
    if (std::holds_alternative<ContactProbe>(probe.what)) contacts.push_back(probe.name);
  }
  for (const Probe& probe : probes) {
    if (const auto* share = std::get_if<ShareProbe>(&probe.what))
      for (const Names* names : {&share->part, &share->whole})
        check_named(probe, *names, with_force, "contact, attachment or reaction");
    if (const auto* together = std::get_if<ContactsProbe>(&probe.what))
      check_named(probe, together->of, contacts, "contact");
  }
}

void append_probes(const Node& node, const Context& context, const Named& named,
                   std::vector<Probe>& probes) {
  const TableReader table(node, probe_variants(), label(node, "probe"));
  for (const Side side : read_sides(table)) {
    Context here = context;
    here.side = side;
    Probe probe = read_probe(table, here, named);
    check_new_name(table.at("name"), "probe", probe.name, probes);
    probes.push_back(std::move(probe));
  }
}

}  // namespace

const form::Variants& probe_variants() {
  static const form::Variants kVariants =
      variants_of_probes(std::make_index_sequence<std::size(kProbeKinds)>());
  return kVariants;
}

std::vector<Probe> read_probes(const TableReader& document, const Context& context,
                               const Scenario& read_so_far) {
  Named named{{}, {}, {}, {}, {}, read_so_far.supports};
  for (const Muscle& muscle : read_so_far.muscles) {
    (muscle.tissue.empty() ? named.lines : named.fibres).push_back(muscle.name);
    if (muscle.tissue.empty()) named.muscles.push_back(muscle.name);
  }
  for (const Sheet& sheet : read_so_far.sheets) named.sheets.push_back(sheet.name);
  for (const Ligament& ligament : read_so_far.ligaments) named.lines.push_back(ligament.name);
  for (const Bolus& bolus : read_so_far.boluses) named.lines.push_back(bolus.name);
  for (const Muscle& muscle : read_so_far.muscles)
    if (!muscle.wrap.empty()) named.wrapping.push_back(muscle.name);
  for (const Ligament& ligament : read_so_far.ligaments)
    if (!ligament.wrap.empty()) named.wrapping.push_back(ligament.name);
  std::vector<Probe> probes;
  read_each(entries(document, "probe"),
            [&](const Node& node) { append_probes(node, context, named, probes); });
  check_forces(probes);
  return probes;
}

}  // namespace articular::sim
