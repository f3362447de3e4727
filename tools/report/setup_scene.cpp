#include "tools/report/setup_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <type_traits>

#include "sim/base/error.hpp"
#include "sim/base/version.hpp"
#include "sim/build/build_model.hpp"
#include "sim/model/configuration.hpp"
#include "sim/scenario/scenario_choices.hpp"
#include "sim/scenario/toml_document.hpp"
#include "tools/render/setup_frame.hpp"
#include "tools/report/page_scene.hpp"
#include "tools/report/setup_marks.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

std::string words_of(const sim::Node& node) {
  return std::visit(
      [](const auto& value) -> std::string {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, std::string>) return value;
        if constexpr (std::is_same_v<Value, bool>) return value ? "true" : "false";
        if constexpr (std::is_arithmetic_v<Value>) return fmt::format("{}", value);
        if constexpr (std::is_same_v<Value, sim::Node::List>) {
          std::string text;
          for (const sim::Node& one : value) text += (text.empty() ? "" : ", ") + words_of(one);
          return text;
        }
        if constexpr (std::is_same_v<Value, sim::TomlTable>) {
          std::string text;
          for (const sim::Member& member : value.members)
            text += (text.empty() ? "" : ", ") + member.key + " " + words_of(member.node);
          return text;
        }
        return {};  // a date: no key has one
      },
      node.value);
}

/// A row for each value below a table: {"material.young_modulus", "15 kPa"}.
void add_rows(const sim::TomlTable& table, const std::string& before, Json& rows) {
  for (const sim::Member& member : table.members) {
    const std::string key = before + member.key;
    if (member.node.table() != nullptr)
      add_rows(*member.node.table(), key + ".", rows);
    else if (key != "name")
      rows.push_back({key, words_of(member.node)});
  }
}

/// What the scenario says of each body, in its own words.
std::map<std::string, Json> details_of_bodies(const fs::path& scenario) {
  sim::Node document = sim::read_toml(scenario);
  sim::apply_choices(document);
  std::map<std::string, Json> details;
  const sim::Node* const bodies = document.find("body");
  if (bodies == nullptr || bodies->list() == nullptr) return details;
  for (const sim::Node& body : *bodies->list()) {
    Json rows = Json::array();
    add_rows(*body.table(), "", rows);
    details[words_of(*body.find("name"))] = rows;
  }
  return details;
}

/// How much of each the scene has.
Json scene_rows(const sim::Scenario& scenario) {
  Json rows = Json::array();
  const auto add = [&](const char* what, std::size_t count) {
    if (count > 0) rows.push_back({what, fmt::format("{}", count)});
  };
  add("bodies", scenario.bodies.size());
  add("attachments", scenario.attachments.size());
  add("supports", scenario.supports.size());
  add("sheets", scenario.sheets.size());
  add("muscles", scenario.muscles.size());
  add("ligaments", scenario.ligaments.size());
  add("boluses", scenario.boluses.size());
  add("loads", scenario.loads.size());
  add("probes", scenario.probes.size());
  return rows;
}

}  // namespace

Json setup_of(const fs::path& file) {
  const sim::Scenario scenario = sim::read_scenario(file);
  const sim::Model model = sim::build_model(scenario);
  const double unit = scenario.output.length_unit.metres;
  sim::Configuration start;
  sim::read_state(model, sim::initial_state(model).data(), 0, start);
  PageScene page;
  page.add(start_frame(model, start, unit));
  Directions directions;
  std::copy(scenario.output.directions.begin(), scenario.output.directions.end(),
            directions.begin());
  Json scene = page.json(directions);
  if (scene["bodies"].empty())
    throw sim::InputError({file.string()}, "no body of this scenario has a mesh to show");
  const std::map<std::string, Json> details = details_of_bodies(file);
  for (Json& body : scene["bodies"])
    if (const auto it = details.find(body["name"].get<std::string>()); it != details.end())
      body["details"] = it->second;
  scene["marks"] = setup_marks(model, start, unit);
  scene["moments"] = {"set-up"};
  scene["length_unit"] = scenario.output.length_unit.name;
  Json remarks = page.remarks();
  for (const std::string& warning : model.warnings) remarks.push_back(warning);
  return {{"kind", "setup"},
          {"program", sim::kVersion},
          {"title", scenario.title.empty() ? scenario.name : scenario.title},
          {"scenario", scenario.file.filename().string()},
          {"settings", Json::parse(scenario.settings_json, nullptr, false)},
          {"counts", scene_rows(scenario)},
          {"scene", scene},
          {"remarks", remarks}};
}

}  // namespace articular::tools
