// A word to who waits for a large model that is being set up: nothing else is printed meanwhile.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

namespace orthodyn {

// Prints a line to stderr if it lives longer than some seconds.
class SlowSetUp {
 public:
  SlowSetUp();
  ~SlowSetUp();
  SlowSetUp(const SlowSetUp&) = delete;
  SlowSetUp& operator=(const SlowSetUp&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_over_ = false;
  std::thread waiting_;  // last: it uses the others
};

}  // namespace orthodyn
