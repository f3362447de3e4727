#include "tools/import/febio_scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sim/base/error.hpp"
#include "tools/import/febio_body_entries.hpp"
#include "tools/import/febio_contacts.hpp"
#include "tools/import/febio_loads.hpp"
#include "tools/import/febio_node_conditions.hpp"
#include "tools/import/scenario_draft.hpp"

namespace articular::tools {
namespace {

std::string first_losses(const std::vector<Loss>& losses) {
  std::string text;
  for (const Loss& loss : losses)
    text += fmt::format("{}line {}: {}", text.empty() ? "" : "; ", loss.line, loss.what);
  return text.empty() ? "the model has no part with a material" : text;
}

std::string head(const FebioModel& model, bool has_contact) {
  const double duration = model.step * model.num_steps;
  std::string text =
      fmt::format("title = {}\nduration = {}\nanalysis = \"{}\"\n", toml_text(model.title),
                  toml_quantity(duration, "s"), model.is_dynamic ? "dynamic" : "static");
  if (!has_contact) text += "contact = false\n";
  return text + fmt::format("\n[integrator]\nstep = {0}\n\n[output]\ninterval = {0}\n",
                            toml_quantity(model.step, "s"));
}

std::string curves(const ScenarioDraft& draft) {
  std::string text;
  for (const auto& [id, curve] : draft.model.curves) {
    if (!draft.used_curves.contains(id)) continue;
    const CurveLists lists = curve_lists(curve, 1);
    text += fmt::format("\n[curve.{}]\ntime = [{}]\nvalue = [{}]\n", toml_text(curve_name(id)),
                        lists.times, lists.values);
  }
  return text;
}

}  // namespace

ImportedScenario scenario_of(const std::string& file, const FebioModel& model,
                             const sim::MeshData& mesh, const UnitSystem& units,
                             const std::string& mesh_file) {
  ScenarioDraft draft{file, model, mesh, units, mesh_file, {}, {}, {}, {}, {}, {}, model.losses};
  add_bodies(draft);
  if (draft.bodies.empty())
    throw sim::InputError({file}, "nothing can be taken over: " + first_losses(draft.losses));
  add_attachments(draft);
  add_node_conditions(draft);
  add_loads(draft);
  const bool has_contact = add_contacts(draft);
  std::stable_sort(draft.losses.begin(), draft.losses.end(),
                   [](const Loss& a, const Loss& b) { return a.line < b.line; });
  return {head(model, has_contact) + curves(draft) + draft.text + draft.probes,
          std::move(draft.losses)};
}

}  // namespace articular::tools
