#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/import/febio_model.hpp"

namespace articular::tools {

/// A material as a scenario writes it.
struct MaterialText {
  std::string density;                   // "1e-9 t/mm^3" in quotes
  std::string table;                     // "{ law = ..., ... }"
  std::optional<FebioValue> activation;  // of a muscle
};

/// The law that has the same energy as FEBio's, with constants to fit.
/// @param fibre_array  name of a cell array of the mesh with fibres, or ""
/// @param losses       what of it has no counterpart
/// @return nothing if no law here is the same
std::optional<MaterialText> material_text(const FebioMaterial& material, const UnitSystem& units,
                                          const std::string& fibre_array, bool is_dynamic,
                                          std::vector<Loss>& losses);

}  // namespace articular::tools
