// Muscles and ligaments: what pulls along a path of points.
#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <optional>

#include "sim/scenario/curve.hpp"
#include "sim/scenario/data_path.hpp"
#include "sim/scenario/muscle_table.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

constexpr Range kMoreThanMinusOne{-1, kInfinity, true, "must be greater than -1"};

double read_tendon_ratio(const Node& node) {
  const double ratio = read_real(node, muscle_keys().find("tendon_ratio")->type);
  if (ratio == 1)
    fail(node, "a tendon as long as the muscle leaves no fibers, found " + found(node));
  return ratio;
}

std::vector<Anchor> read_path(const TableReader& line, const Context& context) {
  const Node& node = line.at("path");
  const Node::List& list = read_list(
      node, "a list of points such as [{ body = \"skull\", point = \"57 -4 74 mm\" }, ...]");
  if (list.size() < 2)
    fail(node, fmt::format("{} has no insertion: its path needs at least two points", line.what()));
  std::vector<Anchor> path;
  double length = 0;
  for (const Node& element : list) {
    const TableReader table(element, path_point_keys(), fmt::format("point of {}", line.what()));
    path.push_back(read_anchor(table, context));
    if (path.size() > 1) length += (path.back().point - path[path.size() - 2].point).norm();
  }
  if (!(length > 0)) fail(node, fmt::format("the path of {} has no length", line.what()));
  return path;
}

constexpr double kSamePoint = 1e-9;  // [m]

bool is_same_point(const Anchor& a, const Anchor& b) {
  return a.body == b.body && (a.point - b.point).norm() <= kSamePoint;
}

/// A line in the plane x = 0, or across it from a point to its image, would pull twice.
void refuse_own_image(const TableReader& table, const std::vector<Anchor>& path,
                      const std::vector<Anchor>& image) {
  const bool is_own_image =
      std::equal(path.begin(), path.end(), image.begin(), image.end(), is_same_point) ||
      std::equal(path.begin(), path.end(), image.rbegin(), image.rend(), is_same_point);
  if (path.empty() || !is_own_image)  // a muscle of tissue has no path
    return;
  fail(table.at("mirror"),
       fmt::format("{} is its own mirror image, and would pull twice: expected it without `mirror`",
                   table.what()));
}

/// Bodies that a line wraps around.
std::vector<std::string> read_wrap(const Node& node, const Context& context) {
  std::vector<std::string> names;
  for (const Node& element : read_list(node, "the names of bodies such as [\"femur\"]")) {
    const Body& body = read_body_reference(element, context);
    if (body.kind == Body::Kind::Tissue)
      fail(element,
           fmt::format("lines wrap around fixed and rigid bodies, body `{}` is tissue", body.name));
    if (std::holds_alternative<std::monostate>(body.geometry))
      fail(element, fmt::format("body `{}` has no surface", body.name));
    if (std::find(names.begin(), names.end(), body.name) != names.end())
      fail(element, fmt::format("body `{}` is named twice", body.name));
    names.push_back(body.name);
  }
  return names;
}

void append(const std::vector<Key>& keys, KeyTable& table) {
  table.keys.insert(table.keys.end(), keys.begin(), keys.end());
}

std::vector<Key> dynamics_keys() {
  return {
      {"passive_fraction",
       {form::Number{kNotNegative}},
       standard(0.015),
       "greatest passive force per `max_force`"},
      {"max_velocity",
       {form::Quantity{kRate, kPositive}},
       standard("10 1/s"),
       "largest speed of shortening, in optimal lengths of the fibres per second"},
      {"force_length",
       {form::Boolean{}},
       standard(true),
       "`false`: force is activation times `max_force`"},
      {"force_length_curve",
       {form::Choice{{{"cosine", Muscle::ForceLengthCurve::Cosine},
                      {"parabola", Muscle::ForceLengthCurve::Parabola}}}},
       standard("cosine"),
       "active force over the length of the fibres: none beyond 0.5 and 1.5, or 0.4 and 1.6, of "
       "their optimum"},
      {"activation_time",
       {form::Quantity{kTime, kPositive}},
       standard("15 ms"),
       "time constant of activation"},
      {"deactivation_time",
       {form::Quantity{kTime, kPositive}},
       standard("50 ms"),
       "time constant of its decay"}};
}

