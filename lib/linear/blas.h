// Which BLAS is loaded, and how many threads it uses.
#pragma once

#include <string>

namespace orthodyn {

// Below this number of unknowns a second BLAS thread costs more than it gives.
inline constexpr int kBlasThreadsFrom = 15'000;

// E.g. "OpenBLAS 0.3.21 ...", or "unknown (not OpenBLAS)".
std::string blas_name();
bool blas_is_openblas();
void set_blas_threads(int threads);  // without effect if not OpenBLAS

}  // namespace orthodyn
