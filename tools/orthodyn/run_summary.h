// What a run did, for the terminal: a table on stdout, what went wrong and what remains to be done on stderr.
#pragma once

#include "lib/simulation/run/run_result.h"

namespace orthodyn {

// `quiet`: only what went wrong and what remains.
void print_result(const RunResult& result, bool quiet);

// The estimate of the run's error, as a table, in a sentence, and beside the mesh's. Precondition: there is one.
void print_estimate(const RunResult& result);

}  // namespace orthodyn
