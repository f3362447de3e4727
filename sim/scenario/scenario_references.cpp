// What the entries of a scenario have in common: names, references to bodies, points, regions,
// curves.
#include <algorithm>

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

std::string label(const Node& entry, std::string_view list) {
  const Node* name = entry.find("name");
  if (name == nullptr || name->text() == nullptr) return fmt::format("[[{}]]", list);
  return fmt::format("{} `{}`", list, one_line(*name->text()));
}

std::string place(const Location& where) {
  return where.line > 0 ? fmt::format("{}:{}", where.file, where.line) : where.file;
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
  const Node* mirror = table.find("mirror");
  if (mirror == nullptr) return {Side::AsWritten};
  read_choice<int>(*mirror, {{"x", 0}});
  return {Side::AsWritten, Side::Mirrored};
}

std::string side_suffix(const TableReader& table, Side side) {
  if (table.find("mirror") == nullptr) return "";
  return std::string(side == Side::AsWritten ? kLeft : kRight);
}

const Body& read_body_reference(const Node& node, const Context& context) {
  const std::string written = read_text(node), name = context.name(written);
  for (const Body& body : context.bodies)
    if (body.name == name) return body;
  std::vector<std::string> names;
  for (const Body& body : context.bodies) names.push_back(body.name);
  const std::string image = name == written ? "" : fmt::format(" (mirror image of `{}`)", written);
  fail(node,
       fmt::format("no body is called `{}`{}{}", one_line(name), image, suggestion(name, names)));
}

bool has_surface(const Body& body) {
  return !std::holds_alternative<std::monostate>(body.geometry) || !body.contact_meshes.empty();
}

Placement read_placement(const Node& node) {
  const TableReader table(node, "place", {"rotation", "about", "translation", "scale"});
  Placement placement;
  table.may("rotation", placement.rotation, as_vector(kAngle));
  table.may("about", placement.about, as_vector(kLength));
  table.may("translation", placement.translation, as_vector(kLength));
  table.may("scale", placement.scale, as_number(kPositive));
  return placement;
}

namespace {

std::pair<Vec3, Vec3> read_corners(const Node& node, const Context& context) {
  const Node::List& list =
      read_list(node, "the two corners of a box, such as [\"-6 -6 -1 mm\", \"6 6 1 mm\"]", 2);
  const Vec3 first = read_vector(list[0], kLength), second = read_vector(list[1], kLength);
  if ((first.array() > second.array()).any())
    fail(node, "expected the lower corner first: each coordinate of " + found(list[0]) +
                   " must not exceed that of " + found(list[1]));
  const Vec3 a = context.point(first), b = context.point(second);
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

std::pair<Vec3, double> read_ball(const Node& node, const Context& context) {
  const TableReader table(node, "sphere of a region", {"center", "radius"});
  return {context.point(read_vector(table.at("center"), kLength)),
          read_quantity(table.at("radius"), kLength, kPositive)};
}

std::pair<std::string, double> read_near(const Node& node, const Context& context) {
  const TableReader table(node, "near", {"body", "distance"});
  const Body& body = read_body_reference(table.at("body"), context);
  if (!has_surface(body))
    fail(table.at("body"), fmt::format("body `{}` has no surface", body.name));
  return {body.name, read_quantity(table.at("distance"), kLength, kPositive)};
}

}  // namespace

Region read_region(const Node& node, const Context& context) {
  const TableReader table(node, "region", {"box", "sphere", "near", "surface"});
  Region region;
  region.where = node.where;
  table.may("box", region.box, [&](const Node& n) { return read_corners(n, context); });
  table.may("sphere", region.sphere, [&](const Node& n) { return read_ball(n, context); });
  table.may("near", region.near_body, [&](const Node& n) { return read_near(n, context); });
  table.may("surface", region.surface_only, read_boolean);
  return region;
}

Anchor read_anchor(const TableReader& table, const Context& context) {
  Anchor anchor;
  anchor.where = table.node().where;
  const Body& body = read_body_reference(table.at("body"), context);
  anchor.body = body.name;
  anchor.point = context.point(read_vector(table.at("point"), kLength));
  table.may("radius", anchor.radius, as_quantity(kLength, kNotNegative));
  if (anchor.radius > 0 && body.kind != Body::Kind::Tissue)
    fail(table.at("radius"),
         fmt::format("a radius spreads a point over tissue, and body `{}` is none", body.name));
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

Curve read_curve(const Node& node, const Range& range) {
  const TableReader table(node, fmt::format("`{}`", one_line(node.name)), {"time", "value"});
  Curve curve;
  curve.time = read_times(table.at("time"));
  const Node& values = table.at("value");
  for (const Node& element : read_list(values, "a list of numbers such as [0, 0.1]"))
    curve.value.push_back(read_number(element, range));
  if (curve.value.size() != curve.time.size())
    fail(values, fmt::format("expected as many values as times ({}), found {}", curve.time.size(),
                             curve.value.size()));
  return curve;
}

}  // namespace articular::sim
