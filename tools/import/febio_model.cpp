#include "tools/import/febio_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/mesh/febio_mesh.hpp"
#include "sim/mesh/mesh_readers.hpp"

namespace articular::tools {
namespace {

using sim::XmlElement;

std::string in_lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string text_of(const XmlElement& element, std::string_view child) {
  const XmlElement* const found = element.child(child);
  return found != nullptr ? found->text : "";
}

std::string attribute_of(const XmlElement& element, std::string_view name) {
  const std::string* const found = element.attribute(name);
  return found != nullptr ? *found : "";
}

/// "x,y,z" in version 2.5 and 3.0; in 4.0 children such as <x_dof>1</x_dof>.
std::vector<std::string> dofs_of(const XmlElement& element, std::string list) {
  std::vector<std::string> dofs;
  std::replace(list.begin(), list.end(), ',', ' ');
  for (std::size_t at = 0; (at = list.find_first_not_of(' ', at)) != std::string::npos;) {
    const std::size_t end = std::min(list.find(' ', at), list.size());
    dofs.push_back(list.substr(at, end - at));
    at = end;
  }
  for (const XmlElement& child : element.children)
    if (child.name.ends_with("_dof") && child.text == "1")
      dofs.push_back(child.name.substr(0, child.name.size() - 4));
  return dofs;
}

/// 0 to 2 of "x", "y", "z"; -1 of others.
int axis_of(const std::string& dof) {
  return dof.size() == 1 && dof[0] >= 'x' && dof[0] <= 'z' ? dof[0] - 'x' : -1;
}

/// 0 to 5. Translations are "x" or "Rx", rotations "Ru" or "u".
int freedom_of(const std::string& dof) {
  const std::string letter = dof.starts_with('R') ? dof.substr(1) : dof;
  if (axis_of(letter) >= 0) return axis_of(letter);
  return letter.size() == 1 && letter[0] >= 'u' && letter[0] <= 'w' ? 3 + letter[0] - 'u' : -1;
}

class ModelReader {
 public:
  ModelReader(std::string file, const XmlElement& document)
      : file_(std::move(file)), document_(document), version_(attribute_of(document, "version")) {}

  FebioModel read() {
    for (const XmlElement& section : document_.children) read_section(section);
    check_curves();
    return std::move(model_);
  }

 private:
  sim::Location at(const XmlElement& element) const { return {file_, element.line}; }

  void lose(const XmlElement& element, std::string what) {
    model_.losses.push_back({element.line, std::move(what)});
  }
  /// Of an entry that is not known: its element and type.
  void lose_unknown(const XmlElement& element) {
    const std::string type = attribute_of(element, "type");
    lose(element, fmt::format("<{}{}>", sim::one_line(element.name),
                              type.empty() ? "" : " type=" + sim::in_quotes(type)));
  }

  void read_section(const XmlElement& section) {
    const std::string& name = section.name;
    if (name == "Module")
      read_module(section);
    else if (name == "Control")
      read_control(section);
    else if (name == "Material")
      read_materials(section);
    else if (name == "Mesh" || name == "Geometry")
      read_mesh_section(section);
    else if (name == "MeshDomains")
      read_domains(section);
    else if (name == "Boundary")
      for (const XmlElement& entry : section.children) read_boundary(entry);
    else if (name == "Rigid")
      for (const XmlElement& entry : section.children) read_rigid(entry);
    else if (name == "Loads")
      for (const XmlElement& entry : section.children) read_load(entry);
    else if (name == "Contact")
      for (const XmlElement& entry : section.children) read_contact(entry);
    else if (name == "LoadData")
      for (const XmlElement& entry : section.children) read_curve(entry);
    else if (name == "Step")
      read_step(section);
    else if (name != "Globals" && name != "MeshData" && name != "Output")
      for (const XmlElement& entry : section.children) lose_unknown(entry);
  }

  /// Version 2.5 has one section for each step, later ones have them in one. The first is read.
  void read_step(const XmlElement& section) {
    std::vector<const XmlElement*> steps;
    for (const XmlElement& child : section.children)
      if (child.name == "step") steps.push_back(&child);
    if (steps.empty()) steps.push_back(&section);
    for (const XmlElement* const step : steps) {
      if (has_step_)
        lose(*step, "a further step: its duration, loads and conditions");
      else
        for (const XmlElement& part : step->children) read_section(part);
      has_step_ = true;
    }
  }

  void read_module(const XmlElement& module) {
    const std::string type = attribute_of(module, "type");
    if (type != "solid" && type != "explicit-solid")
      throw sim::InputError(at(module), fmt::format("the model is of the module {}; expected a "
                                                    "solid one: articular has no fluid",
                                                    sim::in_quotes(type)));
    const std::string units = text_of(module, "units");
    if (!units.empty()) model_.units = units;
  }

