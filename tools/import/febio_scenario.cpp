#include "tools/import/febio_scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/mesh/febio_mesh.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/mesh_sets.hpp"
#include "sim/scenario/curve.hpp"
#include "tools/import/febio_bodies.hpp"
#include "tools/import/febio_material.hpp"
#include "tools/import/toml_entry.hpp"

namespace articular::tools {
namespace {

constexpr const char* kFreedomWords[] = {"translation.x", "translation.y", "translation.z",
                                         "rotation.x",    "rotation.y",    "rotation.z"};

/// What moves along or about each axis; none: it is held.
using Drive = std::array<std::optional<FebioValue>, 6>;

bool is_same(const std::optional<FebioValue>& a, const std::optional<FebioValue>& b) {
  if (!a || !b) return !a && !b;
  return a->value == b->value && a->curve == b->curve;
}

class ScenarioWriter {
 public:
  ScenarioWriter(std::string file, const FebioModel& model, const sim::MeshData& mesh,
                 const UnitSystem& units, std::string mesh_file)
      : file_(std::move(file)),
        model_(model),
        mesh_(mesh),
        units_(units),
        mesh_file_(std::move(mesh_file)),
        losses_(model.losses) {}

  ImportedScenario write() {
    std::vector<ImportedBody> bodies = bodies_of(model_, mesh_, losses_);
    for (ImportedBody& body : bodies)
      if (add_body(body)) bodies_.push_back(std::move(body));
    if (bodies_.empty())
      throw sim::InputError({file_}, "nothing can be taken over: " + first_losses());
    attached_.resize(static_cast<std::size_t>(mesh_.X.cols()));
    add_attachments();
    add_node_conditions();
    add_loads();
    add_contacts();
    std::stable_sort(losses_.begin(), losses_.end(),
                     [](const Loss& a, const Loss& b) { return a.line < b.line; });
    return {head() + curves() + text_ + probes_, std::move(losses_)};
  }

 private:
  void lose(int line, std::string what) { losses_.push_back({line, std::move(what)}); }

  std::string first_losses() const {
    std::string text;
    for (const Loss& loss : losses_)
      text += fmt::format("{}line {}: {}", text.empty() ? "" : "; ", loss.line, loss.what);
    return text.empty() ? "the model has no part with a material" : text;
  }

  std::string head() const {
    const double duration = model_.step * model_.num_steps;
    std::string text =
        fmt::format("title = {}\nduration = {}\nanalysis = \"{}\"\n", toml_text(model_.title),
                    toml_quantity(duration, "s"), model_.is_dynamic ? "dynamic" : "static");
    if (model_.contacts.empty() || !has_contact_) text += "contact = false\n";
    return text + fmt::format("\n[integrator]\nstep = {0}\n\n[output]\ninterval = {0}\n",
                              toml_quantity(model_.step, "s"));
  }

  static std::string curve_name(const std::string& id) { return "lc" + scenario_name(id); }

  std::string curves() const {
    std::string text;
    for (const auto& [id, curve] : model_.curves) {
      if (!used_curves_.contains(id)) continue;
      std::string times, values;
      for (std::size_t k = 0; k < curve.time.size(); ++k) {
        times += fmt::format("{}{}", k == 0 ? "" : ", ", toml_quantity(curve.time[k], "s"));
        values += fmt::format("{}{}", k == 0 ? "" : ", ", curve.value[k]);
      }
      text += fmt::format("\n[curve.{}]\ntime = [{}]\nvalue = [{}]\n", toml_text(curve_name(id)),
                          times, values);
    }
    return text;
  }

  /// @return whether the scenario has it
  bool add_body(const ImportedBody& body) {
    std::string parts;
    for (const std::string& part : body.parts)
      parts += (parts.empty() ? "" : ", ") + toml_text(part);
    const std::string mesh = fmt::format("{{ file = {}, unit = \"{}\", part = [{}] }}",
                                         toml_text(mesh_file_), units_.length, parts);
    return body.is_rigid() ? add_rigid_body(body, mesh) : add_tissue(body, mesh);
  }

