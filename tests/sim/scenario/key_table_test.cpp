// The tables of keys are what the reader goes by: every key of every table is read, as the table
// says.
#include "sim/scenario/key_table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "fem/material/any_material.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/toml_override.hpp"
#include "sim/scenario/toml_reader.hpp"
#include "tests/sim/support/scenario_file.hpp"

namespace articular::sim::key_table_test {

const std::string kDynamic = R"(
title = "All keys"
duration = "1 s"
analysis = "dynamic"
accuracy = "balanced"
contact_response = "averaged"
contact_stiffness_factor = 50
choice = { disc = "tissue" }
curve = { ramp = { time = ["0 s", "1 s"], value = [0, 1] } }
integrator = { step = "1 ms", scheme = "tr-bdf2", position_tolerance = "1 um", max_iterations = 9, solver = "auto" }
detection = { tree = "blocks" }
excitations = { file = "excitations.csv" }
output = { interval = "10 ms", length_unit = "mm", directory = "o", frames = true, contact_surfaces = true, checkpoint_interval = "1 s", directions = ["left", "posterior", "superior"] }
[[body]]
name = "skull"
kind = "fixed"
when = { disc = ["tissue", "none"] }
mesh = { file = "skull.vtp", unit = "cm", part = ["left", "right"], made_by = "cp a b", place = { rotation = "0 0 1 deg", about = "1 0 0 mm", translation = "0 1 0 mm", scale = 2 } }
layer = { thickness = "1 mm", young_modulus = "1 MPa", poisson_ratio = 0.3, law = "logarithmic" }
collides = true
[[body.contact_meshes]]
file = "fossa.vtp"
unit = "mm"
part = "left"
made_by = "cp a b"
place = { scale = 1 }
facing = [0, 0, 1]
box = ["-1 -1 -1 mm", "1 1 1 mm"]
faces = 100
continued = { at = "0 0 0 mm", direction = [1, 0, 0], length = "5 mm", easing = "1 mm" }
[[body]]
name = "free"
kind = "rigid"
geometry = { sphere = { radius = "5 mm", element_size = "2 mm", center = "0 0 0 mm" }, place = { scale = 2 } }
mass = "1 kg"
center_of_mass = "0 0 0 mm"
inertia = ["1 1 1 kg mm^2", "0 0 0 kg mm^2"]
velocity = "1 0 0 mm/s"
angular_velocity = "0 0 1 rad/s"
[[body]]
name = "hinge"
kind = "rigid"
geometry = { box = { size = "1 1 1 mm", cells = [1, 1, 1], center = "0 0 0 mm" } }
density = "1 g/cm^3"
hold = { freedoms = ["rotation.x", "rotation.y", "rotation.z"], at = "0 0 0 mm", turned = "0 0 1 deg" }
[[body]]
name = "hexahedron"
kind = "fixed"
geometry = { hexahedron = { corners = ["0 0 0 mm", "1 0 0 mm", "1 1 0 mm", "0 1 0 mm", "0 0 1 mm", "1 0 1 mm", "1 1 1 mm", "0 1 1 mm"], cells = [1, 1, 1] } }
[[body]]
name = "tissue"
kind = "tissue"
geometry = { v_shape = { leg_length = "5 mm", width = "1 mm", angle = "30 deg", cells = [4, 1] } }
density = "1 g/cm^3"
material = { law = "neo-hookean", young_modulus = "1 kPa", poisson_ratio = 0.3, element = "plain", mass_damping = "1 1/s", stiffness_damping = "1 ms", relaxation = [{ weight = 0.5, time = "1 s" }] }
[[attach]]
body = "tissue"
to = "skull"
mirror = "x"
region = { box = ["0 0 0 mm", "1 1 1 mm"], sphere = { center = "0 0 0 mm", radius = "1 mm" }, near = { body = "skull", distance = "1 mm" }, surface = true, set = "top" }
[[support]]
name = "roller"
body = "tissue"
region = {}
freedoms = ["translation.x"]
turned = "0 0 1 deg"
mirror = "x"
[[muscle]]
name = "line"
path = [{ body = "skull", point = "1 0 0 mm", beyond_mesh = true }, { body = "tissue", point = "0 0 9 mm", radius = "1 mm" }]
wrap = ["skull"]
beyond = { time = ["0 s", "1 s"], length = ["1 mm", "2 mm"] }
max_force = "1 N"
optimal_length = "9 mm"
max_length_ratio = 1.5
tendon_ratio = 0.2
passive_fraction = 0.02
max_velocity = "5 1/s"
force_length = true
force_length_curve = "parabola"
activation_time = "10 ms"
deactivation_time = "40 ms"
excitation = { time = ["0 s", "1 s"], value = [0, 1] }
mirror = "x"
[[muscle]]
name = "fibres"
tissue = "of muscle"
excitation = "ramp"
[[muscle_table]]
file = "muscles.csv"
place = { scale = 1 }
only = ["masseter", "geniohyoid"]
leave_out = ["geniohyoid"]
bodies = { hyoid = "skull" }
passive_fraction = 0.02
max_velocity = "5 1/s"
force_length = true
force_length_curve = "parabola"
activation_time = "10 ms"
deactivation_time = "40 ms"
optimal_length = { m1 = "8 mm" }
excitation = { masseter = { time = ["0 s"], value = [1] } }
[[sheet]]
name = "aponeurosis"
body = "tissue"
region = {}
thickness = "0.5 mm"
young_modulus = "100 MPa"
toe_strain = 0.02
fibres = { direction = [0, 0, 1] }
mirror = "x"
[[sheet]]
name = "from cells"
body = "tissue"
region = {}
thickness = "0.5 mm"
young_modulus = "100 MPa"
fibres = { array = "fibres" }
[[sheet]]
name = "between"
body = "tissue"
region = {}
thickness = "0.5 mm"
young_modulus = "100 MPa"
fibres = { from = {}, to = {} }
[[ligament]]
name = "linear"
path = [{ body = "skull", point = "1 0 0 mm" }, { body = "free", point = "0 0 9 mm" }]
wrap = ["skull"]
stiffness = "1 N/mm"
damping = "1 N s/mm"
slack_length = "8 mm"
mirror = "x"
[[ligament]]
name = "toe"
path = [{ body = "skull", point = "0 0 0 mm" }, { body = "free", point = "0 0 9 mm" }]
stiffness_per_strain = "1 N"
toe_strain = 0.04
slack_extension = "-1 mm"
[[ligament]]
name = "strained"
path = [{ body = "skull", point = "0 0 0 mm" }, { body = "free", point = "0 0 9 mm" }]
stiffness_per_strain = "1 N"
reference_strain = 0.05
[[bolus]]
name = "nut"
path = [{ body = "skull", point = "1 0 0 mm" }, { body = "free", point = "0 0 9 mm" }]
from = "0.1 s"
height = "8 mm"
depth = ["0 mm", "1 mm", "2 mm"]
force = ["0 N", "10 N", "0 N"]
unloading_stiffness = "20 N/mm"
force_kept = 0.7
mirror = "x"
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
profile = { time = ["0 s"], value = [1] }
[[load]]
kind = "force"
body = "tissue"
force = "0 0 1 N"
point = "0 0 0 mm"
radius = "1 mm"
profile = { time = ["0 s"], value = [1] }
[[load]]
kind = "force"
body = "tissue"
force = "0 0 1 N"
region = {}
[[load]]
kind = "moment"
body = "free"
moment = "0 0 5 N m"
profile = { time = ["0 s"], value = [1] }
[[load]]
kind = "pressure"
body = "tissue"
region = {}
pressure = "1 kPa"
profile = { time = ["0 s"], value = [1] }
[[load]]
kind = "traction"
body = "tissue"
region = {}
traction = "0 0 1 kPa"
profile = { time = ["0 s"], value = [1] }
[[load]]
kind = "motion"
body = "skull"
time = ["0 s", "1 s", "2 s"]
translation = ["0 0 0 mm", "0 0 1 mm", "0 0 0 mm"]
rotation = ["0 0 0 deg", "0 0 1 deg", "0 0 0 deg"]
about = "0 0 0 mm"
interpolation = "spline"
ends = "rest"
[[load]]
kind = "motion"
body = "hexahedron"
file = "motion.csv"
[[load]]
kind = "motion"
support = "roller_left"
time = ["0 s", "1 s"]
translation = ["0 0 0 mm", "1 0 0 mm"]
[[contact]]
bodies = ["tissue", "free"]
friction = 0.3
slip_velocity = "1 mm/s"
damping = "1 Pa s/m"
[[contact]]
self = "tissue"
[[probe]]
name = "point"
kind = "point"
body = "free"
point = "0 0 0 mm"
frame = "skull"
mirror = "x"
[[probe]]
name = "way"
kind = "way"
body = "free"
point = "0 0 0 mm"
frame = "skull"
mirror = "x"
[[probe]]
name = "helical_axis"
kind = "helical_axis"
body = "free"
point = "0 0 0 mm"
frame = "skull"
[[probe]]
name = "angle"
kind = "angle"
body = "free"
axis = [0, 0, 1]
mirror = "x"
[[probe]]
name = "contact"
kind = "contact"
bodies = ["tissue", "free"]
region = {}
spot = "4 mm"
threshold = "0.1 MPa"
mirror = "x"
[[probe]]
name = "contacts"
kind = "contacts"
of = ["contact_left"]
spot = "4 mm"
threshold = "0.1 MPa"
mirror = "x"
[[probe]]
name = "line"
kind = "line"
line = "toe"
mirror = "x"
[[probe]]
name = "arm"
kind = "moment_arm"
line = "toe"
body = "free"
point = "0 0 0 mm"
axis = [0, 0, 1]
[[probe]]
name = "net"
kind = "muscle_moment"
muscles = ["*"]
body = "free"
point = "0 0 0 mm"
axis = [0, 0, 1]
[[probe]]
name = "wrap"
kind = "wrap"
line = "linear_left"
mirror = "x"
[[probe]]
name = "energy"
kind = "energy"
mirror = "x"
[[probe]]
name = "body"
kind = "reaction"
body = "skull"
mirror = "x"
[[probe]]
name = "support"
kind = "reaction"
support = "roller_left"
[[probe]]
name = "attachment"
kind = "attachment"
bodies = ["tissue", "skull"]
mirror = "x"
[[probe]]
name = "volume"
kind = "volume"
body = "of transversely-isotropic"
mirror = "x"
[[probe]]
name = "fibres"
kind = "fibres"
body = "of transversely-isotropic"
mirror = "x"
[[probe]]
name = "sheet"
kind = "sheet"
sheet = "aponeurosis_left"
mirror = "x"
[[probe]]
name = "stress"
kind = "stress"
body = "tissue"
region = {}
mirror = "x"
[[probe]]
name = "extent"
kind = "extent"
body = "tissue"
frame = "skull"
point = "0 0 0 mm"
direction = [1, 0, 0]
[[probe]]
name = "share"
kind = "share"
part = ["body_left"]
whole = ["attachment_left"]
direction = [0, 0, 1]
mirror = "x"
[[probe]]
name = "joint"
kind = "joint"
proximal = { body = "skull", point = "0 0 0 mm", lateral = [1, 0, 0], up = [0, 0, 1] }
distal = { body = "free", point = "0 0 0 mm", lateral = [1, 0, 0], up = [0, 0, 1] }
side = "left"
)";