/// The parameters that a muscle and a table of muscles share.
void read_dynamics(const TableReader& table, Muscle& muscle) {
  table.read("passive_fraction", muscle.passive_fraction);
  table.read("max_velocity", muscle.max_velocity);
  table.read("force_length", muscle.force_length);
  if (!muscle.force_length)
    table.refuse({"passive_fraction", "max_velocity", "optimal_length", "max_length_ratio",
                  "tendon_ratio", "beyond"},
                 "with force_length = false the force depends on activation alone");
  // Not refused: one override switches off what the curve says.
  table.read("force_length_curve", muscle.force_length_curve);
  table.read("activation_time", muscle.activation_time);
  table.read("deactivation_time", muscle.deactivation_time);
}

KeyType optimal_length_type() { return {form::Quantity{kLength, kPositive}}; }

Curve read_excitation(const Node& node, const Context& context) {
  return read_curve(node, kFraction, context);
}

const KeyTable& beyond_keys() {
  static const KeyTable kTable{
      "length over time",
      {{"time", {list_of_times()}, kRequired, "times, in increasing order"},
       {"length",
        {list_of({form::Quantity{kLength, kNotNegative}})},
        kRequired,
        "as many lengths; linear between the times, constant outside"}}};
  return kTable;
}

/// A length, or one over time.
Curve read_beyond(const Node& node) {
  if (node.table() == nullptr) return {{0}, {read_quantity(node, kLength, kNotNegative)}};
  const TableReader table(node, beyond_keys(), fmt::format("`{}`", one_line(node.name)));
  return read_over_time(
      table, "length", "a list of lengths such as [\"10 mm\", \"12 mm\"]",
      [](const Node& element) { return read_quantity(element, kLength, kNotNegative); });
}

Muscle read_muscle(const TableReader& table, const Context& context) {
  const auto excitation = [&](const Node& n) { return read_excitation(n, context); };
  Muscle muscle;
  muscle.where = table.node().where;
  muscle.name = read_name(table.at("name")) + side_suffix(table, context.side);
  table.exactly_one({"path", "tissue"});
  if (const Node* tissue = table.find("tissue")) {
    table.refuse(
        {"wrap", "beyond", "max_force", "optimal_length", "max_length_ratio", "tendon_ratio",
         "passive_fraction", "max_velocity", "force_length", "force_length_curve"},
        "the muscle is made of a tissue's fibres, whose material says how they pull");
    const Body& body = read_body_reference(*tissue, context);
    if (!body.material || !body.material->fibres)
      fail(*tissue, fmt::format("body `{}` has no fibres", body.name));
    muscle.tissue = body.name;
    table.read("excitation", muscle.excitation, excitation);
    read_dynamics(table, muscle);
    return muscle;
  }
  muscle.path = read_path(table, context);
  table.read("wrap", muscle.wrap, [&](const Node& n) { return read_wrap(n, context); });
  table.read("beyond", muscle.beyond, read_beyond);
  table.at("max_force");
  table.read("max_force", muscle.max_force);
  table.read("optimal_length", muscle.optimal_length);
  table.read("max_length_ratio", muscle.max_length_ratio);
  table.read("tendon_ratio", muscle.tendon_ratio, read_tendon_ratio);
  table.read("excitation", muscle.excitation, excitation);
  read_dynamics(table, muscle);
  return muscle;
}

/// What the scenario may call the rows of a table by, each once: muscles, then rows.
std::vector<std::string> names_in(const std::vector<MuscleRow>& rows) {
  std::vector<std::string> names;
  for (const auto name : {&MuscleRow::muscle, &MuscleRow::id})
    for (const MuscleRow& row : rows)
      if (std::find(names.begin(), names.end(), row.*name) == names.end())
        names.push_back(row.*name);
  return names;
}

