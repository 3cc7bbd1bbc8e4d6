// A line on the terminal for each piece of a long work that is over, and how long the rest may take.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace orthodyn {

class Teller {
 public:
  // Of what was found done (`cached`) it is known that it takes no time. `count` may change as the work goes on.
  void tell(std::size_t count, const std::string& title, const std::string& outcome, bool cached);

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point began_ = Clock::now();
  std::size_t number_ = 0, worked_ = 0;
};

}  // namespace orthodyn
