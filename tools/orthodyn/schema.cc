// `orthodyn schema`: prints the JSON Schema (draft 7) of the input, for editors.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "lib/config/config.h"
#include "lib/core/spelling.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/input_tree.h"

namespace orthodyn {

namespace {

struct SchemaArguments {
  std::string kind;  // all kinds if empty
};

using Schema = nlohmann::ordered_json;

// A number and a unit, which may begin with 1 ("3 1/s"). orthodyn itself checks whether the unit fits.
constexpr const char* kQuantity = R"(^ *[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)? *(1/)?[^\s\d/*.^()+-]( ?[^\s\d]\d*)* *$)";
// ValueSchema::words of numbers whose unit depends on other keys (lib/config/quantity_value.h).
constexpr const char* kAnyQuantity = "number with unit";

Schema reference_to(const std::string& title) { return {{"$ref", "#/definitions/" + title}}; }

class SchemaWriter {
 public:
  Schema section(const std::vector<Key>& keys, const std::string& type = "") {
    Schema out = {{"type", "object"}, {"properties", Schema::object()}, {"additionalProperties", false}};
    auto& properties = out["properties"];
    if (!type.empty()) properties["type"] = {{"const", type}};
    std::vector<std::string> required;
    for (const Key& key : keys) {
      properties[key.name] = of_key(key);
      if (key.required) required.push_back(key.name);
    }
    properties["include"] = include();
    if (!required.empty()) {  // an included file may contain them
      out["if"] = {{"not", {{"required", {"include"}}}}};
      out["then"] = {{"required", required}};
    }
    return out;
  }

  const Schema& definitions() const { return definitions_; }

 private:
  Schema include() {
    return define("include", []() -> Schema {
      const Schema file = {{"type", "string"}};
      return {{"description", "Files whose keys are included here; the section's own keys take precedence."},
              {"anyOf", {file, {{"type", "array"}, {"items", file}}}}};
    });
  }

  Schema of_key(const Key& key) {
    Schema out = {{"description", description(key)}};
    if (const Schema fallback = Schema::parse(key.fallback, nullptr, false); !fallback.is_discarded())
      out["default"] = fallback;
    else if (key.schema.kind == ValueSchema::Kind::word && !key.fallback.empty()) out["default"] = key.fallback;
    const Schema schema = key.required ? of(key.schema, key) : or_null(of(key.schema, key));
    if (schema.contains("$ref")) out["allOf"] = {schema};  // draft 7 ignores siblings of $ref
    else out.update(schema);
    return out;
  }

  // A null means that the key is not given.
  static Schema or_null(Schema schema) {
    const Schema null = {{"type", "null"}};
    if (schema.contains("$ref")) return {{"if", {{"not", null}}}, {"then", schema}};
    if (schema.contains("anyOf")) schema["anyOf"].push_back(null);
    if (schema.contains("enum")) schema["enum"].push_back(nullptr);
    if (!schema.contains("type")) return schema;
    Schema& type = schema["type"];
    if (!type.is_array()) type = Schema::array({type});
    type.push_back("null");
    return schema;
  }

  static std::string description(const Key& key) {
    std::string facts = key.unit;
    if (const auto range = range_text(key.range); !range.empty()) facts += (facts.empty() ? "" : ", ") + range;
    if (!key.fallback.empty()) facts += (facts.empty() ? "" : ", ") + ("default " + key.fallback);
    return facts.empty() ? key.sentence : fmt::format("{} [{}]", key.sentence, facts);
  }

  Schema of(const ValueSchema& schema, const Key& key) {
    switch (schema.kind) {
      case ValueSchema::Kind::number: return quantity(key);
      case ValueSchema::Kind::integer: return number("integer", key.range);
      case ValueSchema::Kind::boolean: return {{"type", "boolean"}};
      case ValueSchema::Kind::text: return {{"type", {"string", "number", "boolean"}}};
      case ValueSchema::Kind::file: return {{"type", "string"}};
      case ValueSchema::Kind::word: return word(schema);
      case ValueSchema::Kind::list: return list(schema, key);
      case ValueSchema::Kind::named: return named(schema, key);
      case ValueSchema::Kind::section: return define(schema.title, [&] { return section(schema.keys()); });
      case ValueSchema::Kind::choice: return choice(schema, key);
      case ValueSchema::Kind::either: return schema.words == kAnyQuantity ? quantity(key) : either(schema, key);
      case ValueSchema::Kind::anything: break;
    }
    return Schema::object();
  }

  static Schema word(const ValueSchema& schema) {
    if (!schema.behind_name) return {{"enum", schema.names}};
    return {{"type", "string"}, {"pattern", fmt::format(R"(^.+\.({})$)", fmt::join(schema.names, "|"))}};
  }