  std::string fibre_array() const {
    for (const auto& [name, values] : mesh_.cell_vectors)
      if (name == "fiber" || name == "mat_axis" || mesh_.cell_vectors.size() == 1) return name;
    return {};
  }

  bool add_tissue(const ImportedBody& body, const std::string& mesh) {
    const std::optional<MaterialText> material =
        material_text(*body.material, units_, fibre_array(), model_.is_dynamic, losses_);
    if (!material) return false;
    text_ += TomlEntry("[[body]]")
                 .add("name", toml_text(body.name))
                 .add("kind", "\"tissue\"")
                 .add("mesh", mesh)
                 .add("density", material->density)
                 .add("material", material->table)
                 .text();
    if (material->activation) {
      TomlEntry muscle("[[muscle]]");
      muscle.add("name", toml_text(body.name + " fibres")).add("tissue", toml_text(body.name));
      muscle.add("excitation", excitation(*material->activation, body.material->element->line));
      text_ += muscle.text();
    }
    return true;
  }

  std::string excitation(const FebioValue& value, int line) {
    sim::Curve curve{{0}, {1}};
    if (!value.curve.empty()) {
      const auto given = model_.curves.find(value.curve);
      if (given == model_.curves.end())
        throw sim::InputError({file_, line},
                              fmt::format("there is no load curve {} that can be taken over",
                                          sim::in_ticks(value.curve)));
      curve = given->second;
    }
    std::string times, values;
    for (std::size_t k = 0; k < curve.time.size(); ++k) {
      times += fmt::format("{}{}", k == 0 ? "" : ", ", toml_quantity(curve.time[k], "s"));
      values += fmt::format("{}{}", k == 0 ? "" : ", ", value.value * curve.value[k]);
    }
    return fmt::format("{{ time = [{}], value = [{}] }}", times, values);
  }

  const FebioMaterial* material_of(const std::string& id_or_name) const {
    return find_material(model_, id_or_name);
  }

  Eigen::Vector3d center_of_mass(const ImportedBody& body) const {
    const sim::XmlElement* const given = body.material->element->child("center_of_mass");
    return given != nullptr ? sim::febio_vector({file_, given->line}, given->text)
                            : center_of(body, mesh_);
  }

  /// FEBio's default is 1.
  double density_of(const ImportedBody& body) const {
    const sim::XmlElement* const given = body.material->element->child("density");
    if (given == nullptr) return 1;
    const std::optional<double> density = sim::parse_number(given->text);
    if (!density) throw sim::InputError({file_, given->line}, "<density> is no number");
    return *density;
  }

  /// A rigid body of which all freedoms are held or moved is fixed here, and may be driven.
  bool add_rigid_body(const ImportedBody& body, const std::string& mesh) {
    Drive drive;
    std::array<bool, 6> held{};
    for (const FebioRigidCondition& condition : model_.rigid_conditions) {
      if (material_of(condition.material) != body.material) continue;
      held[static_cast<std::size_t>(condition.freedom)] = true;
      drive[static_cast<std::size_t>(condition.freedom)] = condition.prescribed;
    }
    if (std::count(held.begin() + 3, held.end(), true) == 1) {
      lose(body.material->element->line,
           fmt::format("the one rotation of {} that is held: one alone can't be, and it is free",
                       sim::in_ticks(body.name)));
      for (std::size_t i = 3; i < 6; ++i) held[i] = false;
      for (std::size_t i = 3; i < 6; ++i) drive[i].reset();
    }
    const bool is_fixed = std::all_of(held.begin(), held.end(), [](bool is) { return is; });
    const Eigen::Vector3d center = center_of_mass(body);
    TomlEntry entry("[[body]]");
    entry.add("name", toml_text(body.name)).add("kind", is_fixed ? "\"fixed\"" : "\"rigid\"");
    entry.add("mesh", mesh);
    if (!is_fixed) {
      entry.add("density", toml_quantity(density_of(body), units_.density()));
      entry.add("center_of_mass", toml_vector(center, units_.length));
      std::string freedoms;
      for (std::size_t i = 0; i < 6; ++i)
        if (held[i])
          freedoms += fmt::format("{}\"{}\"", freedoms.empty() ? "" : ", ", kFreedomWords[i]);
      if (!freedoms.empty())
        entry.add("hold", fmt::format("{{ freedoms = [{}], at = {} }}", freedoms,
                                      toml_vector(center, units_.length)));
    }
    text_ += entry.text();
    add_motion({"body", body.name, is_fixed ? std::optional(center) : std::nullopt, !is_fixed,
                body.material->element->line},
               drive);
    for (const FebioRigidForce& force : model_.rigid_forces)
      if (material_of(force.material) == body.material)
        add_rigid_force(body, center, is_fixed, force);
    return true;
  }