  void read_control(const XmlElement& control) {
    const XmlElement* const analysis = control.child("analysis");
    if (analysis != nullptr) {
      const std::string type = attribute_of(*analysis, "type");
      model_.is_dynamic = in_lower_case(type.empty() ? analysis->text : type) == "dynamic";
    }
    if (const XmlElement* const step = control.child("step_size")) model_.step = number(*step);
    if (const XmlElement* const steps = control.child("time_steps"))
      model_.num_steps = static_cast<int>(std::clamp(number(*steps), 1.0, 1e9));
    if (!(model_.step > 0)) throw sim::InputError(at(control), "the step size must be positive");
  }

  double number(const XmlElement& element) const {
    const std::optional<double> value = sim::parse_number(element.text);
    if (!value)
      throw sim::InputError(
          at(element), fmt::format("<{}> is {}, expected a number", sim::one_line(element.name),
                                   sim::in_quotes(element.text)));
    return *value;
  }

  void read_materials(const XmlElement& section) {
    for (const XmlElement& material : section.children)
      model_.materials.push_back({attribute_of(material, "id"), attribute_of(material, "name"),
                                  attribute_of(material, "type"), &material});
  }

  /// Parts of version 2.5 name their material; those of later ones in the section of domains.
  void read_mesh_section(const XmlElement& section) {
    int count = 0;
    for (const XmlElement& child : section.children) {
      if (child.name == "Elements" && version_ == "2.5")
        model_.parts.push_back(
            {sim::febio_part_name(child, ++count), attribute_of(child, "mat"), child.line});
      if (child.name == "SurfacePair") read_surface_pair(child);
      if (child.name == "DiscreteSet") lose(child, "springs between nodes (<DiscreteSet>)");
    }
  }

  void read_surface_pair(const XmlElement& pair) {
    const auto surface = [&](std::initializer_list<std::string_view> names) -> std::string {
      for (const std::string_view name : names)
        if (const XmlElement* const found = pair.child(name))
          return found->text.empty() ? attribute_of(*found, "surface") : found->text;
      return {};
    };
    pairs_[attribute_of(pair, "name")] = {surface({"primary", "slave"}),
                                          surface({"secondary", "master"})};
  }

  void read_domains(const XmlElement& section) {
    for (const XmlElement& domain : section.children)
      model_.parts.push_back(
          {attribute_of(domain, "name"), attribute_of(domain, "mat"), domain.line});
  }

  /// "@surface:top" is the nodes of a surface: here sets of all kinds have their nodes.
  static std::string set_name(const std::string& name) {
    return name.starts_with('@') ? name.substr(std::min(name.find(':'), name.size() - 1) + 1)
                                 : name;
  }

  /// The number in a child (or, if there is none of the names, 1), with its curve.
  FebioValue value_of(const XmlElement& entry, std::initializer_list<std::string_view> names) {
    FebioValue value{1, ""};
    for (const std::string_view name : names) {
      const XmlElement* const child = entry.child(name);
      if (child == nullptr) continue;
      value.value *= number(*child);
      take_curve(*child, value);
    }
    return value;
  }

  void take_curve(const XmlElement& element, FebioValue& value) {
    const std::string curve = attribute_of(element, "lc");
    if (curve.empty()) return;
    if (!value.curve.empty() && value.curve != curve)
      lose(element, fmt::format("the product of load curves {} and {}: the second alone is taken",
                                sim::one_line(value.curve), sim::one_line(curve)));
    value.curve = curve;
    uses_.emplace_back(curve, element.line);
  }

  void read_boundary(const XmlElement& entry) {
    const std::string type = entry.name == "bc" ? attribute_of(entry, "type") : entry.name;
    const std::string set = set_name(attribute_of(entry, "node_set"));
    const XmlElement* const relative = entry.child("relative");
    if (type == "fix" || type == "zero displacement") {
      const std::string list =
          entry.name == "bc" ? text_of(entry, "dofs") : attribute_of(entry, "bc");
      for (const std::string& dof : dofs_of(entry, list)) hold_nodes(entry, set, dof, std::nullopt);
    } else if (type == "prescribe" || type == "prescribed displacement") {
      const std::string dof =
          entry.name == "bc" ? text_of(entry, "dof") : attribute_of(entry, "bc");
      if (relative != nullptr && relative->text == "1" && has_step_)
        lose(entry, "a prescribed displacement relative to an earlier step");
      hold_nodes(entry, set, dof, value_of(entry, {"scale", "value"}));
    } else if (type == "rigid") {
      const std::string rigid =
          entry.name == "bc" ? text_of(entry, "rb") : attribute_of(entry, "rb");
      model_.rigid_nodes.push_back({set, rigid, entry.line});
    } else if (type == "rigid_body") {
      read_rigid_body(entry);
    } else {
      lose_unknown(entry);
    }
  }

