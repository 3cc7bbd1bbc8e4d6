// The loaded BLAS library, and limits on the threads of BLAS and OpenMP. Thread-safe.
#pragma once

#include <optional>
#include <string>

namespace orthodyn {

// Below this number of unknowns a second BLAS thread costs more time than it saves.
inline constexpr int kBlasThreadsFrom = 40'000;

// E.g. "OpenBLAS 0.3.21 ...", or "unknown (not OpenBLAS)".
std::string blas_name();
bool blas_is_openblas();
// If true, SerialOpenMp must not be combined with more than one BLAS thread.
bool blas_uses_openmp();

// Limits the number of BLAS threads during its lifetime. The limit is global to the process: the smallest limit of all
// such objects holds. No effect for std::nullopt, or if the BLAS is not OpenBLAS.
class BlasThreadLimit {
 public:
  explicit BlasThreadLimit(std::optional<int> most);
  ~BlasThreadLimit();
  BlasThreadLimit(const BlasThreadLimit&) = delete;
  BlasThreadLimit& operator=(const BlasThreadLimit&) = delete;

 private:
  std::optional<int> most_;
};

// Makes OpenMP loops started by this thread serial during its lifetime (with libgomp before version 11, loops of all
// threads). No effect if no OpenMP is loaded.
//
// CHOLMOD's supernodal factorisation requests four threads in each loop, however many cores the machine has. For 13,500
// unknowns on two cores it then takes 106 ms, but 51 ms with serial loops.
class SerialOpenMp {
 public:
  SerialOpenMp();
  ~SerialOpenMp();
  SerialOpenMp(const SerialOpenMp&) = delete;
  SerialOpenMp& operator=(const SerialOpenMp&) = delete;

 private:
  int levels_ = 0;  // nested parallel levels allowed before
};

}  // namespace orthodyn