  void add_rigid_force(const ImportedBody& body, const Eigen::Vector3d& center, bool is_fixed,
                       const FebioRigidForce& force) {
    if (is_fixed) return;  // it moves nothing
    TomlEntry entry("[[load]]");
    entry.add("kind", "\"force\"").add("body", toml_text(body.name));
    entry.add("force",
              toml_vector(force.force.value * Eigen::Vector3d::Unit(force.axis), units_.force));
    entry.add("point", toml_vector(center, units_.length));
    add_profile(force.force, entry);
    text_ += entry.text();
  }

  void add_profile(const FebioValue& value, TomlEntry& entry) {
    if (value.curve.empty()) return;
    used_curves_.insert(value.curve);
    entry.add("profile", toml_text(curve_name(value.curve)));
  }

  /// Times of all curves of a drive. What has no curve is reached in the first step.
  std::set<double> times_of(const Drive& drive) const {
    std::set<double> times = {0};
    for (const std::optional<FebioValue>& value : drive) {
      if (!value) continue;
      if (value->curve.empty()) {
        times.insert(model_.step);
        continue;
      }
      const sim::Curve& curve = model_.curves.at(value->curve);
      for (const double t : curve.time)
        if (t > 0) times.insert(t);
    }
    if (times.size() == 1) times.insert(model_.step);
    return times;
  }

  double value_of(const std::optional<FebioValue>& value, double t) const {
    if (!value) return 0;
    if (value->curve.empty()) return t > 0 ? value->value : 0;
    return value->value * sim::value_at(model_.curves.at(value->curve), t);
  }

  /// What a motion moves: a body or a support.
  struct Moved {
    std::string_view kind;
    std::string name;
    std::optional<Eigen::Vector3d> about;  // a fixed body turns about it
    bool has_mass = false;                 // in time that can't follow a velocity that jumps
    int line = 0;                          // in the model
  };

  void add_motion(const Moved& moved, const Drive& drive) {
    const auto moves = [&](std::size_t first) {
      return std::any_of(drive.begin() + first, drive.begin() + first + 3,
                         [](const auto& value) { return value && value->value != 0; });
    };
    if (!moves(0) && !moves(3)) return;
    std::string times, ways, turns;
    for (const double t : times_of(drive)) {
      const auto at = [&](std::size_t first) {
        return Eigen::Vector3d(value_of(drive[first], t), value_of(drive[first + 1], t),
                               value_of(drive[first + 2], t));
      };
      const char* const comma = times.empty() ? "" : ", ";
      times += comma + toml_quantity(t, "s");
      ways += comma + toml_vector(at(0), units_.length);
      turns += comma + toml_vector(at(3), "rad");
    }
    TomlEntry entry("[[load]]");
    entry.add("kind", "\"motion\"").add(moved.kind, toml_text(moved.name));
    entry.add("time", "[" + times + "]");
    if (moves(0)) entry.add("translation", "[" + ways + "]");
    if (moves(3)) entry.add("rotation", "[" + turns + "]");
    if (moves(3) && moved.about) entry.add("about", toml_vector(*moved.about, units_.length));
    if (!moved.has_mass || !model_.is_dynamic)
      entry.add("interpolation", "\"linear\"");
    else
      lose(moved.line, fmt::format("the constant velocities of the motion of {}: it goes smoothly "
                                   "from point to point",
                                   sim::in_ticks(moved.name)));
    text_ += entry.text();
  }