  void hold_nodes(const XmlElement& entry, const std::string& set, const std::string& dof,
                  std::optional<FebioValue> prescribed) {
    if (axis_of(dof) >= 0)
      model_.node_conditions.push_back({set, axis_of(dof), std::move(prescribed), entry.line});
    else
      lose(entry, fmt::format("the condition on the freedom {} of nodes", sim::in_quotes(dof)));
  }

  /// Version 2.5: <rigid_body mat="2"><fixed bc="x"/><prescribed bc="z" lc="1">5</prescribed>
  void read_rigid_body(const XmlElement& entry) {
    const std::string material = attribute_of(entry, "mat");
    for (const XmlElement& child : entry.children) {
      FebioValue value;
      if (child.name == "prescribed" || child.name == "force") {
        value.value = number(child);
        take_curve(child, value);
      }
      add_rigid(child, child.name, material, attribute_of(child, "bc"), value);
    }
  }

  void read_rigid(const XmlElement& entry) {
    const std::string type = attribute_of(entry, "type"), material = text_of(entry, "rb");
    if (type == "fix" || type == "rigid_fixed") {
      for (const std::string& dof : dofs_of(entry, text_of(entry, "dofs")))
        add_rigid(entry, "fixed", material, dof, {});
    } else if (type == "prescribe" || type == "rigid_displacement") {
      add_rigid(entry, "prescribed", material, text_of(entry, "dof"), value_of(entry, {"value"}));
    } else if (type == "rigid_rotation") {
      add_rigid(entry, "prescribed", material, rotation_dof(text_of(entry, "dof")),
                value_of(entry, {"value"}));
    } else if (type == "force" || type == "rigid_force") {
      add_rigid(entry, "force", material, text_of(entry, "dof"), value_of(entry, {"value"}));
    } else {
      lose_unknown(entry);
    }
  }

  /// Some files call rotations after the axis: "Rx" here means the same as "Ru".
  static std::string rotation_dof(const std::string& dof) {
    const int freedom = freedom_of(dof);
    constexpr const char* kRotations[] = {"Ru", "Rv", "Rw"};
    return freedom >= 0 && freedom < 3 ? kRotations[freedom] : dof;
  }

  void add_rigid(const XmlElement& entry, const std::string& kind, const std::string& material,
                 const std::string& dof, const FebioValue& value) {
    const int freedom = freedom_of(dof);
    if (freedom >= 0 && kind == "fixed")
      model_.rigid_conditions.push_back({material, freedom, std::nullopt, entry.line});
    else if (freedom >= 0 && kind == "prescribed")
      model_.rigid_conditions.push_back({material, freedom, value, entry.line});
    else if (freedom >= 0 && freedom < 3 && kind == "force")
      model_.rigid_forces.push_back({material, freedom, value, entry.line});
    else
      lose(entry, fmt::format("{} {} of a rigid body", sim::one_line(kind), sim::in_quotes(dof)));
  }

  void read_load(const XmlElement& entry) {
    const std::string type = attribute_of(entry, "type");
    if (entry.name == "nodal_load")
      read_node_load(entry, type);
    else if (entry.name == "surface_load")
      read_surface_load(entry, type);
    else if (entry.name == "body_load")
      read_body_load(entry, type);
    else
      lose_unknown(entry);
  }

  void read_node_load(const XmlElement& entry, const std::string& type) {
    const std::string set = set_name(attribute_of(entry, "node_set"));
    if (type == "nodal_force") {
      const XmlElement* const force = entry.child("value");
      if (force == nullptr) return lose_unknown(entry);
      FebioValue value{1, ""};
      take_curve(*force, value);
      model_.node_loads.push_back(
          {set, sim::febio_vector(at(*force), force->text), value, entry.line});
      return;
    }
    const std::string dof =
        attribute_of(entry, "bc").empty() ? text_of(entry, "dof") : attribute_of(entry, "bc");
    if (axis_of(dof) < 0) return lose_unknown(entry);
    model_.node_loads.push_back({set, Eigen::Vector3d::Unit(axis_of(dof)),
                                 value_of(entry, {"scale", "value"}), entry.line});
  }

  void read_surface_load(const XmlElement& entry, const std::string& type) {
    const std::string surface = attribute_of(entry, "surface");
    if (type == "pressure" && text_of(entry, "linear") != "1") {
      model_.surface_loads.push_back(
          {surface, std::nullopt, value_of(entry, {"pressure", "scale"}), entry.line});
    } else if (type == "traction" && entry.child("traction") != nullptr) {
      const XmlElement& traction = *entry.child("traction");
      FebioValue value = value_of(entry, {"scale"});
      take_curve(traction, value);
      model_.surface_loads.push_back(
          {surface, sim::febio_vector(at(traction), traction.text), value, entry.line});
    } else {
      lose_unknown(entry);
    }
  }

