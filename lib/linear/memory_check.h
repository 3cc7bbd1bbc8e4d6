// A factor that cannot fit is refused before it is tried: on the way there the machine would swap, or the system would
// end the process without a word.
#pragma once

#include <cstddef>
#include <string>

namespace orthodyn {

// `bytes`: what a factorisation is going to take beside what the process has; `what`: "the Cholesky factor". Throws
// RunError (out_of_memory) with both figures where less is left; `remedy`: "use a coarser mesh".
void require_memory_for_factor(std::size_t bytes, const std::string& what, const std::string& remedy);

}  // namespace orthodyn