  const sim::MeshSet* set_called(const std::string& name, int line) {
    const sim::MeshSet* const set = sim::find_set(mesh_, name);
    if (set == nullptr)
      throw sim::InputError({file_, line}, fmt::format("there is no set {}{}", sim::in_ticks(name),
                                                       sim::known_sets(mesh_)));
    return set;
  }

  void attach(const ImportedBody& tissue, const std::string& to, const sim::MeshSet& set) {
    for (const int node : set.nodes) attached_[static_cast<std::size_t>(node)] = 1;
    text_ += TomlEntry("[[attach]]")
                 .add("body", toml_text(tissue.name))
                 .add("to", toml_text(to))
                 .add("region", fmt::format("{{ set = {} }}", toml_text(set.name)))
                 .text();
  }

  /// Nodes that a tissue shares with a rigid body, and those that are said to go with it.
  void add_attachments() {
    for (const ImportedBody& rigid : bodies_) {
      if (!rigid.is_rigid()) continue;
      std::vector<const sim::MeshSet*> sets;
      for (const std::string& part : rigid.parts) sets.push_back(sim::find_set(mesh_, part));
      for (const FebioRigidNodes& nodes : model_.rigid_nodes)
        if (material_of(nodes.material) == rigid.material)
          sets.push_back(set_called(nodes.set, nodes.line));
      for (const ImportedBody& tissue : bodies_)
        for (const sim::MeshSet* const set : sets)
          if (!tissue.is_rigid() && has_any(tissue, *set)) attach(tissue, rigid.name, *set);
    }
    for (const FebioRigidNodes& nodes : model_.rigid_nodes)
      if (material_of(nodes.material) == nullptr)
        lose(nodes.line, fmt::format("nodes of {} that go with a rigid body that is not there",
                                     sim::in_ticks(nodes.set)));
  }

  /// Which condition each node has along each axis: the last one that names it.
  void add_node_conditions() {
    const auto& conditions = model_.node_conditions;
    condition_of_.assign(static_cast<std::size_t>(mesh_.X.cols()), {-1, -1, -1});
    for (std::size_t c = 0; c < conditions.size(); ++c)
      for (const int node : set_called(conditions[c].set, conditions[c].line)->nodes)
        condition_of_[static_cast<std::size_t>(node)]
                     [static_cast<std::size_t>(conditions[c].axis)] = static_cast<int>(c);
    std::set<std::string> done;
    for (const FebioNodeCondition& condition : conditions)
      if (moves(condition) && done.insert(condition.set).second) add_grip(condition);
    for (std::size_t c = 0; c < conditions.size(); ++c)
      if (moves(conditions[c])) add_driven_support(static_cast<int>(c));
    done.clear();
    for (const FebioNodeCondition& condition : conditions)
      if (!moves(condition) && done.insert(condition.set).second) add_support(condition);
  }

  static bool moves(const FebioNodeCondition& condition) {
    return condition.prescribed && condition.prescribed->value != 0;
  }

  /// Along all three axes, the same of all nodes of the set; empty if it is not so.
  std::optional<Drive> drive_of(const sim::MeshSet& set) const {
    Drive drive;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::optional<std::optional<FebioValue>> common;
      for (const int node : set.nodes) {
        const int c = condition_of_[static_cast<std::size_t>(node)][axis];
        if (c < 0) return std::nullopt;
        const FebioNodeCondition& condition = model_.node_conditions[static_cast<std::size_t>(c)];
        const std::optional<FebioValue> value =
            moves(condition) ? condition.prescribed : std::nullopt;
        if (common && !is_same(*common, value)) return std::nullopt;
        common = value;
      }
      if (common) drive[axis] = *common;
    }
    return drive;
  }

