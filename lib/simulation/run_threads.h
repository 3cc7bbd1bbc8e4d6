// The threads of a run: as many as its scene names, else as many as the machine has.
#pragma once

#include "lib/config/config.h"
#include "lib/core/parallel.h"
#include "lib/linear/blas.h"

namespace orthodyn {

// While it lives, loops over elements that this thread begins run on so many threads; BLAS keeps to a number that the
// scene names, and otherwise to its own.
class RunThreads {
 public:
  // Of a scene before it is read: its set-up, with equilibria and static responses, is part of the run. Throws
  // ConfigError.
  explicit RunThreads(const Config& scene);

 private:
  explicit RunThreads(std::optional<int> named);

  LoopThreads loops_;
  BlasThreadLimit blas_;
};

}  // namespace orthodyn
