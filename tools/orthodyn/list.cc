// `orthodyn list`: what an input file can name, by chapters, or every key as a page (docs/reference.md).
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <vector>

#include "lib/core/errors.h"
#include "lib/core/spelling.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/input_tree.h"
#include "tools/orthodyn/list_chapters.h"

namespace orthodyn {

namespace {

struct ListArguments {
  std::string what;  // chapter; all if empty
  bool markdown = false;
};

constexpr const char* kReferenceHead = R"(# Reference: every key of the input

Written by `orthodyn list --markdown` from the declarations that the program reads its input with; a test keeps
this page up to date. Numbers are in SI units; a key with a unit also takes a text such as `"11.9 GPa"`,
`25 mm` or `30 deg`. Any section may take keys from other files with `include: FILE` or a list of files: the
section's own keys take precedence. A key in **bold** is required. `<name>` is a name of your choice, `<n>` an entry
of a list.
)";

// A table cell in Markdown: escapes bars.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
  return text;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + cell(text) + "`"; }

std::string facts(const Key& key) {
  std::string out = cell(type_text(key.schema));
  if (!key.unit.empty()) out += ", " + key.unit;
  if (const auto range = range_text(key.range); !range.empty()) out += ", " + range;
  return out;
}

void print_keys(const std::vector<Key>& keys) {
  if (keys.empty()) return;
  fmt::print("\n| key | value | default | |\n|---|---|---|---|\n");
  for (const Key& key : keys) {
    const std::string name = key.required ? "**" + key.name + "**" : key.name;
    fmt::print("| {} | {} | {} | {} |\n", name, facts(key), code(key.fallback), cell(key.sentence));
  }
}

std::string heading(const InputSection& section) {
  return section.type.empty() ? section.path : section.path + ": {type: " + section.type + "}";
}

bool same(const Key& a, const Key& b) {
  return a.name == b.name && facts(a) == facts(b) && a.fallback == b.fallback && a.sentence == b.sentence;
}

// Those of `keys` that `others` lacks.
std::vector<Key> keys_beside(const std::vector<Key>& keys, const std::vector<Key>& others) {
  std::vector<Key> out;
  for (const Key& key : keys)
    if (std::none_of(others.begin(), others.end(), [&](const Key& other) { return same(key, other); }))
      out.push_back(key);
  return out;
}

// A type that another section has as well: only the keys that differ.
void print_differences(const InputSection& section, const InputSection& described) {
  const auto further = keys_beside(section.keys, described.keys);
  std::vector<std::string> missing;
  for (const Key& key : described.keys)
    if (std::none_of(section.keys.begin(), section.keys.end(), [&](const Key& own) { return own.name == key.name; }))
      missing.push_back("`" + key.name + "`");
  fmt::print("\nAs `{}`{}{}\n", heading(described), missing.empty() ? "" : ", without " + join(missing),
             further.empty() ? "." : ", and:");
  print_keys(further);
}

void print_section(const InputSection& section) {
  fmt::print("\n{}\n", section.sentence);
  for (const auto& [fact, text] : section.facts)
    fmt::print("{}- {}: {}\n", fact == section.facts.front().first ? "\n" : "", fact, text);
  print_keys(section.keys);
}

void print_reference_page() {
  fmt::print("{}", kReferenceHead);
  std::map<std::string, InputSection> described;  // by type and sentence
  for (const auto& kind : input_kinds()) {
    fmt::print("\n## {}{}\n", static_cast<char>(std::toupper(static_cast<unsigned char>(kind.name.front()))),
               kind.name.substr(1));
    for (const auto& section : input_sections(kind)) {
      if (!section.path.empty()) fmt::print("\n### `{}`\n", heading(section));
      const auto [first, is_new] = described.emplace(section.type + ": " + section.sentence, section);
      if (is_new || section.type.empty()) print_section(section);
      else print_differences(section, first->second);
    }
  }
}

int list(const ListArguments& arguments) {
  const std::string& what = arguments.what;
  if (arguments.markdown) {
    if (!what.empty()) throw ConfigError("--markdown prints all chapters; leave out '" + what + "'");
    print_reference_page();
    return 0;
  }
  std::vector<std::string> names;
  bool found = false;
  for (const auto& [name, print] : list_chapters()) {
    names.push_back(name);
    if (!what.empty() && what != name) continue;
    found = true;
    fmt::print("{}:\n", name);
    print();
    fmt::print("\n");
  }
  if (found) return 0;
  throw ConfigError(fmt::format("no chapter '{}'{}; known: {}", what, did_you_mean(what, names), join(names)));
}

void declare(ListArguments& arguments, CommandOptions& options) {
  options.value(
      "what", arguments.what,
      "scene, materials, presets, meshes, axes, integrators, solvers, terms, joints, factors, statics, buckling, "
      "harmonic, events, expect, comparison, sweep, fit, stability, fields or quantities; default: all.");
  options.flag("--markdown", arguments.markdown, "Print every key of the input as one page in Markdown.");
}

const CommandRegistration list_command(
    {.order = 90,
     .name = "list",
     .sentence = "List what an input file can name (materials, integrators, ...), with keys, units and defaults.",
     .examples = R"(
  orthodyn list materials
  orthodyn list --markdown > reference.md)"},
    declare, list);

}  // namespace

}  // namespace orthodyn