/// A tissue of each law, with all its constants.
std::string tissues() {
  const std::string E = R"(young_modulus = "1 kPa", poisson_ratio = 0.3)",
                    kappa = R"(bulk_modulus = "10 kPa", volumetric = "quadratic")",
                    damping = R"(element = "plain", mass_damping = "1 1/s", )"
                              R"(stiffness_damping = "1 ms")",
                    relaxation = R"(, relaxation = [{ weight = 0.5, time = "1 s" }])";
  const std::pair<std::string, std::string> laws[] = {
      {"linear", E},
      {"corotated", E + relaxation},
      {"st-venant-kirchhoff", E + relaxation},
      {"neo-hookean", E + relaxation},
      {"coupled-neo-hookean", E + relaxation},
      {"holmes-mow", E + ", beta = 1" + relaxation},
      {"isochoric-neo-hookean", E + R"(, volumetric = "quadratic")" + relaxation},
      {"mooney-rivlin", R"(c10 = "1 kPa", c01 = "1 kPa", )" + kappa + relaxation},
      {"yeoh", R"(c10 = "1 kPa", c20 = "1 kPa", )" + kappa + relaxation},
      {"ogden", R"(terms = [{ c = "1 kPa", m = 2 }], )" + kappa + relaxation},
      {"veronda-westmann", R"(c1 = "1 kPa", c2 = 1, )" + kappa + relaxation},
      {"transversely-isotropic",
       R"(c10 = "1 kPa", c01 = "1 kPa", c3 = "1 kPa", c4 = 10, c5 = "1 kPa", toe_end = 1.1, prestretch = 1.03, )"
       R"(active_stress = "1 kPa", force_length = { sarcomere_length = "1.8 um", )"
       R"(zero_length = "1.5 um", b = "4 1/um", calcium = 4, max_calcium = 5 }, )"
       R"(fibres = { from = {}, to = {} }, )" +
           kappa + relaxation},
      {"muscle",
       R"(max_stress = "1 kPa", p1 = 0.1, p2 = 5, toe_end = 1.3, optimal_stretch = 1.1, )"
       R"(tendon_ratio = 0.4, max_velocity = "8 1/s", descending_limb = false, active_c10 = "1 kPa", shear_along = "1 kPa", shear_across = "1 kPa", c10 = "1 kPa", )"
       R"(fibres = { direction = [0, 0, 1] }, )" +
           kappa + relaxation}};
  std::string text;
  for (const auto& [law, constants] : laws)
    text += fmt::format(
        "[[body]]\nname = \"of {0}\"\nkind = \"tissue\"\ndensity = \"1 g/cm^3\"\n"
        "geometry = {{ box = {{ size = \"1 1 1 mm\", cells = [1, 1, 1] }} }}\n"
        "material = {{ law = \"{0}\", {1}, {2} }}\n",
        law, constants, damping);
  return text;
}

