#include "lib/simulation/run/outcome.h"

#include <chrono>
#include <ctime>
#include <new>

#include "lib/core/parallel.h"

namespace orthodyn {

const char* status_word(Outcome::Status status) {
  switch (status) {
    case Outcome::Status::completed: return "completed";
    case Outcome::Status::interrupted: return "interrupted";
    case Outcome::Status::failed: return "failed";
  }
  return "";
}

// If loops use one thread, so does BLAS (RunThreads), and this thread does all the work. Its time leaves out other runs
// in the same process.
double cpu_seconds_now() {
  timespec now{};
  clock_gettime(loop_threads() == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

namespace {

void fail(Outcome& outcome, const std::string& message, Reason reason) {
  outcome.status = Outcome::Status::failed;
  outcome.message = message;
  outcome.reason = reason;
}

}  // namespace

Outcome supervise(const State& initial, const std::vector<Observer*>& observers,
                  const std::function<void(Outcome&)>& work) {
  Outcome outcome;
  outcome.last = initial;
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds_now();
  try {
    work(outcome);
  } catch (const std::bad_alloc&) {
    fail(outcome, "out of memory; use a coarser mesh or another linear solver", Reason::out_of_memory);
  } catch (const ConfigError& e) {  // a formula without a value
    fail(outcome, e.what(), Reason::force);
  } catch (const RunError& e) {
    fail(outcome, e.what(), e.reason());
  } catch (const std::exception& e) {
    fail(outcome, e.what(), Reason::other);
  }
  for (auto* o : observers) o->on_end();
  outcome.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  outcome.cpu_seconds = cpu_seconds_now() - cpu;
  return outcome;
}

}  // namespace orthodyn
