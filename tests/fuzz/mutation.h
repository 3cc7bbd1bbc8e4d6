// Seeded changes of input files: of their bytes, and of YAML as a tree. One sequence for one seed on every machine.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace orthodyn {

// One to four changes of bytes: to any byte, to one that means something, or cut off.
std::string with_mutated_bytes(std::string text, std::mt19937& random);

// One to three changes of the tree: values at the edge of what is allowed and beyond, values from elsewhere, keys and
// subtrees that are lost, doubled, renamed, exchanged, wrapped or nested deeply. `words` are values and keys of other
// files, to be put in. What is not YAML gets its bytes changed.
std::string with_mutated_tree(const std::string& yaml, const std::vector<std::string>& words, std::mt19937& random);

// Every key and scalar of a YAML text, for `words`; none if it is not YAML.
std::vector<std::string> words_of(const std::string& yaml);

}  // namespace orthodyn
