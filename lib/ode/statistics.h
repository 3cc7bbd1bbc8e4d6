// The cost of an integration: counts and seconds by type of work.
#pragma once

#include <chrono>

namespace orthodyn {

struct Cost {
  long count = 0;
  double seconds = 0;
};

struct Statistics {
  long steps = 0, rejected_steps = 0;  // rejected by the error test or for lack of convergence
  long error_test_failures = 0, convergence_failures = 0;
  long newton_iterations = 0;
  long gauss_newton_fallbacks = 0;  // replacements of an indefinite K by its Gauss-Newton part
  Cost force, tangent, factorization, solve;
  Cost sensitivity = {};  // right-hand sides of sensitivities
  Cost modes = {};        // computation of the modes of a reduced model, including its linear solutions
  Cost observation = {};  // output, events and extremes; counted by the run loop
};

// Adds one call and its duration to a Cost.
class Measure {
 public:
  explicit Measure(Cost& cost) : cost_(cost), start_(Clock::now()) {}
  ~Measure() {
    ++cost_.count;
    cost_.seconds += std::chrono::duration<double>(Clock::now() - start_).count();
  }
  Measure(const Measure&) = delete;
  Measure& operator=(const Measure&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  Cost& cost_;
  Clock::time_point start_;
};

}  // namespace orthodyn
