// The fronts of a comparison across meshes, as a part of its JSON document.
#pragma once

#include "lib/study/compare/comparison_run.h"

namespace orthodyn::study::compare {

// Of each group: the points of its front by their place in `points` of the document, and for each power of ten which
// point reaches it first, in data and in a sentence. `document`: with problems, methods and points.
Json pareto_fronts_json(const ComparisonRun& run, const Json& document);

}  // namespace orthodyn::study::compare
