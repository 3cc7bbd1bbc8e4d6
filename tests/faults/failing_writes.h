// Faults of writes: orthodyn_failing_writes is `orthodyn` with the C library's functions that write replaced by those
// of failing_writes.cc. The program and the processes that it starts count their writes together.
#pragma once

#include <sys/mman.h>

#include <atomic>
#include <cstddef>

namespace orthodyn {

// Shared between processes in the file that ORTHODYN_FAILING_WRITES names.
struct WriteFaults {
  enum class Kind : int {
    none,    // writes are counted
    full,    // ENOSPC for every write from the k-th on that needs space; existing bytes can be replaced
    broken,  // EIO for the k-th write only
    killed   // SIGKILL before the k-th write
  };
  Kind kind;
  long k;                     // counted from 1
  std::atomic<long> counted;  // so far
};

}  // namespace orthodyn
