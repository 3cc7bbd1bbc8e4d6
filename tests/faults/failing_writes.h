// The program on a disk on which writes fail: orthodyn_failing_writes is `orthodyn` with the system's functions that
// write replaced by those of failing_writes.cc. It and the processes that it starts count their writes together.
#pragma once

#include <sys/mman.h>

#include <atomic>
#include <cstddef>

namespace orthodyn {

// Shared between processes, by the file that ORTHODYN_FAILING_WRITES names.
struct WriteFaults {
  enum class Kind : int {
    none,   // writes are counted
    full,   // from the k-th on nothing that needs room can be written: ENOSPC. What stands there can be replaced.
    broken  // the k-th fails, whatever it writes, and no other: EIO
  };
  Kind kind;
  long k;                     // counted from 1
  std::atomic<long> counted;  // so far
};

}  // namespace orthodyn