const std::string kOtherKeys = R"(
duration = "1 s"
integrator = { element_tolerance = 1e-3 }
contact = false
[[body]]
name = "muscle"
kind = "tissue"
mesh = { file = "muscle.vtu" }
density = "1 g/cm^3"
material = { law = "muscle", fibres = { array = "fibres", density = "conserved" } }
)";

/// A value of an example, and what a table says of it.
struct Place {
  std::string path;   // for an override
  std::string entry;  // "[[load]] gravity.profile"
  KeyType type;
  Absence absence;
};

/// Follows tables and the values of a file together.
class Walk {
 public:
  std::vector<Place> places;

  void table(const Node& node, const KeyTable& keys, const std::string& name,
             const std::string& path) {
    for (const Member& member : node.table()->members) {
      const Key* key = keys.find(member.key);
      if (key == nullptr) continue;  // `when`
      const std::string here = path.empty() ? member.key : path + "." + member.key;
      places.push_back({here, name + "." + member.key, key->type, key->absence});
      value(member.node, key->type, name + "." + member.key, here);
    }
  }

 private:
  void value(const Node& node, const KeyType& type, const std::string& entry,
             const std::string& path) {
    if (const auto* inner = std::get_if<form::Table>(&type.variant))
      table(node, inner->keys(), std::string(inner->keys().name), path);
    if (const auto* inner = std::get_if<form::VariantTable>(&type.variant))
      variant_table(node, inner->variants(), path);
    if (const auto* list = std::get_if<form::List>(&type.variant))
      for (std::size_t i = 0; node.list() != nullptr && i < node.list()->size(); ++i)
        element((*node.list())[i], list->of.front(), entry, fmt::format("{}.{}", path, i));
    if (const auto* map = std::get_if<form::Map>(&type.variant))
      for (const Member& member : node.table()->members)
        element(member.node, map->of.front(), entry, fmt::format("{}.\"{}\"", path, member.key));
    if (const auto* either = std::get_if<form::Either>(&type.variant))
      for (const KeyType& one : either->of)
        if (fits(node, one)) value(node, one, entry, path);
  }

