#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/import/febio_bodies.hpp"
#include "tools/import/febio_model.hpp"
#include "tools/import/toml_entry.hpp"
#include "tools/import/unit_system.hpp"

namespace articular::tools {

/// A scenario while it is written, and what of the model is told meanwhile.
struct ScenarioDraft {
  std::string file;  // the model's, for messages
  const FebioModel& model;
  const sim::MeshData& mesh;
  const UnitSystem& units;
  std::string mesh_file;  // as the scenario names it

  std::vector<ImportedBody> bodies;   // those that the scenario has
  std::vector<char> attached;         // by node: whether it goes with a rigid body or a grip
  std::set<std::string> used_curves;  // which loads follow, by the model's id
  std::set<std::string> names;        // of supports and contact probes
  std::string text, probes;           // probes come last
  std::vector<Loss> losses;

  void lose(int line, std::string what) { losses.push_back({line, std::move(what)}); }
};

inline constexpr const char* kFreedomWords[] = {"translation.x", "translation.y", "translation.z",
                                                "rotation.x",    "rotation.y",    "rotation.z"};

/// @throws sim::InputError at the line that names it, if the mesh has no such set
const sim::MeshSet* set_called(const ScenarioDraft& draft, const std::string& name, int line);

/// `wanted`, or with a number after it where that is taken.
std::string new_name(ScenarioDraft& draft, const std::string& wanted);

/// The name of a load curve of the model.
std::string curve_name(const std::string& id);

/// "0 s", "1 s" and 0, 2: points of a curve, its values times `factor`.
struct CurveLists {
  std::string times, values;
};
CurveLists curve_lists(const sim::Curve& curve, double factor);

/// A load follows the curve of its value, if it has one.
void add_profile(ScenarioDraft& draft, const FebioValue& value, TomlEntry& entry);

/// A probe of the reaction of a "body" or a "support".
void add_reaction(ScenarioDraft& draft, std::string_view kind, const std::string& name);

/// Nodes of a set go with a body.
void attach(ScenarioDraft& draft, const ImportedBody& tissue, const std::string& to,
            const sim::MeshSet& set);

}  // namespace articular::tools
