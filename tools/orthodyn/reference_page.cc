#include "tools/orthodyn/reference_page.h"

#include <fmt/format.h>

#include "tools/orthodyn/input_tree.h"

namespace orthodyn {

namespace {

constexpr const char* kReferenceHead = R"(# Reference: every key of the input

Written by `orthodyn list --markdown` from the declarations that the program reads its input with; a test keeps
this page up to date. Numbers are in SI units; a key with a unit also takes a text such as `"11.9 GPa"`,
`25 mm` or `30 deg`. Any section may take keys from other files with `include: FILE` or a list of files: the
section's own keys take precedence. A key in **bold** is required. `<name>` is a name of your choice, `<n>` an entry
of a list.
)";

// A bar would end the cell.
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

void print_section(const InputSection& section) {
  if (!section.path.empty())
    fmt::print("\n### `{}{}`\n", section.path, section.type.empty() ? "" : ": {type: " + section.type + "}");
  fmt::print("\n{}\n", section.sentence);
  for (const auto& [fact, text] : section.facts)
    fmt::print("{}- {}: {}\n", fact == section.facts.front().first ? "\n" : "", fact, text);
  if (section.keys.empty()) return;
  fmt::print("\n| key | value | default | |\n|---|---|---|---|\n");
  for (const Key& key : section.keys) {
    const std::string name = key.required ? "**" + key.name + "**" : key.name;
    fmt::print("| {} | {} | {} | {} |\n", name, facts(key), code(key.fallback), cell(key.sentence));
  }
}

}  // namespace

void print_reference_page() {
  fmt::print("{}", kReferenceHead);
  for (const auto& kind : input_kinds()) {
    fmt::print("\n## {}{}\n", static_cast<char>(std::toupper(static_cast<unsigned char>(kind.name.front()))),
               kind.name.substr(1));
    for (const auto& section : input_sections(kind)) print_section(section);
  }
}

}  // namespace orthodyn