  static bool fits(const Node& node, const KeyType& type) {
    return node.list() != nullptr    ? std::holds_alternative<form::List>(type.variant)
           : node.table() != nullptr ? std::holds_alternative<form::Table>(type.variant)
                                     : false;
  }

  void element(const Node& node, const KeyType& type, const std::string& entry,
               const std::string& path) {
    places.push_back({path, entry + "[]", type, kNone});
    value(node, type, entry, path);
  }

  void variant_table(const Node& node, const form::Variants& variants, const std::string& path) {
    const std::string word = *node.find(variants.tag)->text();
    for (const auto& [candidate, keys] : variants.by_word)
      if (candidate == word) table(node, keys(), fmt::format("{} {}", variants.name, word), path);
  }
};

/// "[[load]] gravity.profile" of all keys that can be reached from a table.
class AllKeys {
 public:
  std::set<std::string> entries;

  void add(const KeyTable& keys, const std::string& name) {
    if (!seen_.insert(name).second) return;
    for (const Key& key : keys.keys) {
      entries.insert(name + "." + std::string(key.name));
      add(key.type);
    }
  }

 private:
  void add(const KeyType& type) {
    if (const auto* inner = std::get_if<form::Table>(&type.variant))
      add(inner->keys(), std::string(inner->keys().name));
    if (const auto* inner = std::get_if<form::VariantTable>(&type.variant))
      for (const auto& [word, keys] : inner->variants().by_word)
        add(keys(), fmt::format("{} {}", inner->variants().name, word));
    if (const auto* list = std::get_if<form::List>(&type.variant)) add(list->of.front());
    if (const auto* map = std::get_if<form::Map>(&type.variant)) add(map->of.front());
    if (const auto* either = std::get_if<form::Either>(&type.variant))
      for (const KeyType& one : either->of) add(one);
  }

