// What the entries of a scenario have in common: names, references to bodies, points, regions,
// curves.
#include <algorithm>
#include <numbers>

#include "sim/base/whole_turn.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

constexpr std::size_t kLongestName =
    200;  // bytes: files are called so, with a number and an ending
constexpr std::string_view kLeft = "_left", kRight = "_right";

bool is_name_character(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         c == '-' || c == ' ' || byte >= 0x80;
}

}  // namespace

std::string Context::name(const std::string& written) const {
  std::string name = written;
  if (side == Side::AsWritten) return name;
  for (std::size_t at = 0; (at = name.find(kLeft, at)) != std::string::npos; at += kRight.size())
    name.replace(at, kLeft.size(), kRight);
  return name;
}

Vec3 Context::point(const Vec3& written) const {
  return side == Side::AsWritten ? written : Vec3(-written.x(), written.y(), written.z());
}

std::string missing_hint(const Context& context, std::initializer_list<std::string_view> lists,
                         std::string_view name, const std::vector<std::string>& names) {
  for (const LeftOut& entry : context.left_out) {
    const bool is_one_of_two = name == entry.name + std::string(kLeft) ||
                               name == entry.name + std::string(kRight);  // `mirror`
    if ((name == entry.name || is_one_of_two) &&
        std::find(lists.begin(), lists.end(), entry.list) != lists.end())
      return fmt::format("; the one of {} is left out by its `when`", place_text(entry.where));
  }
  return suggestion(name, names);
}

std::string label(const Node& entry, std::string_view list) {
  const Node* name = entry.find("name");
  if (name == nullptr || name->text() == nullptr) return fmt::format("[[{}]]", list);
  return fmt::format("{} `{}`", list, one_line(*name->text()));
}

std::string read_name(const Node& node) {
  std::string name = read_text(node);
  if (!std::all_of(name.begin(), name.end(), is_name_character) || name.front() == ' ' ||
      name.back() == ' ')
    fail(node,
         fmt::format("expected a name of letters, digits, `_`, `-` and inner spaces, found {}",
                     found(node)));
  if (name.size() > kLongestName)
    fail(node, fmt::format("expected a name of at most {} characters, found {}", kLongestName,
                           name.size()));
  return name;
}

std::vector<Side> read_sides(const TableReader& table) {
  std::optional<Side> mirrored;
  if (table.knows("mirror")) table.read("mirror", mirrored);
  if (!mirrored) return {Side::AsWritten};
  return {Side::AsWritten, *mirrored};
}

std::string side_suffix(const TableReader& table, Side side) {
  if (!table.knows("mirror") || table.find("mirror") == nullptr) return "";
  return std::string(side == Side::AsWritten ? kLeft : kRight);
}

const Body& read_body_reference(const Node& node, const Context& context) {
  const std::string written = read_text(node), name = context.name(written);
  for (const Body& body : context.bodies)
    if (body.name == name) return body;
  std::vector<std::string> names;
  for (const Body& body : context.bodies) names.push_back(body.name);
  const std::string image = name == written ? "" : fmt::format(" (mirror image of `{}`)", written);
  fail(node, fmt::format("no body is called `{}`{}{}", one_line(name), image,
                         missing_hint(context, {"body"}, name, names)));
}

bool has_surface(const Body& body) {
  return !std::holds_alternative<std::monostate>(body.geometry) || !body.contact_meshes.empty();
}

const KeyTable& place_keys() {
  static const KeyTable kTable{
      "place",
      {{"rotation",
        {form::Vector{kAngle}},
        standard("0 0 0 rad"),
        "rotation vector, for R in `scale` · R (x − `about`) + `about` + `translation`"},
       {"about", {form::Vector{kLength}}, standard("0 0 0 m"), "the point about which it turns"},
       {"translation", {form::Vector{kLength}}, standard("0 0 0 m"), "the way it is moved"},
       {"scale", {form::Number{kPositive}}, standard(1.0), "factor of its size"}}};
  return kTable;
}

Vec3 read_turn(const TableReader& table, const char* key) {
  Vec3 turn = table.get<Vec3>(key);
  if (turn.norm() > kWholeTurn)
    fail(table.at(key),
         fmt::format("turns by {:.4g} degrees: expected at most 360; is the unit the "
                     "one that was meant?",
                     turn.norm() * 180 / std::numbers::pi));
  return turn;
}

