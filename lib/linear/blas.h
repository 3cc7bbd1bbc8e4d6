// Which BLAS is loaded, and how many threads it uses. All functions may be called by several threads.
#pragma once

#include <optional>
#include <string>

namespace orthodyn {

// Below this number of unknowns a second BLAS thread costs more than it gives.
inline constexpr int kBlasThreadsFrom = 40'000;

// E.g. "OpenBLAS 0.3.21 ...", or "unknown (not OpenBLAS)".
std::string blas_name();
bool blas_is_openblas();
// Then its threads are those of OpenMP, and SerialOpenMp (openmp.h) must not be combined with more than one.
bool blas_uses_openmp();

// While it lives, BLAS uses at most so many threads; afterwards as many as before. The number belongs to the process:
// the smallest limit of all such objects holds. Without effect for std::nullopt, or if the BLAS is not OpenBLAS.
class BlasThreadLimit {
 public:
  explicit BlasThreadLimit(std::optional<int> most);
  ~BlasThreadLimit();
  BlasThreadLimit(const BlasThreadLimit&) = delete;
  BlasThreadLimit& operator=(const BlasThreadLimit&) = delete;

 private:
  std::optional<int> most_;
};

}  // namespace orthodyn
