// Which BLAS is loaded, and how many threads it uses. All functions may be called by several threads.
#pragma once

#include <string>

namespace orthodyn {

// Below this number of unknowns a second BLAS thread costs more than it gives.
inline constexpr int kBlasThreadsFrom = 15'000;

// E.g. "OpenBLAS 0.3.21 ...", or "unknown (not OpenBLAS)".
std::string blas_name();
bool blas_is_openblas();

// No more than these from here on; without effect if the BLAS is not OpenBLAS.
void limit_blas_threads(int most);

// One BLAS thread while it lives, if `one` is set; then as many as before. The number belongs to the process: where
// several threads of ours hold such objects, it is one until the last has gone. Without effect if the BLAS is not
// OpenBLAS. Thread-safe.
class OneBlasThread {
 public:
  explicit OneBlasThread(bool one);
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  bool held_;
};

}  // namespace orthodyn