bool is_called(const MuscleRow& row, const std::string& name) {
  return row.muscle == name || row.id == name;
}

/// What is wrong with a name that is none of theirs; nothing if it is.
std::optional<std::string> unknown_name(const std::string& name,
                                        const std::vector<MuscleRow>& rows) {
  const std::vector<std::string> names = names_in(rows);
  if (std::find(names.begin(), names.end(), name) != names.end()) return std::nullopt;
  return fmt::format("the muscle table has no muscle or row `{}`{}", one_line(name),
                     suggestion(name, names));
}

/// The names of muscles or rows that a key lists; each must be one of the rows'.
std::vector<std::string> listed_names(const Node& node, const std::vector<MuscleRow>& rows) {
  std::vector<std::string> names;
  for (const Node& element : read_list(node, "names of muscles such as [\"geniohyoid\"]")) {
    names.push_back(read_text(element));
    if (const auto mistake = unknown_name(names.back(), rows)) fail(element, *mistake);
  }
  return names;
}

/// The rows in `only`, without those in `leave_out`.
std::vector<MuscleRow> rows_to_take(const TableReader& table, std::vector<MuscleRow> rows) {
  for (const bool listed_stay : {true, false}) {
    const Node* node = table.find(listed_stay ? "only" : "leave_out");
    if (node == nullptr) continue;
    const std::vector<std::string> names = listed_names(*node, rows);
    std::erase_if(rows, [&](const MuscleRow& row) {
      const bool listed = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return is_called(row, name);
      });
      return listed != listed_stay;
    });
    if (rows.empty()) fail(*node, "leaves none of the table's muscles");
  }
  return rows;
}

/// What a key such as `excitation` says of each row, by the name of its muscle or its own id;
/// nullptr: nothing.
/// @throws InputError for a name of no row, and where a row and its muscle are both named
std::vector<const Node*> by_row(const TableReader& table, const std::string& key,
                                const std::vector<MuscleRow>& rows) {
  std::vector<const Node*> of_row(rows.size(), nullptr);
  const Node* node = table.find(key);
  if (node == nullptr) return of_row;
  if (node->table() == nullptr)
    fail(*node,
         fmt::format("expected a table by names of muscles or rows, found {}", found(*node)));
  for (const Member& member : node->table()->members) {
    if (const auto mistake = unknown_name(member.key, rows))
      throw InputError(member.key_where, *mistake);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!is_called(rows[i], member.key)) continue;
      if (of_row[i] != nullptr)
        throw InputError(member.key_where,
                         fmt::format("row `{0}` is one of the muscle `{1}`, and `{2}` names both: "
                                     "expected either the muscle or its rows",
                                     rows[i].id, rows[i].muscle, key));
      of_row[i] = &member.node;
    }
  }
  return of_row;
}

/// The bodies of the scenario for the body names of a table.
class TableBodies {
 public:
  TableBodies(const TableReader& table, const std::vector<MuscleRow>& rows, const Context& context)
      : context_(context), renames_(table.find("bodies")) {
    if (renames_ == nullptr) return;
    std::vector<std::string> names;
    for (const MuscleRow& row : rows)
      for (const std::string& name : {row.upper_body, row.lower_body})
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    if (renames_->table() == nullptr)
      fail(*renames_, fmt::format("expected a table such as {{ hyoid = \"skull\" }}, found {}",
                                  found(*renames_)));
    for (const Member& member : renames_->table()->members) {
      if (std::find(names.begin(), names.end(), member.key) == names.end())
        throw InputError(member.key_where,
                         fmt::format("the muscle table has no body `{}`{}", one_line(member.key),
                                     suggestion(member.key, names)));
      read_body_reference(member.node, context);
    }
  }

