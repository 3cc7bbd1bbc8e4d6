// How long the rest of some work may take, by what was done so far.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace orthodyn {

class TimeLeft {
 public:
  // A piece of work begins; pieces may overlap.
  void begin();
  // One has ended, `remaining` are left: "  (3 min left)", or "" if it is not worth a word.
  std::string after_one(std::size_t remaining);

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point began_;
  std::size_t begun_ = 0, done_ = 0;
  double spent_ = 0;
};

}  // namespace orthodyn
