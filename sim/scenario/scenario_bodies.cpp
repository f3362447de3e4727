#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <unordered_map>

#include "sim/base/pose.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

constexpr std::array<std::string_view, 6> kFreedoms = {
    "translation.x", "translation.y", "translation.z", "rotation.x", "rotation.y", "rotation.z"};

const KeyTable& layer_keys() {
  static const KeyTable kTable{
      "layer",
      {{"thickness", {form::Quantity{kLength, kPositive}}, kRequired, "of the cartilage"},
       {"young_modulus", {form::Quantity{kStress, kPositive}}, kRequired, "its Young's modulus"},
       {"poisson_ratio", {form::Number{kPoissonRange}}, kRequired, "its Poisson's ratio"},
       {"law",
        {form::Choice{{{"linear", Layer::Law::Linear}, {"logarithmic", Layer::Law::Logarithmic}}}},
        standard("linear"),
        "p = M d/t, however deep; or p = −M ln(1 − d/t), which no force presses flat: depths are "
        "then averaged at nodes"}}};
  return kTable;
}

Layer read_layer(const Node& node) {
  const TableReader table(node, layer_keys(), "layer");
  Layer layer{table.get<double>("thickness"), table.get<double>("young_modulus"),
              table.get<double>("poisson_ratio")};
  table.read("law", layer.law);
  return layer;
}

/// "xx yy zz unit" and, if given, "xy xz yz unit". The tensor must be that of a body: its principal
/// moments are positive and none exceeds the sum of the other two.
Eigen::Matrix3d read_inertia(const Node& node) {
  constexpr double kRoundOff = 1e-9;  // relative; a flat body has a moment equal to the sum
  const Node::List& list =
      read_list(node, "one or two texts such as [\"147 246 297 kg mm^2\", \"0 0 -45 kg mm^2\"]");
  if (list.size() > 2)
    fail(node,
         fmt::format("expected \"xx yy zz unit\" and \"xy xz yz unit\", found {}", found(node)));
  Eigen::Matrix3d inertia = read_vector(list[0], kInertia).asDiagonal();
  if (list.size() == 2) {
    const Vec3 off = read_vector(list[1], kInertia);
    inertia(0, 1) = inertia(1, 0) = off[0];
    inertia(0, 2) = inertia(2, 0) = off[1];
    inertia(1, 2) = inertia(2, 1) = off[2];
  }
  const Vec3 moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(moments[0] > 0) || moments[2] > (moments[0] + moments[1]) * (1 + kRoundOff))
    fail(node,
         fmt::format("not the inertia of a body: its principal moments {:.4g}, {:.4g} and {:.4g} "
                     "kg m^2 must be positive and none larger than the sum of the others",
                     moments[0], moments[1], moments[2]));
  return inertia;
}

const KeyTable& hold_keys() {
  static const KeyTable kTable{
      "hold",
      {{"freedoms", {list_of_freedoms()}, kRequired, "motions that are taken away"},
       {"at",
        {form::Vector{kLength}},
        otherwise("centre of mass, with attached tissue"),
        "the point that is meant"},
       {"turned",
        {form::Vector{kAngle}},
        standard("0 0 0 rad"),
        "turns the axes by a rotation vector"}}};
  return kTable;
}

/// Velocities along axes that stand in space: rotations about two of them, with the third held, add
/// up to one about the third after all. So one rotation alone is never held.
Hold read_hold(const Node& node) {
  const TableReader table(node, hold_keys(), "hold");
  Hold hold;
  const Node& freedoms = table.at("freedoms");
  hold.held = read_freedoms(freedoms);
  if (std::count(hold.held.begin() + 3, hold.held.end(), true) == 1)
    fail(freedoms,
         "one rotation alone cannot be held: hold two, which leaves a hinge, or three; of two "
         "bones that move against each other, one can be the hinge of the other's third rotation");
  table.read("at", hold.at);
  hold.axes = rotation_matrix(read_turn(table, "turned"));
  return hold;
}