  /// The scenario's name for a body of a row.
  std::string find(const std::string& name, const Location& row) const {
    const Node* renamed = renames_ == nullptr ? nullptr : renames_->find(name);
    if (renamed != nullptr) return read_body_reference(*renamed, context_).name;
    std::vector<std::string> names;
    for (const Body& body : context_.bodies) {
      if (body.name == name) return name;
      names.push_back(body.name);
    }
    throw InputError(
        row, fmt::format("the scenario has no body `{0}` (`bodies = {{ {0} = \"...\" }}` of the "
                         "[[muscle_table]] can rename it){1}",
                         name, suggestion(name, names)));
  }

 private:
  const Context& context_;
  const Node* renames_;
};

Vec3 placed(const double (&point_mm)[3], const Placement& placement) {
  const Vec3 point = 1e-3 * Vec3(point_mm[0], point_mm[1], point_mm[2]);
  const double angle = placement.rotation.norm();
  const Vec3 axis = angle > 0 ? Vec3(placement.rotation / angle) : Vec3::UnitX();
  return placement.scale * (Eigen::AngleAxisd(angle, axis) * (point - placement.about)) +
         placement.about + placement.translation;
}

void append_table(const Node& node, const Context& context, std::vector<Muscle>& muscles) {
  const TableReader table(node, muscle_table_keys(), "[[muscle_table]]");
  const Node& file = table.at("file");
  const std::vector<MuscleRow> rows =
      rows_to_take(table, read_muscle_table(read_path(file, context.folder), file.where));
  const TableBodies bodies(table, rows, context);
  const std::vector<const Node*> excitations = by_row(table, "excitation", rows);
  const std::vector<const Node*> optimal_lengths = by_row(table, "optimal_length", rows);
  Placement placement;
  table.read("place", placement, read_placement);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const MuscleRow& row = rows[i];
    const Node id{row.id, "id", row.where};
    Muscle muscle;
    muscle.where = row.where;
    muscle.name = read_name(id);
    check_new_name(id, "muscle", muscle.name, muscles);
    muscle.path = {
        {bodies.find(row.upper_body, row.where), placed(row.upper_mm, placement), 0, row.where},
        {bodies.find(row.lower_body, row.where), placed(row.lower_mm, placement), 0, row.where}};
    muscle.max_force = row.max_force;
    if (row.optimal_length) muscle.optimal_length = placement.scale * *row.optimal_length;
    if (optimal_lengths[i] != nullptr)
      muscle.optimal_length = read_real(*optimal_lengths[i], optimal_length_type());
    muscle.max_length_ratio = row.max_length_ratio;
    muscle.tendon_ratio = row.tendon_ratio;
    read_dynamics(table, muscle);
    if (excitations[i] != nullptr) muscle.excitation = read_excitation(*excitations[i], context);
    muscles.push_back(std::move(muscle));
  }
}

void read_slack(const TableReader& table, Ligament& ligament) {
  table.at_most_one({"slack_length", "slack_extension", "reference_strain"});
  table.read("slack_length", ligament.slack_length);
  table.read("slack_extension", ligament.slack_extension);
  table.read("reference_strain", ligament.reference_strain);
}

Ligament read_ligament(const TableReader& table, const Context& context) {
  Ligament ligament;
  ligament.where = table.node().where;
  ligament.name = read_name(table.at("name")) + side_suffix(table, context.side);
  ligament.path = read_path(table, context);
  table.read("wrap", ligament.wrap, [&](const Node& n) { return read_wrap(n, context); });
  table.exactly_one({"stiffness", "stiffness_per_strain"});
  table.read("stiffness", ligament.stiffness);
  if (table.find("stiffness_per_strain") != nullptr) {
    ligament.law = Ligament::Law::Blankevoort;
    table.read("stiffness_per_strain", ligament.stiffness);
    table.read("toe_strain", ligament.toe_strain);
  } else {
    table.refuse({"toe_strain"},
                 "a ligament with `stiffness` is linear; `stiffness_per_strain` has a toe");
  }
  table.read("damping", ligament.damping);
  read_slack(table, ligament);
  return ligament;
}

