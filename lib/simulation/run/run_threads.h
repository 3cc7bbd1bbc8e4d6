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
  // `is_shared`: one of several ranks, which has a single thread unless the scene names more.
  explicit RunThreads(const Config& scene, bool is_shared = false);

 private:
  RunThreads(std::optional<int> named, bool is_shared);

  LoopThreads loops_;
  BlasThreadLimit blas_;
};

}  // namespace orthodyn