Placement read_placement(const Node& node) {
  const TableReader table(node, place_keys(), "place");
  Placement placement;
  placement.rotation = read_turn(table, "rotation");
  table.read("about", placement.about);
  table.read("translation", placement.translation);
  table.read("scale", placement.scale);
  return placement;
}

std::pair<Vec3, Vec3> read_corners(const Node& node) {
  const Node::List& list =
      read_list(node, "the two corners of a box, such as [\"-6 -6 -1 mm\", \"6 6 1 mm\"]", 2);
  const Vec3 first = read_vector(list[0], kLength), second = read_vector(list[1], kLength);
  if ((first.array() > second.array()).any())
    fail(node, "expected the lower corner first: each coordinate of " + found(list[0]) +
                   " must not exceed that of " + found(list[1]));
  return {first, second};
}

namespace {

std::pair<Vec3, Vec3> read_box_region(const Node& node, const Context& context) {
  const auto [lower, upper] = read_corners(node);
  const Vec3 a = context.point(lower), b = context.point(upper);
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

const KeyTable& ball_keys() {
  static const KeyTable kTable{
      "sphere of a region",
      {{"center", {form::Vector{kLength}}, kRequired, "its centre"},
       {"radius", {form::Quantity{kLength, kPositive}}, kRequired, "its radius"}}};
  return kTable;
}

std::pair<Vec3, double> read_ball(const Node& node, const Context& context) {
  const TableReader table(node, ball_keys(), "sphere of a region");
  return {context.point(table.get<Vec3>("center")), table.get<double>("radius")};
}

const KeyTable& near_keys() {
  static const KeyTable kTable{"near",
                               {{"body", {form::Text{"name of a body"}}, kRequired, "the body"},
                                {"distance",
                                 {form::Quantity{kLength, kPositive}},
                                 kRequired,
                                 "largest distance from its surface"}}};
  return kTable;
}

std::pair<std::string, double> read_near(const Node& node, const Context& context) {
  const TableReader table(node, near_keys(), "near");
  const Body& body = read_body_reference(table.at("body"), context);
  if (!has_surface(body))
    fail(table.at("body"), fmt::format("body `{}` has no surface", body.name));
  return {body.name, table.get<double>("distance")};
}

}  // namespace

const KeyTable& region_keys() {
  static const KeyTable kTable{
      "region",
      {{"box",
        {list_of({form::Vector{kLength}}, 2)},
        kNone,
        "nodes in this box, lower corner first"},
       {"sphere", {form::Table{ball_keys}}, kNone, "nodes in this ball"},
       {"near", {form::Table{near_keys}}, kNone, "nodes close to the surface of a body"},
       {"set",
        {form::Text{"name of a set"}},
        kNone,
        "nodes of this set of the body's own mesh; a load's faces if it has faces"},
       {"surface",
        {form::Boolean{}},
        standard(false),
        "`true`: nodes of the body's own surface only"}}};
  return kTable;
}

Region read_region(const Node& node, const Context& context) {
  const TableReader table(node, region_keys(), "region");
  Region region;
  region.where = node.where;
  table.read("box", region.box, [&](const Node& n) { return read_box_region(n, context); });
  table.read("sphere", region.sphere, [&](const Node& n) { return read_ball(n, context); });
  table.read("near", region.near_body, [&](const Node& n) { return read_near(n, context); });
  table.read("set", region.set);
  table.read("surface", region.surface_only);
  return region;
}

Key when_key() {
  return {"when",
          {form::Map{"name of a choice",
                     {{form::Either{{{form::Text{"word"}}, {list_of({form::Text{"word"}})}}}}}}},
          otherwise("always"),
          "the entry exists if every choice named has this word, or one of a list of words"};
}

Key mirror_key() {
  return {"mirror",
          {form::Choice{{{"x", Side::Mirrored}}}},
          kNone,
          "makes two entries: names end with `_left`, and with `_right` where x is negated"};
}

form::List names_of_bodies(std::size_t count) {
  return list_of({form::Text{"name of a body"}}, count);
}

form::List list_of_times() { return list_of({form::Quantity{kTime, kAny}}); }

Anchor read_anchor(const TableReader& table, const Context& context) {
  Anchor anchor;
  anchor.where = table.node().where;
  const Body& body = read_body_reference(table.at("body"), context);
  anchor.body = body.name;
  anchor.point = context.point(table.get<Vec3>("point"));
  if (table.knows("radius")) table.read("radius", anchor.radius);
  if (anchor.radius > 0 && body.kind != Body::Kind::Tissue)
    fail(table.at("radius"),
         fmt::format("a radius spreads a point over tissue, and body `{}` is none", body.name));
  if (table.knows("beyond_mesh")) table.read("beyond_mesh", anchor.beyond_mesh);
  if (anchor.beyond_mesh && body.kind == Body::Kind::Tissue)
    fail(table.at("beyond_mesh"),
         fmt::format("only a bone goes on beyond its mesh, and body `{}` is tissue", body.name));
  return anchor;
}

std::vector<double> read_times(const Node& node) {
  std::vector<double> times;
  for (const Node& element : read_list(node, "a list of times such as [\"0 s\", \"0.3 s\"]")) {
    const double time = read_quantity(element, kTime, kAny);
    if (!times.empty() && time <= times.back())
      fail(element, fmt::format("times must increase, found {} after {}", found(element),
                                found((*node.list())[times.size() - 1])));
    times.push_back(time);
  }
  return times;
}

const KeyTable& curve_keys() {
  static const KeyTable kTable{
      "curve",
      {{"time", {list_of_times()}, kRequired, "times, in increasing order"},
       {"value",
        {list_of({form::Number{kAny}})},
        kRequired,
        "as many plain numbers; linear between the times, constant outside. An excitation lies "
        "between 0 and 1"}}};
  return kTable;
}

KeyType curve_or_name() {
  return {form::Either{{{form::Text{"name of a curve"}}, {form::Table{curve_keys}}}}};
}

Curve read_over_time(const TableReader& table, const char* key, const char* expected,
                     const std::function<double(const Node&)>& read_value) {
  Curve curve;
  curve.time = read_times(table.at("time"));
  const Node& values = table.at(key);
  for (const Node& element : read_list(values, expected))
    curve.value.push_back(read_value(element));
  if (curve.value.size() != curve.time.size())
    fail(values, fmt::format("expected as many {}s as times ({}), found {}", key, curve.time.size(),
                             curve.value.size()));
  return curve;
}

namespace {

/// The curve of a name.
const Node& named_curve(const Node& node, const Node* curves) {
  std::vector<std::string> names;
  if (curves != nullptr)
    for (const Member& member : curves->table()->members) names.push_back(member.key);
  const std::string name = read_text(node);
  if (curves != nullptr)
    if (const Node* curve = curves->find(name)) return *curve;
  fail(node,
       names.empty()
           ? fmt::format("no curve is called `{}`; expected it as [curve.NAME] with "
                         "`time` and `value`",
                         one_line(name))
           : fmt::format("no curve is called `{}`{}", one_line(name), suggestion(name, names)));
}

Curve read_curve_table(const Node& node, const Range& range) {
  if (node.table() == nullptr)
    fail(node, fmt::format("expected a curve such as {{ time = [\"0 s\", \"0.3 s\"], value = [0, "
                           "0.1] }} or the name of one, found {}",
                           found(node)));
  const TableReader table(node, curve_keys(), fmt::format("`{}`", one_line(node.name)));
  return read_over_time(table, "value", "a list of numbers such as [0, 0.1]",
                        [&](const Node& element) { return read_number(element, range); });
}

}  // namespace

Curve read_curve(const Node& node, const Range& range, const Context& context) {
  return read_curve_table(node.text() != nullptr ? named_curve(node, context.curves) : node, range);
}

const Node* check_curves(const TableReader& document) {
  const Node* curves = document.find("curve");
  if (curves == nullptr) return nullptr;
  if (curves->table() == nullptr)
    fail(*curves, fmt::format("expected curves as [curve.NAME] with `time` and `value`, found {}",
                              found(*curves)));
  for (const Member& member : curves->table()->members) {
    if (member.node.text() != nullptr)
      fail(member.node, "expected a curve with `time` and `value`, found " + found(member.node));
    read_curve_table(member.node, kAny);
  }
  return curves;
}

}  // namespace articular::sim
