// Whether a material can be computed with, whoever wrote it: its density is positive, and its stiffness finite,
// symmetric and positive definite.
#pragma once

#include <string>

#include "lib/material/material.h"

namespace orthodyn {

// What is wrong with it, as a sentence; "" if nothing is.
std::string why_inadmissible(const Material& material);

}  // namespace orthodyn