  /// FEBio's body force is minus an acceleration.
  void read_body_load(const XmlElement& entry, const std::string& type) {
    if (!attribute_of(entry, "elem_set").empty())
      return lose(entry, "a body force on a part of the model");
    if (type == "const") {
      for (const XmlElement& child : entry.children) {
        if (axis_of(child.name) < 0) continue;
        FebioValue value{number(child), ""};
        take_curve(child, value);
        model_.body_forces.push_back(
            {-Eigen::Vector3d::Unit(axis_of(child.name)), value, entry.line});
      }
    } else if (const XmlElement* const force = entry.child("force");
               type == "body force" && force) {
      FebioValue value{1, ""};
      take_curve(*force, value);
      model_.body_forces.push_back(
          {-sim::febio_vector(at(*force), force->text), value, entry.line});
    } else {
      lose_unknown(entry);
    }
  }

  void read_contact(const XmlElement& entry) {
    FebioContact contact{attribute_of(entry, "type"), "", "", 0, entry.line};
    const auto pair = pairs_.find(attribute_of(entry, "surface_pair"));
    if (pair == pairs_.end()) return lose_unknown(entry);
    std::tie(contact.first, contact.second) = pair->second;
    const bool is_tied = contact.type.starts_with("tied");
    const bool slides =
        contact.type.starts_with("sliding") || contact.type == "facet-to-facet sliding";
    if ((!is_tied && !slides) || contact.type.find("phasic") != std::string::npos)
      return lose_unknown(entry);
    if (const XmlElement* const friction = entry.child("fric_coeff"))
      contact.friction = number(*friction);
    if (text_of(entry, "tension") == "1")
      lose(entry, "contact that holds tension: it only pushes here");
    model_.contacts.push_back(std::move(contact));
  }

  void read_curve(const XmlElement& entry) {
    const std::string id = attribute_of(entry, "id");
    if (entry.name == "load_controller" && attribute_of(entry, "type") != "loadcurve")
      return lose_unknown(entry);
    const XmlElement* const points = entry.child("points");
    sim::Curve& curve = model_.curves[id];
    for (const XmlElement& point : (points != nullptr ? *points : entry).children) {
      if (point.name != "point" && point.name != "pt") continue;
      const Eigen::Vector3d pair = sim::febio_vector(at(point), point.text + " 0");
      if (!curve.time.empty() && !(pair.x() > curve.time.back()))
        throw sim::InputError(at(point), "times of a load curve must increase");
      curve.time.push_back(pair.x());
      curve.value.push_back(pair.y());
    }
    if (curve.time.empty()) throw sim::InputError(at(entry), "a load curve without points");
    const std::string given =
        points != nullptr ? text_of(entry, "interpolate") : attribute_of(entry, "type");
    const std::string kind = in_lower_case(given);
    if (!kind.empty() && kind != "linear")
      lose(entry, fmt::format("interpolation {} of load curve {}: it is linear between its points",
                              sim::in_quotes(kind), sim::one_line(id)));
    const std::string extend =
        in_lower_case(points != nullptr ? text_of(entry, "extend") : attribute_of(entry, "extend"));
    if (!extend.empty() && extend != "constant")
      lose(entry, fmt::format("load curve {} goes on beyond its points as {}: it is constant there",
                              sim::one_line(id), sim::in_quotes(extend)));
  }

  /// Curves that are named and not there, or not taken over.
  void check_curves() {
    for (const auto& [id, line] : uses_)
      if (!model_.curves.contains(id))
        throw sim::InputError({file_, line},
                              fmt::format("there is no load curve {} that can be taken "
                                          "over",
                                          sim::in_ticks(id)));
  }

  std::string file_;
  const XmlElement& document_;
  std::string version_;
  bool has_step_ = false;
  FebioModel model_;
  std::map<std::string, std::pair<std::string, std::string>> pairs_;  // surfaces by name
  std::vector<std::pair<std::string, int>> uses_;                     // of curves, with the line
};

}  // namespace

FebioModel read_febio_model(const std::string& file, const XmlElement& document) {
  return ModelReader(file, document).read();
}

const FebioMaterial* find_material(const FebioModel& model, const std::string& id_or_name) {
  const auto found = std::find_if(model.materials.begin(), model.materials.end(),
                                  [&](const FebioMaterial& material) {
                                    return material.id == id_or_name || material.name == id_or_name;
                                  });
  return found != model.materials.end() ? &*found : nullptr;
}

}  // namespace articular::tools