  bool are_attached(const sim::MeshSet& set) const {
    return std::all_of(set.nodes.begin(), set.nodes.end(),
                       [&](int node) { return attached_[static_cast<std::size_t>(node)] != 0; });
  }
  bool is_one_attached(const sim::MeshSet& set) const {
    return std::any_of(set.nodes.begin(), set.nodes.end(),
                       [&](int node) { return attached_[static_cast<std::size_t>(node)] != 0; });
  }

  /// Nodes that are moved along all three axes hang on a fixed body without a shape, which is
  /// driven.
  void add_grip(const FebioNodeCondition& condition) {
    const sim::MeshSet& set = *set_called(condition.set, condition.line);
    const std::optional<Drive> drive = drive_of(set);
    if (!drive || is_one_attached(set)) return;
    const std::string grip = scenario_name("grip of " + set.name);
    text_ += TomlEntry("[[body]]").add("name", toml_text(grip)).add("kind", "\"fixed\"").text();
    for (const ImportedBody& tissue : bodies_)
      if (!tissue.is_rigid() && has_any(tissue, set)) attach(tissue, grip, set);
    add_motion({"body", grip, Eigen::Vector3d::Zero(), false, condition.line}, *drive);
    add_reaction("body", grip);
  }

  /// Nodes that are moved along one axis alone.
  void add_driven_support(int index) {
    const FebioNodeCondition& condition = model_.node_conditions[static_cast<std::size_t>(index)];
    const sim::MeshSet& set = *set_called(condition.set, condition.line);
    if (are_attached(set)) return;  // they hang on a grip
    const auto is_all = [&](const auto& test) {
      return std::all_of(set.nodes.begin(), set.nodes.end(), test);
    };
    const auto axis = static_cast<std::size_t>(condition.axis);
    std::string_view why;
    if (is_one_attached(set))
      why = "some of the nodes go with a rigid body";
    else if (!is_all([&](int node) {
               return condition_of_[static_cast<std::size_t>(node)][axis] == index;
             }))
      why = "some of the nodes are held or moved along it by another condition";
    else if (value_of(condition.prescribed, 0) != 0)
      why = "it is not 0 at the start";
    if (!why.empty())
      return lose(condition.line, fmt::format("the prescribed displacement of {} along {}: {}",
                                              sim::in_ticks(set.name), "xyz"[axis], why));
    Drive drive;
    drive[axis] = condition.prescribed;
    const std::string wanted = fmt::format("{} {}", scenario_name(set.name), "xyz"[axis]);
    for (const ImportedBody& tissue : bodies_) {
      if (tissue.is_rigid() || !has_any(tissue, set)) continue;
      const std::string name =
          add_support_entry(wanted, tissue, set, fmt::format("\"{}\"", kFreedomWords[axis]));
      add_motion({"support", name, std::nullopt, false, condition.line}, drive);
    }
  }

  /// With a probe of its reaction. @return its name
  std::string add_support_entry(const std::string& wanted, const ImportedBody& tissue,
                                const sim::MeshSet& set, const std::string& freedoms) {
    const std::string name = new_name(wanted);
    text_ += TomlEntry("[[support]]")
                 .add("name", toml_text(name))
                 .add("body", toml_text(tissue.name))
                 .add("region", fmt::format("{{ set = {} }}", toml_text(set.name)))
                 .add("freedoms", "[" + freedoms + "]")
                 .text();
    add_reaction("support", name);
    return name;
  }

  void add_reaction(std::string_view kind, const std::string& name) {
    probes_ += TomlEntry("[[probe]]")
                   .add("name", toml_text(name))
                   .add("kind", "\"reaction\"")
                   .add(kind, toml_text(name))
                   .text();
  }

