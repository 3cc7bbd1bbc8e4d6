// Random mutations of input files, of their bytes or of their YAML tree. A seed gives the same sequence on every
// machine.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace orthodyn {

// Makes one to four changes: replaces, inserts, erases or copies bytes, or truncates the text.
std::string with_mutated_bytes(std::string text, std::mt19937& random);

// Makes one to three changes of the tree: inserts values at or beyond limits, or values from other places; removes,
// doubles, renames, exchanges, wraps or deeply nests keys and subtrees. `words` are keys and values of other files to
// insert. A text that is not YAML gets with_mutated_bytes() instead.
std::string with_mutated_tree(const std::string& yaml, const std::vector<std::string>& words, std::mt19937& random);

// All keys and scalars of a YAML text, for `words`; empty if the text is not YAML.
std::vector<std::string> words_of(const std::string& yaml);

}  // namespace orthodyn