void append_muscles(const Node& node, const Context& context, std::vector<Muscle>& muscles) {
  const TableReader table(node, muscle_keys(), label(node, "muscle"));
  for (const Side side : read_sides(table)) {
    Context here = context;
    here.side = side;
    Muscle muscle = read_muscle(table, here);
    check_new_name(table.at("name"), "muscle", muscle.name, muscles);
    if (side == Side::Mirrored) refuse_own_image(table, muscles.back().path, muscle.path);
    muscles.push_back(std::move(muscle));
  }
}

void append_ligaments(const Node& node, const Context& context, const std::vector<Muscle>& muscles,
                      std::vector<Ligament>& ligaments) {
  const TableReader table(node, ligament_keys(), label(node, "ligament"));
  for (const Side side : read_sides(table)) {
    Context here = context;
    here.side = side;
    Ligament ligament = read_ligament(table, here);
    check_new_name(table.at("name"), "ligament", ligament.name, ligaments);
    check_new_name(table.at("name"), "line (muscle or ligament)", ligament.name, muscles);
    if (side == Side::Mirrored) refuse_own_image(table, ligaments.back().path, ligament.path);
    ligaments.push_back(std::move(ligament));
  }
}

/// `depth` and `force` of a bolus.
Curve read_crushing(const TableReader& table) {
  Curve crushing;
  const Node &depth = table.at("depth"), &force = table.at("force");
  for (const Node& element : read_list(depth, "a list of lengths such as [\"0 mm\", \"2 mm\"]"))
    crushing.time.push_back(read_quantity(element, kLength, kNotNegative));
  for (const Node& element : read_list(force, "a list of forces such as [\"0 N\", \"100 N\"]"))
    crushing.value.push_back(read_quantity(element, kForce, kNotNegative));
  if (crushing.time.size() < 2 || std::adjacent_find(crushing.time.begin(), crushing.time.end(),
                                                     std::greater_equal<>()) != crushing.time.end())
    fail(depth, "expected two or more depths, each larger than the one before");
  if (crushing.value.size() != crushing.time.size())
    fail(force, fmt::format("expected as many forces as depths ({}), found {}",
                            crushing.time.size(), crushing.value.size()));
  if (crushing.time.front() != 0 || crushing.value.front() != 0)
    fail(depth, "expected to begin with no depth and no force");
  return crushing;
}

Bolus read_bolus(const TableReader& table, const Context& context) {
  Bolus bolus;
  bolus.where = table.node().where;
  bolus.name = read_name(table.at("name")) + side_suffix(table, context.side);
  bolus.path = read_path(table, context);
  if (bolus.path.size() != 2)
    fail(table.at("path"), fmt::format("{} lies between two points", table.what()));
  table.read("from", bolus.from);
  table.read("height", bolus.height);
  bolus.force = read_crushing(table);
  table.at("unloading_stiffness");
  table.read("unloading_stiffness", bolus.unloading_stiffness);
  table.read("force_kept", bolus.force_kept);
  for (const double depth : bolus.force.time)
    if (slope_at(bolus.force, depth) > bolus.unloading_stiffness * (1 + 1e-9))
      fail(table.at("unloading_stiffness"),
           fmt::format("less than the slope of `force` at a depth of {:g} mm: the bolus would give "
                       "back more than it took",
                       1e3 * depth));
  return bolus;
}

void append_boluses(const Node& node, const Context& context, const std::vector<Muscle>& muscles,
                    const std::vector<Ligament>& ligaments, std::vector<Bolus>& boluses) {
  const TableReader table(node, bolus_keys(), label(node, "bolus"));
  for (const Side side : read_sides(table)) {
    Context here = context;
    here.side = side;
    Bolus bolus = read_bolus(table, here);
    check_new_name(table.at("name"), "bolus", bolus.name, boluses);
    check_new_name(table.at("name"), "line (muscle or bolus)", bolus.name, muscles);
    check_new_name(table.at("name"), "line (ligament or bolus)", bolus.name, ligaments);
    if (side == Side::Mirrored) refuse_own_image(table, boluses.back().path, bolus.path);
    boluses.push_back(std::move(bolus));
  }
}

}  // namespace