  std::set<std::string> seen_;
};

class KeyTables : public ScenarioTest {
 protected:
  KeyTables() {
    write("muscles.csv",
          "id,muscle,body_upper,ux_mm,uy_mm,uz_mm,body_lower,lx_mm,ly_mm,lz_mm,max_force_N,"
          "max_over_opt_length,tendon_ratio\nm1,masseter,hyoid,0,0,0,free,0,0,9,1,1.3,0\n"
          "m2,geniohyoid,hyoid,0,0,0,free,0,0,9,1,1.3,0\n");
    write("excitations.csv", "time [s],line_left\n0,0\n");
    write("motion.csv", "time [s],translation.x [mm]\n0,0\n1,1\n2,2\n");
  }

  std::vector<Place> places_in(const std::string& text) const {
    Walk walk;
    walk.table(read_toml(write("walk.toml", text)), scenario_keys(), "scenario", "");
    return walk.places;
  }

  /// What the reader says of a value in place of the example's; "" if it has nothing against it.
  std::string refusal_of(const std::string& text, const Place& place, const std::string& value) {
    const std::string override_text = place.path + "=" + value;
    const std::string message = refusal(text, {override_text});
    const std::size_t at = message.find("--set " + override_text + ": ");
    return at == std::string::npos ? "" : message.substr(at);
  }

  const std::vector<std::string> examples_ = {kDynamic + tissues(), kOtherKeys};
};

/// A value in SI with a unit of the kind, "-1 kg^1 m^-1 s^-2".
std::string si_text(double value, const Dimension& dimension) {
  std::string text = fmt::format("{}", value);
  const std::pair<const char*, int> factors[] = {{"kg", dimension.mass},
                                                 {"m", dimension.length},
                                                 {"s", dimension.time},
                                                 {"rad", dimension.angle}};
  for (const auto& [symbol, power] : factors)
    if (power != 0) text += fmt::format(" {}^{}", symbol, power);
  return text;
}

