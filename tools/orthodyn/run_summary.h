// Summary of a run for the terminal: results on stdout; errors, warnings and how to continue on stderr.
#pragma once

#include <string>

#include "lib/simulation/run/run_result.h"

namespace orthodyn {

// `quiet`: prints only errors, warnings and how to continue.
void print_result(const RunResult& result, bool quiet);

// Prints the estimated time integration error and the mesh error. Precondition: result.motion->error has a value.
void print_estimate(const RunResult& result);

// A number rounded to four digits; other text unchanged.
std::string rounded_number(const std::string& text);

}  // namespace orthodyn