  bool is_one_moved(const sim::MeshSet& set, int axis) const {
    return std::any_of(set.nodes.begin(), set.nodes.end(), [&](int node) {
      const int c = condition_of_[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis)];
      return c >= 0 && moves(model_.node_conditions[static_cast<std::size_t>(c)]);
    });
  }

  void add_support(const FebioNodeCondition& first) {
    const sim::MeshSet& set = *set_called(first.set, first.line);
    if (are_attached(set)) return;  // held by what they hang on
    if (is_one_attached(set))
      return lose(first.line,
                  fmt::format("the held nodes of {}: some of them are moved, or go with a "
                              "rigid body",
                              sim::in_ticks(set.name)));
    std::string freedoms;
    for (int axis = 0; axis < 3; ++axis)
      for (const FebioNodeCondition& condition : model_.node_conditions) {
        if (condition.set != first.set || condition.axis != axis || moves(condition) ||
            freedoms.find(kFreedomWords[axis]) != std::string::npos)
          continue;
        if (is_one_moved(set, axis))
          lose(condition.line, fmt::format("the held nodes of {} along {}: some of them are moved "
                                           "along it by another condition",
                                           sim::in_ticks(set.name), "xyz"[axis]));
        else
          freedoms += fmt::format("{}\"{}\"", freedoms.empty() ? "" : ", ", kFreedomWords[axis]);
      }
    if (freedoms.empty()) return;
    for (const ImportedBody& tissue : bodies_) {
      if (tissue.is_rigid() || !has_any(tissue, set)) continue;
      add_support_entry(scenario_name(set.name), tissue, set, freedoms);
    }
  }

  std::string new_name(const std::string& wanted) {
    std::string name = wanted;
    for (int k = 2; !names_.insert(name).second; ++k) name = fmt::format("{} {}", wanted, k);
    return name;
  }

  void add_loads() {
    for (const FebioBodyForce& force : model_.body_forces) {
      TomlEntry entry("[[load]]");
      entry.add("kind", "\"gravity\"");
      entry.add("acceleration",
                toml_vector(force.value.value * force.acceleration, units_.acceleration()));
      add_profile(force.value, entry);
      text_ += entry.text();
    }
    for (const FebioNodeLoad& load : model_.node_loads) {
      const sim::MeshSet& set = *set_called(load.set, load.line);
      for (const ImportedBody& tissue : bodies_)
        if (!tissue.is_rigid() && has_any(tissue, set)) add_node_load(load, tissue, set);
    }
    for (const FebioSurfaceLoad& load : model_.surface_loads) add_surface_load(load);
  }

  /// The force in the file acts on each node, here it is shared by them.
  void add_node_load(const FebioNodeLoad& load, const ImportedBody& tissue,
                     const sim::MeshSet& set) {
    const auto count = std::count_if(set.nodes.begin(), set.nodes.end(), [&](int node) {
      return tissue.has_node[static_cast<std::size_t>(node)] != 0;
    });
    TomlEntry entry("[[load]]");
    entry.add("kind", "\"force\"").add("body", toml_text(tissue.name));
    entry.add("region", fmt::format("{{ set = {} }}", toml_text(set.name)));
    entry.add("force", toml_vector(static_cast<double>(count) * load.value.value * load.direction,
                                   units_.force));
    add_profile(load.value, entry);
    text_ += entry.text();
  }

