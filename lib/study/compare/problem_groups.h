// The scenes of a comparison, and which of them share a reference.
#pragma once

#include <string>
#include <vector>

#include "lib/study/compare/comparison_design.h"

namespace orthodyn::study::compare {

// Changes of a scene, and the words that tell them from others: ", cells [45, 9, 9]".
struct Variant {
  Assignments set;
  std::string words;
};

// Sets groups and problems of a design: each scene with each variant. Throws ConfigError for a scene that cannot be
// read.
void add_problems(const Comparison& comparison, const std::vector<Variant>& variants, Design& design);

}  // namespace orthodyn::study::compare