/// What is held starts at rest.
void check_held_velocity(const TableReader& table, const Body& body) {
  if (!body.hold) return;
  const auto check = [&](const char* key, const Vec3& velocity, std::size_t first) {
    for (std::size_t i = 0; i < 3; ++i)
      if (body.hold->held[first + i] &&
          std::abs(body.hold->axes.col(static_cast<Eigen::Index>(i)).dot(velocity)) >
              1e-12 * velocity.norm())
        fail(table.at(key), "moves along a freedom that `hold` holds");
  };
  check("velocity", body.velocity, 0);
  check("angular_velocity", body.angular_velocity, 3);
}

/// Which keys go with a kind of body, and which it needs.
void check_kind(const TableReader& table, const Body& body) {
  switch (body.kind) {
    case Body::Kind::Fixed:
      table.refuse({"material"}, "only tissue has a material");
      table.refuse({"hold"}, "a fixed body is held as a whole");
      table.refuse({"mass", "density", "center_of_mass", "inertia"}, "a fixed body has no inertia");
      table.refuse({"velocity", "angular_velocity"},
                   "a fixed body has no velocity; a [[load]] of kind \"motion\" moves it");
      if (!has_surface(body)) table.refuse({"layer"}, "the body has no mesh");
      break;
    case Body::Kind::Rigid:
      table.refuse({"material"}, "only tissue has a material");
      table.exactly_one({"mesh", "geometry"});
      table.exactly_one({"mass", "density"});
      check_held_velocity(table, body);
      break;
    case Body::Kind::Tissue:
      table.refuse({"mass", "center_of_mass", "inertia"}, "tissue has a density instead");
      table.refuse({"contact_meshes", "layer"}, "tissue touches with its own surface");
      table.refuse({"angular_velocity"}, "only a rigid body has an angular velocity");
      table.refuse({"hold"},
                   "only a rigid body has freedoms to hold; tissue is attached, or held by a "
                   "[[support]]");
      table.exactly_one({"mesh", "geometry"});
      table.at("density");
      table.at("material");
      break;
  }
}

Body read_body(const Node& node, const std::filesystem::path& folder) {
  const TableReader table(node, body_keys(), label(node, "body"));
  const auto mesh = [&](const Node& n) { return read_mesh_file(n, folder); };
  const auto contact_meshes = [&](const Node& n) { return read_contact_meshes(n, folder); };
  Body body;
  body.where = node.where;
  body.name = read_name(table.at("name"));
  table.read("kind", body.kind);
  table.at_most_one({"mesh", "geometry"});
  table.read("mesh", body.geometry, mesh);
  if (const Node* geometry = table.find("geometry")) read_geometry(*geometry, body);
  table.read("contact_meshes", body.contact_meshes, contact_meshes);
  table.read("layer", body.layer, read_layer);
  table.read("collides", body.collides);
  table.read("mass", body.mass);
  table.read("density", body.density);
  table.read("center_of_mass", body.center_of_mass);
  table.read("inertia", body.inertia, read_inertia);
  table.read("velocity", body.velocity);
  table.read("angular_velocity", body.angular_velocity);
  table.read("hold", body.hold, read_hold);
  table.read("material", body.material, read_material);
  check_kind(table, body);
  return body;
}

void append_attachments(const Node& node, const Context& context,
                        std::vector<Attachment>& attachments) {
  const TableReader table(node, attach_keys(), "[[attach]]");
  for (const Side side : read_sides(table)) {
    Context here = context;
    here.side = side;
    const Body& body = read_body_reference(table.at("body"), here);
    const Body& rigid = read_body_reference(table.at("to"), here);
    if (body.kind != Body::Kind::Tissue)
      fail(table.at("body"),
           fmt::format("only tissue can be attached, and body `{}` is none", body.name));
    if (rigid.kind == Body::Kind::Tissue)
      fail(table.at("to"),
           fmt::format("expected a fixed or rigid body to attach to, body `{}` is tissue",
                       rigid.name));
    attachments.push_back(
        {body.name, rigid.name, read_region(table.at("region"), here), node.where});
  }
}

}  // namespace

std::string_view freedom_name(std::size_t freedom) { return kFreedoms.at(freedom); }

std::array<bool, 6> read_freedoms(const Node& node) {
  std::array<bool, 6> named{};
  for (const Node& freedom : read_list(node, "a list such as [\"translation.x\"]"))
    named[static_cast<std::size_t>(read_word(freedom, list_of_freedoms().of.front()))] = true;
  return named;
}