/// Numbers that are just not in the range.
std::vector<double> numbers_outside(const Range& range) {
  std::vector<double> numbers;
  if (std::isfinite(range.min)) numbers.push_back(range.excludes_ends ? range.min : range.min - 1);
  if (std::isfinite(range.max)) numbers.push_back(range.excludes_ends ? range.max : range.max + 1);
  return numbers;
}

/// Values of a type that its range leaves out, each with what the message says of it.
std::vector<std::pair<std::string, std::string>> refused_values(const KeyType& type) {
  std::vector<std::pair<std::string, std::string>> values;
  if (const auto* number = std::get_if<form::Number>(&type.variant)) {
    for (const double value : numbers_outside(number->range))
      values.emplace_back(fmt::format("{}", value), number->range.rule);
  } else if (const auto* quantity = std::get_if<form::Quantity>(&type.variant)) {
    for (const double value : numbers_outside(quantity->range))
      values.emplace_back(si_text(value, quantity->kind.dimension), quantity->range.rule);
  } else if (const auto* integer = std::get_if<form::Integer>(&type.variant)) {
    for (const int value : {integer->min - 1, integer->max + 1})
      values.emplace_back(std::to_string(value),
                          fmt::format("from {} to {}", integer->min, integer->max));
  }
  return values;
}

/// A default as the file would have it; "" if there is none.
std::string text_of(const Absence& absence) {
  if (const auto* number = std::get_if<double>(&absence.value)) return fmt::format("{}", *number);
  if (const auto* is_so = std::get_if<bool>(&absence.value)) return *is_so ? "true" : "false";
  const auto* text = std::get_if<std::string_view>(&absence.value);
  return text != nullptr ? std::string(*text) : "";
}

TEST_F(KeyTables, ExamplesAreValidAndHaveEveryKey) {
  std::set<std::string> shown;
  for (const std::string& text : examples_) {
    EXPECT_EQ(refusal(text), "");
    for (const Place& place : places_in(text)) shown.insert(place.entry);
  }
  AllKeys all;
  all.add(scenario_keys(), "scenario");
  for (const std::string& entry : all.entries)
    EXPECT_TRUE(shown.contains(entry)) << "no example has " << entry;
}

// A date is nothing that any key takes: where it is accepted, the key is not read.
TEST_F(KeyTables, EveryKeyIsRead) {
  for (const std::string& text : examples_)
    for (const Place& place : places_in(text))
      EXPECT_NE(refusal_of(text, place, "2020-01-01").find("found a date"), std::string::npos)
          << place.entry << ": " << refusal(text, {place.path + "=2020-01-01"});
}

TEST_F(KeyTables, NumbersOutsideTheRangesAreRefused) {
  for (const std::string& text : examples_)
    for (const Place& place : places_in(text))
      for (const auto& [value, rule] : refused_values(place.type)) {
        const std::string message = refusal_of(text, place, value);
        EXPECT_NE(message.find(rule), std::string::npos) << place.path << "=" << value;
      }
}

TEST_F(KeyTables, UnitsAreThoseOfTheTables) {
  for (const std::string& text : examples_)
    for (const Place& place : places_in(text)) {
      std::string_view example;
      if (const auto* quantity = std::get_if<form::Quantity>(&place.type.variant))
        example = quantity->kind.example;
      if (const auto* vector = std::get_if<form::Vector>(&place.type.variant))
        example = vector->kind.vector_example;
      if (example.empty()) continue;
      EXPECT_NE(refusal_of(text, place, "1").find(example), std::string::npos) << place.path;
    }
}

