// The key linear_solver: its names and its check.
#pragma once

#include <string>
#include <vector>

#include "lib/config/config.h"

namespace orthodyn {

// `full`: those that factor the full 2n x 2n system too ("klu_full"), which not every integrator can.
enum class SolverPaths { reduced, all };

std::vector<std::string> linear_solver_names(SolverPaths paths);

// Throws ConfigError at section.linear_solver unless it is one of them.
void require_linear_solver(const std::string& name, SolverPaths paths, const Config& section);

}  // namespace orthodyn