form::List list_of_freedoms() {
  form::Choice freedoms;
  for (std::size_t i = 0; i < kFreedoms.size(); ++i) freedoms.words.emplace_back(kFreedoms[i], i);
  return list_of({freedoms});
}

const KeyTable& body_keys() {
  static const KeyTable kTable{
      "[[body]]",
      {{"name",
        {form::Text{"name"}},
        kRequired,
        "letters, digits, `_`, `-`, inner spaces; not `lines`"},
       {"kind",
        {form::Choice{{{"fixed", Body::Kind::Fixed},
                       {"rigid", Body::Kind::Rigid},
                       {"tissue", Body::Kind::Tissue}}}},
        kRequired,
        "does not move by itself; has six freedoms; is made of tetrahedra"},
       {"mesh",
        {form::Table{mesh_keys}},
        otherwise("or `geometry`; a fixed body may have none"),
        "its shape, from a file"},
       {"geometry", {form::Table{geometry_keys}}, otherwise("or `mesh`"), "its shape, built in"},
       {"density",
        {form::Quantity{kDensity, kPositive}},
        otherwise("required of tissue; rigid: or `mass`"),
        "mass density; not of a fixed body"},
       {"mass", {form::Quantity{kMass, kPositive}}, otherwise("or `density`"), "rigid only"},
       {"material",
        {form::VariantTable{material_variants}},
        otherwise("required of tissue"),
        "tissue only"},
       {"center_of_mass", {form::Vector{kLength}}, otherwise("of the mesh"), "rigid only"},
       {"inertia",
        {list_of({form::Vector{kInertia}})},
        otherwise("of the mesh"),
        "rigid only; about the centre of mass: `[\"xx yy zz unit\", \"xy xz yz unit\"]`, tensor "
        "entries; the second may be missing"},
       {"velocity",
        {form::Vector{kVelocity}},
        standard("0 0 0 m/s"),
        "at the start; rigid and tissue, dynamic only. Tissue without one begins to move with the "
        "body that it is tied to, if that is one alone"},
       {"angular_velocity",
        {form::Vector{kAngularVelocity}},
        standard("0 0 0 rad/s"),
        "at the start; rigid, dynamic only"},
       {"hold", {form::Table{hold_keys}}, kNone, "rigid only: takes freedoms away"},
       {"collides", {form::Boolean{}}, standard(true), "`false`: touches nothing"},
       {"contact_meshes",
        {list_of({form::Table{contact_mesh_keys}})},
        otherwise("the mesh"),
        "fixed and rigid: meshes that touch in its place"},
       {"layer",
        {form::Table{layer_keys}},
        kNone,
        "fixed and rigid: cartilage as an elastic layer"}}};
  return kTable;
}

const KeyTable& attach_keys() {
  static const KeyTable kTable{
      "[[attach]]",
      {{"body", {form::Text{"name of a tissue"}}, kRequired, "the tissue"},
       {"to",
        {form::Text{"name of a fixed or rigid body"}},
        kRequired,
        "the bone that moves its nodes"},
       {"region", {form::Table{region_keys}}, kRequired, "the nodes; `{}`: all"},
       mirror_key()}};
  return kTable;
}

std::vector<Body> read_bodies(const TableReader& document, const std::filesystem::path& folder) {
  std::vector<Body> bodies;
  std::unordered_map<std::string, std::size_t> index;
  read_each(entries(document, "body"), [&](const Node& node) {
    Body body = read_body(node, folder);
    const Node& name = *node.find("name");
    const auto [known, is_new] = index.try_emplace(body.name, bodies.size());
    if (!is_new) check_new_name(name, "body", body.name, std::vector{bodies[known->second]});
    // Frames are written as frames/BODY_000000.vtu, and lines_000000.vtp holds muscles and
    // ligaments.
    if (body.name == "lines") fail(name, "a body cannot be called `lines`; results use that name");
    bodies.push_back(std::move(body));
  });
  if (bodies.empty()) throw InputError(document.node().where, "the scenario has no [[body]]");
  return bodies;
}

std::vector<Attachment> read_attachments(const TableReader& document, const Context& context) {
  std::vector<Attachment> attachments;
  read_each(entries(document, "attach"),
            [&](const Node& node) { append_attachments(node, context, attachments); });
  return attachments;
}

}  // namespace articular::sim
