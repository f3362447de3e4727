#include "tools/keys/key_schema.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/scenario/scenario_keys.hpp"
#include "tools/keys/key_sections.hpp"
#include "tools/keys/key_words.hpp"

namespace articular::tools {
namespace {

namespace form = sim::form;
using Json = nlohmann::ordered_json;

const std::string kNumber = "[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?";
const std::string kUnit = "(\\s+\\S.*|[A-Za-zµμ/].*)$";

void limit(Json& json, const sim::Range& range) {
  if (std::isfinite(range.min))
    json[range.excludes_ends ? "exclusiveMinimum" : "minimum"] = range.min;
  if (std::isfinite(range.max))
    json[range.excludes_ends ? "exclusiveMaximum" : "maximum"] = range.max;
}

Json reference(std::string_view section) {
  return {{"$ref", "#/definitions/" + without_brackets(section)}};
}

Json schema_of(const sim::KeyType& type);

struct TypeSchema {
  Json operator()(const form::Text&) const { return {{"type", "string"}, {"minLength", 1}}; }
  Json operator()(const form::Boolean&) const { return {{"type", "boolean"}}; }
  Json operator()(const form::Number& number) const {
    Json json{{"type", "number"}};
    limit(json, number.range);
    return json;
  }
  Json operator()(const form::Integer& integer) const {
    return {{"type", "integer"}, {"minimum", integer.min}, {"maximum", integer.max}};
  }
  Json operator()(const form::Quantity&) const {
    return {{"type", "string"}, {"pattern", "^\\s*" + kNumber + kUnit}};
  }
  Json operator()(const form::Vector&) const {
    return {{"type", "string"},
            {"pattern", fmt::format("^\\s*{0}\\s+{0}\\s+{0}{1}", kNumber, kUnit)}};
  }
  Json operator()(const form::Direction&) const {
    return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 3}, {"maxItems", 3}};
  }
  Json operator()(const form::Choice& choice) const {
    Json words = Json::array();
    for (const sim::Word& word : choice.words) words.push_back(word.text);
    return {{"enum", words}};
  }
  Json operator()(const form::Table& table) const { return reference(table.keys().name); }
  Json operator()(const form::VariantTable& table) const {
    return reference(table.variants().name);
  }
  Json operator()(const form::List& list) const {
    Json json{{"type", "array"}, {"items", schema_of(list.of.front())}};
    if (!list.are_entries) json["minItems"] = list.count > 0 ? list.count : 1;
    if (list.count > 0) json["maxItems"] = list.count;
    return json;
  }
  Json operator()(const form::Map& map) const {
    return {{"type", "object"}, {"additionalProperties", schema_of(map.of.front())}};
  }
  Json operator()(const form::Either& either) const {
    Json any = Json::array();
    for (const sim::KeyType& type : either.of) any.push_back(schema_of(type));
    return {{"anyOf", any}};
  }
  Json operator()(const form::Anything&) const { return Json::object(); }
};

Json schema_of(const sim::KeyType& type) { return std::visit(TypeSchema{}, type.variant); }

struct StandardValue {
  Json operator()(std::monostate) const { return nullptr; }
  template <class T>
  Json operator()(const T& standard) const {
    return standard;
  }
};

/// "time, unit such as s, > 0. Time step or load step", for an editor's hint.
std::string description(const sim::Key& key) {
  const std::string unit = unit_words(key.type), range = range_words(key.type);
  std::string text(key.meaning);
  if (!unit.empty()) text += fmt::format(". Unit such as {}", unit);
  if (!range.empty()) text += fmt::format(". Range: {}", range);
  if (!key.absence.is_error && !key.absence.words.empty())
    text += fmt::format(". Default: {}", key.absence.words);
  return text;
}

Json schema_of(const sim::Key& key) {
  Json json = schema_of(key.type);
  // Draft 7 ignores what stands beside a reference.
  if (json.contains("$ref")) json = {{"allOf", Json::array({json})}};
  json["description"] = description(key);
  if (const Json standard = std::visit(StandardValue{}, key.absence.value); !standard.is_null())
    json["default"] = standard;
  return json;
}

Json schema_of(const sim::KeyTable& table, bool have_when) {
  Json properties = Json::object(), required = Json::array();
  for (const sim::Key& key : table.keys) {
    properties[std::string(key.name)] = schema_of(key);
    if (key.absence.is_error) required.push_back(key.name);
  }
  if (have_when) properties["when"] = schema_of(sim::when_key());
  Json json{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) json["required"] = required;
  return json;
}

Json schema_of(const KeySection& section) {
  if (section.variants == nullptr) return schema_of(*section.tables.front(), section.have_when);
  Json variants = Json::array();
  for (const sim::KeyTable* table : section.tables)
    variants.push_back(schema_of(*table, section.have_when));
  return {{"oneOf", variants}};
}

}  // namespace

std::string json_schema(const sim::KeyTable& root, const std::string& title) {
  const std::vector<KeySection> sections = key_sections(root);
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  schema.update(schema_of(sections.front()));
  for (std::size_t i = 1; i < sections.size(); ++i)
    schema["definitions"][without_brackets(sections[i].name)] = schema_of(sections[i]);
  return schema.dump(1) + "\n";
}

}  // namespace articular::tools
