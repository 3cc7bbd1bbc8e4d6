// Processes side by side.
#pragma once

#include <cstdlib>
#include <thread>

namespace orthodyn {

// As many as were asked for, or one a processor.
inline int number_of_jobs(int asked) {
  return asked > 0 ? asked : static_cast<int>(std::thread::hardware_concurrency());
}

// Processes that share the processors must not each start a thread of BLAS for every one of them.
inline void use_one_thread_each() {
  for (const char* variable : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) setenv(variable, "1", 0);
}

}  // namespace orthodyn
