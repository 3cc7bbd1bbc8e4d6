// Sentences about the computed modes that belong to measured ones.
#pragma once

#include <string>
#include <vector>

#include "lib/study/fit/search.h"

namespace orthodyn::study::fit {

// Whether a measured frequency is matched with the computed mode of its number.
bool has_modes_by_order(const Problem& problem);

// Measured frequencies whose computed modes have other numbers, and those whose mode changed during the search.
std::vector<std::string> matched_modes(const Problem& problem, const Search& search);

// Warnings. By shape: a MAC below 0.5, or one that another mode has within 0.1. By order: neighbours whose computed
// frequencies differ by less than their deviations.
std::vector<std::string> doubtful_modes(const Problem& problem, const Evaluation& at);

}  // namespace orthodyn::study::fit