TEST_F(KeyTables, WordsAreThoseOfTheTables) {
  for (const std::string& text : examples_)
    for (const Place& place : places_in(text)) {
      const auto* choice = std::get_if<form::Choice>(&place.type.variant);
      if (choice == nullptr) continue;
      const std::string message = refusal_of(text, place, "zzz");
      for (const Word& word : choice->words) {
        EXPECT_NE(message.find(fmt::format("\"{}\"", word.text)), std::string::npos)
            << place.path << ": " << message;
        EXPECT_EQ(refusal_of(text, place, std::string(word.text)).find("expected one of"),
                  std::string::npos)
            << place.path << "=" << word.text;
      }
    }
}

TEST_F(KeyTables, DefaultsAreValuesThatTheKeyTakes) {
  for (const std::string& text : examples_)
    for (const Place& place : places_in(text)) {
      const std::string value = text_of(place.absence);
      if (value.empty()) continue;
      EXPECT_EQ(refusal_of(text, place, value), "") << place.path << "=" << value;
    }
}

// Scenes that are made without a file start from these.
TEST_F(KeyTables, DefaultsAreThoseOfThePlainData) {
  const Scenario scenario = read(kOtherKeys + R"(
[[body]]
name = "bone"
kind = "fixed"
mesh = { file = "bone.vtp" }
[[muscle]]
name = "line"
path = [{ body = "bone", point = "0 0 0 mm" }, { body = "muscle", point = "0 0 9 mm" }]
max_force = "1 N"
[[ligament]]
name = "toe"
path = [{ body = "bone", point = "0 0 0 mm" }, { body = "muscle", point = "0 0 9 mm" }]
stiffness_per_strain = "1 N"
[[probe]]
name = "angle"
kind = "contact"
bodies = ["bone", "muscle"]
)");
  const Muscle muscle;
  EXPECT_EQ(scenario.muscles[0].max_length_ratio, muscle.max_length_ratio);
  EXPECT_EQ(scenario.muscles[0].tendon_ratio, muscle.tendon_ratio);
  EXPECT_EQ(scenario.muscles[0].passive_fraction, muscle.passive_fraction);
  EXPECT_EQ(scenario.muscles[0].max_velocity, muscle.max_velocity);
  EXPECT_EQ(scenario.muscles[0].force_length, muscle.force_length);
  EXPECT_EQ(scenario.muscles[0].force_length_curve, muscle.force_length_curve);
  EXPECT_EQ(scenario.muscles[0].activation_time, muscle.activation_time);
  EXPECT_EQ(scenario.muscles[0].deactivation_time, muscle.deactivation_time);
  EXPECT_EQ(scenario.ligaments[0].toe_strain, Ligament().toe_strain);
  EXPECT_EQ(scenario.ligaments[0].damping, Ligament().damping);
  EXPECT_EQ(scenario.integrator.max_iterations, Integrator().max_iterations);
  EXPECT_EQ(scenario.integrator.solver, Integrator().solver);
  EXPECT_EQ(scenario.output.length_unit.metres, LengthUnit().metres);
  EXPECT_EQ(scenario.output.contact_surfaces, Output().contact_surfaces);
  EXPECT_EQ(scenario.accuracy, Scenario().accuracy);
  const TissueMaterial& material = *scenario.bodies[0].material;
  EXPECT_EQ(material.element, TissueMaterial().element);
  EXPECT_EQ(material.mass_damping, 0);
  EXPECT_EQ(std::get<MeshFile>(scenario.bodies[1].geometry).unit, MeshFile().unit);
}

/// The default of a number or quantity of a table, in SI.
double standard_of(const KeyTable& keys, std::string_view key) {
  const Key& row = *keys.find(key);
  if (const auto* number = std::get_if<double>(&row.absence.value)) return *number;
  return parse_quantity(std::get<std::string_view>(row.absence.value),
                        std::get<form::Quantity>(row.type.variant).kind);
}

const KeyTable& keys_of_law(std::string_view law) {
  for (const auto& [word, keys] : material_variants().by_word)
    if (word == law) return keys();
  throw std::invalid_argument("no such law");
}