  static Schema number(const char* type, const Range& range) {
    Schema out = {{"type", type}};
    if (std::isfinite(range.low)) out[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
    if (std::isfinite(range.high)) out[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
    return out;
  }

  Schema quantity(const Key& key) {
    Schema plain = number("number", key.range);
    if (key.unit.empty() && key.schema.words != kAnyQuantity) return plain;
    if (key.unit == "rad") plain = {{"const", 0}};
    const Schema text = define("quantity", []() -> Schema { return {{"type", "string"}, {"pattern", kQuantity}}; });
    return {{"anyOf", {plain, text}}};
  }

  Schema list(const ValueSchema& schema, const Key& key) {
    Schema out = {{"type", "array"}, {"items", of(schema.items.front(), key)}};
    if (schema.count > 0) out["minItems"] = out["maxItems"] = schema.count;
    return out;
  }

  Schema named(const ValueSchema& schema, const Key& key) {
    return {{"type", "object"},
            {"properties", {{"include", include()}}},
            {"additionalProperties", of(schema.items.front(), key)}};
  }

  Schema either(const ValueSchema& schema, const Key& key) {
    Schema all = Schema::array();
    for (const ValueSchema& item : schema.items) all.push_back(of(item, key));
    return {{"anyOf", all}};
  }

  // Conditional on `type`, so that editors complete and check the keys of that type only.
  Schema choice(const ValueSchema& schema, const Key& key) {
    const std::string usual = default_type(key);
    return define(schema.title + (usual.empty() ? "" : "Or" + usual), [&]() -> Schema {
      Schema names = Schema::array(), cases = Schema::array();
      for (const auto& [type, alternative] : schema.alternatives()) {
        names.push_back(type);
        const Schema one =
            define(schema.title + "." + type, [&, &t = type, &a = alternative] { return section(a.keys, t); });
        cases.push_back(
            {{"if", {{"properties", {{"type", {{"const", type}}}}}, {"required", {"type"}}}}, {"then", one}});
        if (type == usual) cases.push_back({{"if", {{"not", {{"required", {"type"}}}}}}, {"then", one}});
      }
      Schema out = {{"type", "object"}};
      if (cases.empty()) return out;  // all types come from plugins
      out["properties"] = {{"type", {{"enum", names}}}};
      out["allOf"] = cases;
      if (usual.empty()) out["anyOf"] = {{{"required", {"type"}}}, {{"required", {"include"}}}};
      return out;
    });
  }

  template <class Make>
  Schema define(const std::string& title, Make&& make) {
    if (started_.insert(title).second) definitions_[title] = make();
    return reference_to(title);
  }

  Schema definitions_ = Schema::object();
  std::set<std::string> started_;  // inserted before the definition: a section may contain itself
};

Schema document(const std::vector<InputKind>& kinds) {
  SchemaWriter writer;
  Schema body;
  if (kinds.size() == 1) {
    body = writer.section(kinds.front().keys);
  } else {  // told apart by a key that only this kind has
    const std::map<std::string, std::string> marks{
        {"comparison", "scenes"}, {"sweep", "quantities"}, {"fit", "experiments"}, {"stability", "cases"}};
    body = writer.section(kinds.front().keys);
    for (const auto& kind : kinds)
      if (const auto mark = marks.find(kind.name); mark != marks.end())
        body = {{"if", {{"required", {mark->second}}}}, {"then", writer.section(kind.keys)}, {"else", body}};
  }
  std::string title = "orthodyn";
  for (const auto& kind : kinds) title += " " + kind.name;
  Schema out = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  out.update(body);
  out["definitions"] = writer.definitions();
  return out;
}

std::vector<InputKind> chosen(const std::string& name) {
  std::vector<std::string> names;
  for (const auto& kind : input_kinds()) {
    if (kind.name == name) return {kind};
    names.push_back(kind.name);
  }
  if (name.empty()) return input_kinds();
  throw ConfigError(fmt::format("no schema '{}'; known: {}", name, join(names)));
}

int print_schema(const SchemaArguments& arguments) {
  fmt::print("{}\n", document(chosen(arguments.kind)).dump(1));
  return 0;
}

void declare(SchemaArguments& arguments, CommandOptions& options) {
  options.value("kind", arguments.kind, "scene, comparison, sweep, fit or stability; default: one schema for all.");
}

const CommandRegistration schema_command(
    {.order = 100,
     .name = "schema",
     .sentence = "Print the JSON Schema of the input, for editors that complete and check YAML.",
     .examples = R"(
  orthodyn schema scene > scene.json)"},
    declare, print_schema);

}  // namespace

}  // namespace orthodyn
