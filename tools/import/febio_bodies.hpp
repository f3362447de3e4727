#pragma once

#include <string>
#include <vector>

#include "tools/import/febio_model.hpp"

namespace articular::tools {

/// Parts of a model that are one body of a scenario.
struct ImportedBody {
  std::string name;
  const FebioMaterial* material;
  std::vector<std::string> parts;
  std::vector<char> has_node;  // by node of the mesh

  bool is_rigid() const { return material->type == "rigid body"; }
};

/// Bodies of a model: a rigid one for each rigid material; of tissue, what one material and common
/// nodes join. Tissues that share nodes and not the material are told as a loss.
std::vector<ImportedBody> bodies_of(const FebioModel& model, const sim::MeshData& mesh,
                                    std::vector<Loss>& losses);

/// A name that scenarios allow, of any text.
std::string scenario_name(const std::string& text);

/// Whether a body has all nodes of a set, or one of them.
bool has_all(const ImportedBody& body, const sim::MeshSet& set);
bool has_any(const ImportedBody& body, const sim::MeshSet& set);

/// The middle of a body's volume, or of its faces if it has none.
Eigen::Vector3d center_of(const ImportedBody& body, const sim::MeshData& mesh);

}  // namespace articular::tools