const KeyTable& path_point_keys() {
  static const KeyTable kTable{
      "point of a path",
      {{"body", {form::Text{"name of a body"}}, kRequired, "the body that it moves with"},
       {"point", {form::Vector{kLength}}, kRequired, "where it is at the start"},
       {"radius",
        {form::Quantity{kLength, kNotNegative}},
        standard("0 m"),
        "tissue: spreads it over the surface nodes within"},
       {"beyond_mesh",
        {form::Boolean{}},
        standard(false),
        "fixed or rigid body: the point may lie farther from the mesh than a tenth of its size"}}};
  return kTable;
}

const KeyTable& muscle_keys() {
  static const KeyTable kTable = [] {
    KeyTable table{
        "[[muscle]]",
        {{"name", {form::Text{"name"}}, kRequired, "unique among muscles and ligaments"},
         {"path",
          {list_of({form::Table{path_point_keys}})},
          otherwise("or `tissue`"),
          "two or more points, from origin to insertion"},
         {"wrap", {names_of_bodies(0)}, kNone, "fixed and rigid bodies that the line goes around"},
         {"beyond",
          {form::Either{{{form::Quantity{kLength, kNotNegative}}, {form::Table{beyond_keys}}}}},
          otherwise("none"),
          "tendon past the end of the path, which counts in the muscle's length"},
         {"tissue",
          {form::Text{"name of a tissue"}},
          otherwise("or `path`"),
          "whose fibres it activates, in place of a path; takes only excitation and times"},
         {"max_force",
          {form::Quantity{kForce, kPositive}},
          otherwise("required with `path`"),
          "isometric, at full activation"},
         {"optimal_length", optimal_length_type(), otherwise("length at the start"),
          "of the whole muscle"},
         {"max_length_ratio",
          {form::Number{kMoreThanOne}},
          standard(1.3),
          "length of greatest passive force, per optimal length"},
         {"tendon_ratio",
          {form::Number{kFraction}},
          standard(0.0),
          "tendon per optimal length, below 1"}}};
    append(dynamics_keys(), table);
    table.keys.push_back(
        {"excitation", curve_or_name(), otherwise("0"), "activation that is asked for, 0 to 1"});
    table.keys.push_back(mirror_key());
    return table;
  }();
  return kTable;
}

const KeyTable& muscle_table_keys() {
  static const KeyTable kTable = [] {
    KeyTable table{
        "[[muscle_table]]",
        {{"file", {form::Text{"path"}}, kRequired, "CSV table with a row for each muscle"},
         {"place", {form::Table{place_keys}}, kNone, "moves the points"},
         {"only",
          {list_of({form::Text{"muscle or row of the table"}})},
          otherwise("all"),
          "muscles or rows of the table that are taken"},
         {"leave_out",
          {list_of({form::Text{"muscle or row of the table"}})},
          kNone,
          "muscles or rows of the table that are not taken"},
         {"bodies",
          {form::Map{"body of the table", {{form::Text{"name of a body"}}}}},
          kNone,
          "renames bodies"}}};
    append(dynamics_keys(), table);
    table.keys.push_back({"optimal_length",
                          {form::Map{"muscle or row of the table", {optimal_length_type()}}},
                          otherwise("as the table has it"),
                          "of the whole muscle, tendon and all"});
    table.keys.push_back({"excitation",
                          {form::Map{"muscle or row of the table", {curve_or_name()}}},
                          otherwise("0"),
                          "activations that are asked for, 0 to 1"});
    return table;
  }();
  return kTable;
}

