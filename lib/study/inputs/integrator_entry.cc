#include "lib/study/inputs/integrator_entry.h"

#include <algorithm>
#include <map>
#include <memory>

#include "lib/config/registry.h"
#include "lib/core/spelling.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

namespace {

void require_known_integrator(const Config& c, const std::string& type) {
  const auto names = Registry<IntegratorChoice>::names();
  if (std::find(names.begin(), names.end(), type) != names.end()) return;
  c.fail("unknown integrator '" + type + "'" + did_you_mean(type, names) + " Known: all, " + join(names) + ".");
}

// {type, label, any option of the integrator}
IntegratorEntry read_section(const Config& c) {
  if (!c.has("type")) c.fail("key 'type' is missing: give the integrator's name");
  IntegratorEntry entry{c.at("type").text(), "", {}, {c.where()}, false};
  require_known_integrator(c.at("type"), entry.type);
  entry.label = c.has("label") ? c.at("label").text() : entry.type;
  for (const auto& key : c.keys())
    if (key != "type" && key != "label") entry.options.emplace_back(key, Value<YamlText>::read(c.at(key), {}));
  return entry;
}

// Schemas of the registered integrators: without `rtol` and `step`, which the study varies, and with `label` added.
std::map<std::string, Alternative> sections() {
  std::map<std::string, Alternative> out;
  for (const auto& [name, entry] : Registry<IntegratorChoice>::entries()) {
    Alternative one = entry;
    std::erase_if(one.keys, [](const Key& key) { return key.name == "rtol" || key.name == "step"; });
    one.keys.push_back({"label", Value<std::string>::schema(), "", {}, "", "Name of the method in the report.", false});
    out.emplace(name, one);
  }
  return out;
}

}  // namespace

std::vector<IntegratorEntry> expand_all(const std::vector<IntegratorEntry>& entries) {
  std::vector<IntegratorEntry> out;
  for (const auto& entry : entries) {
    if (entry.type != "all") out.push_back(entry);
    else
      for (const auto& name : Registry<IntegratorChoice>::names()) out.push_back({name, name, {}, entry.origin, true});
  }
  return out;
}

bool has_key(const std::string& integrator, const std::string& key) {
  const auto& keys = Registry<IntegratorChoice>::entries().at(integrator).keys;
  return std::any_of(keys.begin(), keys.end(), [&](const Key& k) { return k.name == key; });
}

ValueSchema Value<IntegratorEntry>::schema() {
  std::vector<std::string> names{"all"};
  for (const auto& name : Registry<IntegratorChoice>::names()) names.push_back(name);
  return {.kind = ValueSchema::Kind::either,
          .items = {{.kind = ValueSchema::Kind::word, .words = "name", .names = names},
                    {.kind = ValueSchema::Kind::choice, .title = "IntegratorEntry", .alternatives = sections}}};
}

IntegratorEntry Value<IntegratorEntry>::read(const Config& c, const Rule&) {
  if (!c.is_map()) {
    if (c.text() != "all") require_known_integrator(c, c.text());
    return {c.text(), c.text(), {}, {c.where()}, false};
  }
  for (const char* control : {"rtol", "step", "safety"})
    if (c.has(control))
      c.at(control).fail("is set by the comparison ('tolerances', 'steps', or the program itself); remove it here");
  return read_section(c);
}

ValueSchema Value<CompleteIntegratorEntry>::schema() {
  return Value<std::shared_ptr<const IntegratorChoice>>::schema();
}

CompleteIntegratorEntry Value<CompleteIntegratorEntry>::read(const Config& c, const Rule&) {
  if (!c.is_map()) c.fail("expected a section with the key 'type', found " + c.shown());
  return {read_section(c)};
}

}  // namespace orthodyn
