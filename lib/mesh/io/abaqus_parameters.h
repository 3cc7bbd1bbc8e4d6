// The parameters of Abaqus' keywords: which of them are used, which change nothing that is read, and which would change
// it and are refused.
#pragma once

#include <functional>
#include <string>

#include "lib/mesh/io/abaqus_lines.h"

namespace orthodyn {

// Calls `fail` with a sentence for a parameter that is refused, and for one that a keyword that is read does not have.
// Returns false for keywords that are skipped, which may have any.
bool check_abaqus_parameters(const AbaqusKeyword& keyword, const std::function<void(const std::string&)>& fail);

}  // namespace orthodyn