const KeyTable& ligament_keys() {
  static const KeyTable kTable{
      "[[ligament]]",
      {{"name", {form::Text{"name"}}, kRequired, "unique among muscles and ligaments"},
       {"path", {list_of({form::Table{path_point_keys}})}, kRequired, "two or more points"},
       {"wrap", {names_of_bodies(0)}, kNone, "fixed and rigid bodies that the line goes around"},
       {"stiffness",
        {form::Quantity{kStiffness, kPositive}},
        otherwise("or `stiffness_per_strain`"),
        "linear"},
       {"stiffness_per_strain",
        {form::Quantity{kForce, kPositive}},
        otherwise("or `stiffness`"),
        "after Blankevoort, with a quadratic toe"},
       {"toe_strain",
        {form::Number{kPositive}},
        standard(0.03),
        "half the strain at which the toe ends"},
       {"damping",
        {form::Quantity{kDamping, kNotNegative}},
        standard("0 N s/m"),
        "while stretching; at most the elastic tension"},
       {"slack_length",
        {form::Quantity{kLength, kPositive}},
        otherwise("length at the start"),
        "length without force"},
       {"slack_extension",
        {form::Quantity{kLength, kAny}},
        kNone,
        "in its place: added to the length at the start"},
       {"reference_strain",
        {form::Number{kMoreThanMinusOne}},
        kNone,
        "in its place: length at the start / (1 + this)"},
       mirror_key()}};
  return kTable;
}

const KeyTable& bolus_keys() {
  static const KeyTable kTable{
      "[[bolus]]",
      {{"name", {form::Text{"name"}}, kRequired, "unique among muscles, ligaments and boluses"},
       {"path",
        {list_of({form::Table{path_point_keys}})},
        kRequired,
        "two points, on the upper teeth and on the lower ones"},
       {"from", {form::Quantity{kTime, kNotNegative}}, standard("0 s"), "when it is put in"},
       {"height",
        {form::Quantity{kLength, kPositive}},
        otherwise("what is between the points then"),
        "how high it is before it is crushed"},
       {"depth",
        {list_of({form::Quantity{kLength, kNotNegative}})},
        kRequired,
        "by which it is pressed together, from 0 on"},
       {"force",
        {list_of({form::Quantity{kForce, kNotNegative}})},
        kRequired,
        "as many forces, from 0 on; linear between the depths, constant beyond. Where they fall it "
        "breaks"},
       {"unloading_stiffness",
        {form::Quantity{kStiffness, kPositive}},
        kRequired,
        "by which it springs back; at least the largest slope of `force`"},
       {"force_kept",
        {form::Number{kFraction}},
        standard(1.0),
        "share of `force` that is left each time that it was crushed and let go"},
       mirror_key()}};
  return kTable;
}

std::vector<Muscle> read_muscles(const TableReader& document, const Context& context) {
  std::vector<Muscle> muscles;
  Mistakes mistakes;
  for (const Node& node : entries(document, "muscle"))
    mistakes.in([&] { append_muscles(node, context, muscles); });
  for (const Node& node : entries(document, "muscle_table"))
    mistakes.in([&] { append_table(node, context, muscles); });
  mistakes.tell();
  return muscles;
}

std::vector<Ligament> read_ligaments(const TableReader& document, const Context& context,
                                     const std::vector<Muscle>& muscles) {
  std::vector<Ligament> ligaments;
  read_each(entries(document, "ligament"),
            [&](const Node& node) { append_ligaments(node, context, muscles, ligaments); });
  return ligaments;
}

std::vector<Bolus> read_boluses(const TableReader& document, const Context& context,
                                const std::vector<Muscle>& muscles,
                                const std::vector<Ligament>& ligaments) {
  std::vector<Bolus> boluses;
  read_each(entries(document, "bolus"),
            [&](const Node& node) { append_boluses(node, context, muscles, ligaments, boluses); });
  return boluses;
}

}  // namespace articular::sim
