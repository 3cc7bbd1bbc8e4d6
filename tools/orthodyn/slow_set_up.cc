#include "tools/orthodyn/slow_set_up.h"

#include <chrono>

#include "tools/orthodyn/notice.h"

namespace orthodyn {

SlowSetUp::SlowSetUp()
    : waiting_([this] {
        std::unique_lock lock(mutex_);
        if (!ended_.wait_for(lock, std::chrono::seconds(3), [this] { return is_over_; }))
          print_notice(
              "setting up: mesh, matrix, the response to the loads for scales and warnings, and the choice of a method "
              "...\n");
      }) {}

SlowSetUp::~SlowSetUp() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  ended_.notify_one();
  waiting_.join();
}

}  // namespace orthodyn