  void add_surface_load(const FebioSurfaceLoad& load) {
    const sim::MeshSet& set = *set_called(load.surface, load.line);
    bool is_used = false;
    for (const ImportedBody& tissue : bodies_) {
      if (tissue.is_rigid() || !has_all(tissue, set)) continue;
      TomlEntry entry("[[load]]");
      entry.add("kind", load.traction ? "\"traction\"" : "\"pressure\"");
      entry.add("body", toml_text(tissue.name));
      entry.add("region", fmt::format("{{ set = {} }}", toml_text(set.name)));
      if (load.traction)
        entry.add("traction", toml_vector(load.value.value * *load.traction, units_.stress));
      else
        entry.add("pressure", toml_quantity(load.value.value, units_.stress));
      add_profile(load.value, entry);
      text_ += entry.text();
      is_used = true;
    }
    if (!is_used)
      lose(load.line, fmt::format("the load on {}: it is not the surface of one tissue",
                                  sim::in_ticks(set.name)));
  }

  const ImportedBody* body_of(const sim::MeshSet& surface) const {
    const auto found = std::find_if(bodies_.begin(), bodies_.end(), [&](const ImportedBody& body) {
      return has_all(body, surface);
    });
    return found != bodies_.end() ? &*found : nullptr;
  }

  void add_contacts() {
    for (const FebioContact& contact : model_.contacts) {
      const sim::MeshSet& first = *set_called(contact.first, contact.line);
      const sim::MeshSet& second = *set_called(contact.second, contact.line);
      const ImportedBody *const a = body_of(first), *const b = body_of(second);
      if (a == nullptr || b == nullptr)
        lose(contact.line, fmt::format("contact of {} and {}: they are not surfaces of two bodies",
                                       sim::in_ticks(first.name), sim::in_ticks(second.name)));
      else if (contact.type.starts_with("tied"))
        add_tie(contact, *a, first, *b, second);
      else
        add_sliding(contact, *a, *b);
    }
  }

  void add_tie(const FebioContact& contact, const ImportedBody& a, const sim::MeshSet& first,
               const ImportedBody& b, const sim::MeshSet& second) {
    if (a.is_rigid() == b.is_rigid())
      lose(contact.line, fmt::format("the tie of {} and {}: only a tissue is tied to a rigid body",
                                     sim::in_ticks(a.name), sim::in_ticks(b.name)));
    else if (b.is_rigid())
      attach(a, b.name, first);
    else
      attach(b, a.name, second);
  }

  void add_sliding(const FebioContact& contact, const ImportedBody& a, const ImportedBody& b) {
    if (!pairs_.insert({std::min(a.name, b.name), std::max(a.name, b.name)}).second) return;
    TomlEntry entry("[[contact]]");
    if (&a == &b)
      entry.add("self", toml_text(a.name));
    else
      entry.add("bodies", fmt::format("[{}, {}]", toml_text(a.name), toml_text(b.name)));
    if (contact.friction > 0 && model_.is_dynamic)
      entry.add("friction", fmt::format("{}", contact.friction));
    else if (contact.friction > 0)
      lose(contact.line, "friction: in a static analysis nothing has a velocity");
    text_ += entry.text();
    has_contact_ = true;
    probes_ += TomlEntry("[[probe]]")
                   .add("name", toml_text(new_name(a.name + " on " + b.name)))
                   .add("kind", "\"contact\"")
                   .add("bodies", fmt::format("[{}, {}]", toml_text(b.name), toml_text(a.name)))
                   .text();
  }

  std::string file_;
  const FebioModel& model_;
  const sim::MeshData& mesh_;
  const UnitSystem& units_;
  std::string mesh_file_;
  std::vector<Loss> losses_;
  std::vector<ImportedBody> bodies_;  // those that the scenario has
  std::vector<char> attached_;        // by node
  std::vector<std::array<int, 3>> condition_of_;
  std::set<std::string> used_curves_, names_;
  std::set<std::pair<std::string, std::string>> pairs_;
  bool has_contact_ = false;
  std::string text_, probes_;
};

}  // namespace

ImportedScenario scenario_of(const std::string& file, const FebioModel& model,
                             const sim::MeshData& mesh, const UnitSystem& units,
                             const std::string& mesh_file) {
  return ScenarioWriter(file, model, mesh, units, mesh_file).write();
}

}  // namespace articular::tools
