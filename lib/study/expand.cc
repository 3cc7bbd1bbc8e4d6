#include "lib/study/expand.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <set>

#include "lib/core/registry.h"
#include "lib/ode/integrator.h"
#include "lib/scene/scene.h"

namespace orthodyn {

namespace {

constexpr const char* kIntegratorPrefix = "integrator.";

bool has_key(const std::string& integrator, const std::string& key) {
  const auto& keys = Registry<IntegratorChoice>::entries().at(integrator).keys;
  return std::any_of(keys.begin(), keys.end(), [&](const Key& k) { return k.name == key; });
}

// "mesh.cells" -> "cells": enough to tell labels apart.
std::string last_step(const std::string& path) {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

struct Variant {
  Assignments set;
  std::string words;  // ", cells [45, 9, 9]"
};

// All combinations of the values of `vary` whose paths `concerns` accepts.
std::vector<Variant> combinations(const Comparison& comparison, const std::function<bool(const std::string&)>& concerns) {
  std::vector<Variant> all{{}};
  for (const auto& [path, values] : comparison.vary) {
    if (!concerns(path)) continue;
    std::vector<Variant> longer;
    for (const auto& variant : all) {
      for (const auto& value : values) {
        longer.push_back(variant);
        longer.back().set.emplace_back(path, value.text);
        longer.back().words += ", " + last_step(path) + " " + value.text;
      }
    }
    all = std::move(longer);
  }
  return all;
}

bool is_of_integrator(const std::string& path) { return path.starts_with(kIntegratorPrefix); }

std::string identifier(const std::string& label) {
  std::string id;
  for (const char c : label) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.') id += c;
    else if (!id.empty() && id.back() != '-') id += '-';
  }
  while (id.ends_with('-')) id.pop_back();
  return id;
}

std::vector<Problem> problems_of(const Comparison& comparison) {
  const auto variants = combinations(comparison, [](const std::string& path) { return !is_of_integrator(path); });
  std::vector<Problem> problems;
  for (const auto& scene : comparison.scenes) {
    for (const auto& variant : variants) {
      Problem problem{"", scene.label + variant.words, scene.file.path, {}};
      problem.id = identifier(problem.label);
      for (const auto& [path, value] : scene.set) problem.set.emplace_back(path, value.text);
      problem.set.insert(problem.set.end(), variant.set.begin(), variant.set.end());
      problems.push_back(std::move(problem));
    }
  }
  return problems;
}

// One method for each kind of control that the integrator has.
void add_methods(const Comparison& comparison, const IntegratorEntry& entry, const Variant& variant,
                 std::vector<Method>& methods) {
  Method method{"", entry.label + variant.words, entry.type,
                Registry<IntegratorChoice>::entries().at(entry.type).sentence, {}, Method::Control::rtol};
  for (const auto& [key, value] : entry.options) method.set.emplace_back(key, value.text);
  for (const auto& [path, value] : variant.set) method.set.emplace_back(last_step(path), value);
  const auto& tolerances = comparison.tolerances;
  const bool adaptive = has_key(entry.type, "rtol") && !tolerances.empty();
  const bool fixed = has_key(entry.type, "step") && !comparison.steps.empty();
  const std::string label = method.label;
  if (adaptive) methods.push_back(method);
  if (fixed) {
    method.control = Method::Control::step;
    if (adaptive) {  // then rtol is of Newton's method alone, which must not limit what the step can reach
      method.label = label + ", fixed step";
      method.set.emplace_back("rtol", number_text(*std::min_element(tolerances.begin(), tolerances.end())));
    }
    methods.push_back(method);
  }
  if (!adaptive && !fixed)
    entry.origin.fail("'" + entry.type + "' takes none of what the comparison gives: " +
                      (has_key(entry.type, "step") ? "add 'steps'" : "add 'tolerances'"));
}

std::vector<Method> methods_of(const Comparison& comparison) {
  std::vector<Method> methods;
  for (const auto& entry : comparison.integrators) {
    // A key that this integrator does not have is not varied for it.
    const auto concerns = [&](const std::string& path) {
      return is_of_integrator(path) && has_key(entry.type, last_step(path));
    };
    for (const auto& variant : combinations(comparison, concerns)) add_methods(comparison, entry, variant, methods);
  }
  for (auto& method : methods) method.id = identifier(method.label);
  return methods;
}

// Keys of the scene's own integrator that the new one has too: scales, limits of the step.
Assignments kept_options(const Config& scene, const std::string& integrator) {
  Assignments kept;
  if (!scene.has("integrator") || !scene.at("integrator").is_map()) return kept;
  const Config own = scene.at("integrator");
  for (const auto& key : own.keys())
    if (key != "type" && key != "rtol" && key != "step" && has_key(integrator, key))
      kept.emplace_back(key, own.at(key).yaml());
  return kept;
}

std::string section(const std::string& type, const Assignments& options) {
  std::string yaml = "{type: " + type;
  std::set<std::string> seen;
  // The last assignment of a key holds.
  for (auto it = options.rbegin(); it != options.rend(); ++it)
    if (seen.insert(it->first).second) yaml += ", " + it->first + ": " + it->second;
  return yaml + "}";
}

// Wrong input shows before anything runs.
void check_point(const Design& design, const Point& point) {
  try {
    point_scene(design, point);
  } catch (const ConfigError& e) {
    throw ConfigError(fmt::format("{}: {}", title(design, point), e.what()));
  }
}

}  // namespace

std::string control_word(Method::Control control) { return control == Method::Control::rtol ? "rtol" : "step"; }

Config scene_config(const Problem& problem, const std::string& integrator, const Assignments& options) {
  Config config = Config::from_file(problem.file);
  for (const auto& [path, value] : problem.set) config.override_with(path + "=" + value);
  Assignments all = kept_options(config, integrator);
  all.insert(all.end(), options.begin(), options.end());
  config.override_with("integrator=" + section(integrator, all));
  for (const char* silent : {"output.fields=[]", "output.energy=false", "output.steps=false", "output.momentum=false",
                             "expect=null"})
    config.override_with(silent);
  read_scene(config);
  return config;
}

Config point_scene(const Design& design, const Point& point) {
  const Method& method = design.methods[point.method];
  Assignments options = method.set;
  options.emplace_back(control_word(method.control), number_text(point.control));
  return scene_config(design.problems[point.problem], method.integrator, options);
}

std::string title(const Design& design, const Point& point) {
  const Method& method = design.methods[point.method];
  return fmt::format("{}, {}, {} {:g}", design.problems[point.problem].label, method.label,
                     control_word(method.control), point.control);
}

Design expand(const Comparison& comparison) {
  Design design{problems_of(comparison), methods_of(comparison), {}};
  std::vector<double> tolerances = comparison.tolerances, steps = comparison.steps;
  std::sort(tolerances.rbegin(), tolerances.rend());
  std::sort(steps.rbegin(), steps.rend());
  for (std::size_t p = 0; p < design.problems.size(); ++p)
    for (std::size_t m = 0; m < design.methods.size(); ++m)
      for (const double control : design.methods[m].control == Method::Control::rtol ? tolerances : steps)
        design.points.push_back({p, m, control});
  for (const auto& point : design.points) check_point(design, point);
  return design;
}

std::string head_comment(const std::string& file) {
  std::ifstream in(file);
  std::string text;
  for (std::string line; std::getline(in, line) && line.starts_with('#');) {
    line.erase(0, line.find_first_not_of("# "));
    if (line.empty()) break;
    text += (text.empty() ? "" : " ") + line;
  }
  return text;
}

}  // namespace orthodyn