TEST_F(KeyTables, DefaultsOfLawsAreThePublishedConstants) {
  const KeyTable& muscle = keys_of_law("muscle");
  const fem::MuscleFibre::Constants fibre;
  EXPECT_EQ(standard_of(muscle, "max_stress"), fibre.max_stress);
  EXPECT_EQ(standard_of(muscle, "p1"), fibre.p1);
  EXPECT_EQ(standard_of(muscle, "p2"), fibre.p2);
  EXPECT_EQ(standard_of(muscle, "toe_end"), fibre.toe_end);
  EXPECT_EQ(standard_of(muscle, "optimal_stretch"), fibre.optimal_stretch);
  EXPECT_EQ(standard_of(muscle, "tendon_ratio"), fibre.tendon_ratio);
  const fem::BlemkerMuscle<fem::LogVolumeChange>::Constants ground;
  EXPECT_EQ(standard_of(muscle, "shear_along"), ground.G1);
  EXPECT_EQ(standard_of(muscle, "shear_across"), ground.G2);
  EXPECT_EQ(standard_of(muscle, "c10"), ground.c10);
  EXPECT_EQ(standard_of(muscle, "active_c10"), ground.active_c10);
  EXPECT_EQ(standard_of(muscle, "bulk_modulus"), ground.kappa);
  const auto& length = std::get<form::Table>(
      keys_of_law("transversely-isotropic").find("force_length")->type.variant);
  const fem::ForceLength::Constants published;
  EXPECT_EQ(standard_of(length.keys(), "sarcomere_length"), published.sarcomere_length);
  EXPECT_EQ(standard_of(length.keys(), "zero_length"), published.zero_length);
  EXPECT_EQ(standard_of(length.keys(), "b"), published.b);
  EXPECT_EQ(standard_of(length.keys(), "calcium"), published.calcium);
  EXPECT_EQ(standard_of(length.keys(), "max_calcium"), published.max_calcium);
}

TEST_F(KeyTables, ADefaultIsWhatIsReadWhereTheKeyIsNotGiven) {
  static const KeyTable kKeys{
      "t",
      {{"length", {form::Quantity{kLength, kPositive}}, standard("2 mm"), ""},
       {"axis", {form::Direction{}}, standard({0, 2, 0}), ""},
       {"count", {form::Integer{1, 9}}, standard(4.0), ""},
       {"word", {form::Text{"text"}}, kNone, ""},
       {"needed", {form::Boolean{}}, kRequired, ""}}};
  const Node node = read_toml(write("t.toml", "count = 5\n"));
  const TableReader table(node, kKeys, "t");
  EXPECT_EQ(table.get<double>("length"), 2e-3);
  EXPECT_EQ(table.get<Vec3>("axis"), Vec3(0, 1, 0));
  EXPECT_EQ(table.get<int>("count"), 5);
  EXPECT_EQ(table.get<std::optional<std::string>>("word"), std::nullopt);
  EXPECT_THROW((void)table.get<bool>("needed"), InputError);
}

TEST_F(KeyTables, AKeyThatNoTableHasOrOfAnotherTypeIsABug) {
  const Node node = read_toml(write("t.toml", "interval = \"1 s\"\n"));
  const TableReader table(node, output_keys(), "t");
  EXPECT_THROW((void)table.find("intervall"), std::logic_error);
  EXPECT_THROW((void)table.get<std::string>("interval"), std::logic_error);
}

TEST_F(KeyTables, EntriesThatMayHaveWhenAreThoseThatChoicesGoBy) {
  std::set<std::string_view> with_when;
  const auto look_at = [&](std::string_view key, const KeyType& type) {
    if (const auto* list = std::get_if<form::List>(&type.variant))
      if (list->have_when) with_when.insert(key);
  };
  for (const Key& key : scenario_keys().keys) {
    look_at(key.name, key.type);
    if (const auto* either = std::get_if<form::Either>(&key.type.variant))
      for (const KeyType& type : either->of) look_at(key.name, type);
  }
  EXPECT_EQ(with_when, std::set<std::string_view>(kEntryLists.begin(), kEntryLists.end()));
}

}  // namespace articular::sim::key_table_test
