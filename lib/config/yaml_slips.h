// Slips of typing that a YAML parser blames on another place, or does not see: a colon without a space behind it, an
// indentation that fits no line, a bracket that nothing closes.
#pragma once

#include <string>
#include <vector>

#include "lib/config/yaml_document.h"

namespace orthodyn {

// "; put a space after 'end:'" of a plain text such as "end:0.1" that stands where keys belong; "" for others.
std::string missing_space(const std::string& text);

// What may be meant where the parser stopped at a mark: throws ConfigError with the line at fault, that of the mark or
// the one before it. Returns where nothing is found.
void refuse_slip_near(const std::string& text, const std::string& file, const YAML::Mark& mark);

// The parser stops in the line after a bracket that nothing closes: throws ConfigError with the bracket's place.
// Returns where the mark lies before it, or there is none.
void refuse_open_bracket(const std::string& text, const std::string& file, const YAML::Mark& mark);

// A key such as "end:0.1" or "clamps:[{surface", which can only be a key and the beginning of its value.
bool is_key_with_value(const YAML::Node& key, const YAML::Node& value);

// Of keys that other programs have: "; a damping ratio ... is stiffness: ..." for an unknown key of a section with the
// keys `known`; "" where nothing is known of it.
std::string hint_for_foreign_key(const std::string& name, const std::vector<std::string>& known);

}  // namespace orthodyn
