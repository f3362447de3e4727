#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/mesh/mesh_io.hpp"
#include "sim/mesh/xml_tree.hpp"
#include "sim/scenario/scenario.hpp"
#include "tools/import/unit_system.hpp"

/// What a FEBio model says, version 2.5, 3.0 or 4.0 alike, in its own units. What is in the file
/// and not here is among the losses.
namespace articular::tools {

/// Something of the model that the scenario has not, or has otherwise.
struct Loss {
  int line;
  std::string what;
};

/// A number times a load curve.
struct FebioValue {
  double value = 0;
  std::string curve;  // id; empty: 1
};

struct FebioMaterial {
  std::string id, name, type;
  const sim::XmlElement* element;
};

/// Elements of one material.
struct FebioPart {
  std::string name;      // of a set of the mesh
  std::string material;  // id or name
  int line;
};

/// Translations of nodes, of which each is free, held or moved.
struct FebioNodeCondition {
  std::string set;
  int axis;                              // 0 to 2
  std::optional<FebioValue> prescribed;  // else held
  int line;
};

/// Nodes that go with a rigid body.
struct FebioRigidNodes {
  std::string set, material;
  int line;
};

/// A freedom of a rigid body.
struct FebioRigidCondition {
  std::string material;
  int freedom;  // x, y, z, rotation about them
  std::optional<FebioValue> prescribed;
  int line;
};

struct FebioRigidForce {
  std::string material;
  int axis;
  FebioValue force;
  int line;
};

struct FebioNodeLoad {
  std::string set;
  Eigen::Vector3d direction;  // times the value: the force on each node
  FebioValue value;
  int line;
};

struct FebioSurfaceLoad {
  std::string surface;
  std::optional<Eigen::Vector3d> traction;  // times the value; else the value is a pressure
  FebioValue value;
  int line;
};

struct FebioBodyForce {
  Eigen::Vector3d acceleration;  // times the value
  FebioValue value;
  int line;
};

struct FebioContact {
  std::string type, first, second;  // surfaces
  double friction = 0;
  int line;
};

struct FebioModel {
  std::string title;
  std::optional<std::string> units;  // as the file calls them
  bool is_dynamic = false;
  double step = 0.1;
  int num_steps = 10;
  std::vector<FebioMaterial> materials;
  std::vector<FebioPart> parts;
  std::map<std::string, sim::Curve> curves;  // by id
  std::vector<FebioNodeCondition> node_conditions;
  std::vector<FebioRigidNodes> rigid_nodes;
  std::vector<FebioRigidCondition> rigid_conditions;
  std::vector<FebioRigidForce> rigid_forces;
  std::vector<FebioNodeLoad> node_loads;
  std::vector<FebioSurfaceLoad> surface_loads;
  std::vector<FebioBodyForce> body_forces;
  std::vector<FebioContact> contacts;
  std::vector<Loss> losses;
};

/// @param file      for messages
/// @param document  <febio_spec>, which the model refers to
/// @throws sim::InputError with the line for what no reader could make sense of
FebioModel read_febio_model(const std::string& file, const sim::XmlElement& document);

/// The material that an id or a name means; nullptr: there is none.
const FebioMaterial* find_material(const FebioModel& model, const std::string& id_or_name);

}  // namespace articular::tools
