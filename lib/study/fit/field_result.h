// What a fit says about a field of stiffness factors.
#pragma once

#include <string>
#include <vector>

#include "lib/study/fit/result.h"

namespace orthodyn::study::fit {

// Grid, box, and for each cell its factor with its 95 % interval.
Json field_json(const Problem& problem, const Result& result, const ParameterField& field);

// Columns i, j, k (numbers of the cell from 1), x, y, z of its middle (m), factor, low, high. A scene reads the file by
// `stiffness_factors: {grid: [...], file: FILE}`.
std::string field_csv(const Json& field);

// The range of the factors, the place of the smallest, and how well the data determine them.
std::string field_sentence(const Result& result, const ParameterField& field);

// Reasons to distrust the factors.
std::vector<std::string> field_warnings(const Result& result, const ParameterField& field);

}  // namespace orthodyn::study::fit
