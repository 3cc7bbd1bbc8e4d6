// Finds typing errors in YAML that a parser misses or reports at another place: a colon without a blank after it, a
// wrong indentation, an unclosed bracket.
#pragma once

#include <string>
#include <vector>

#include "lib/config/yaml_document.h"

namespace orthodyn {

// A hint, "; put a space after 'end:'", for a text such as "end:0.1" where a section is expected; "" for other texts.
std::string missing_space(const std::string& text);

// Throws ConfigError if it finds a typing error in the line where the parser stopped or in the one before.
void refuse_typo_near(const std::string& text, const std::string& file, const YAML::Mark& mark);

// Throws ConfigError with the place of an unclosed bracket before `mark`, if there is one.
void refuse_open_bracket(const std::string& text, const std::string& file, const YAML::Mark& mark);

// True if a key and the start of its value lack a blank between them: "end:0.1" or "clamps:[{surface".
bool is_key_with_value(const YAML::Node& key, const YAML::Node& value);

// A hint for a key that another program uses but a section with the keys `known` lacks: "; a damping ratio ... is
// stiffness: ..."; "" if there is no hint.
std::string hint_for_foreign_key(const std::string& name, const std::vector<std::string>& known);

}  // namespace orthodyn
