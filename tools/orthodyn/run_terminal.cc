#include "tools/orthodyn/run_terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <system_error>
#include <thread>

#include "lib/core/number_format.h"
#include "lib/simulation/output/observer.h"
#include "tools/orthodyn/print_nothrow.h"
#include "tools/orthodyn/run_summary.h"

namespace orthodyn {

namespace {

constexpr auto kTerminalPeriod = std::chrono::milliseconds(100);
constexpr auto kPlainPeriod = std::chrono::seconds(5);

// Shows a run's progress: on a terminal a line that is rewritten, else a new line every 5 s.
class TerminalProgress : public Observer {
 public:
  TerminalProgress(double start, double end, std::FILE* out);
  void on_resume(const ObservedState& observed) override { from_ = observed.t(); }
  void on_step(const StepInfo& info, const ObservedState&, const Integrator&) override;
  void on_end() noexcept override;

 private:
  using Clock = std::chrono::steady_clock;
  void show(const StepInfo& info, double elapsed);

  double start_, end_, from_;  // s: start and end of the run, and where this process started
  std::FILE* out_;
  bool terminal_, shown_ = false;
  Clock::time_point begin_, last_;
};

TerminalProgress::TerminalProgress(double start, double end, std::FILE* out)
    : start_(start),
      end_(end),
      from_(start),
      out_(out),
      terminal_(isatty(fileno(out)) != 0),
      begin_(Clock::now()),
      last_(begin_) {}

void TerminalProgress::on_step(const StepInfo& info, const ObservedState&, const Integrator&) {
  const auto now = Clock::now();
  if (terminal_ ? now - last_ < kTerminalPeriod : now - last_ < kPlainPeriod) return;
  last_ = now;
  show(info, std::chrono::duration<double>(now - begin_).count());
}

void TerminalProgress::show(const StepInfo& info, double elapsed) {
  const double done = std::clamp((info.t - start_) / (end_ - start_), 0.0, 1.0);
  const std::string left = info.t > from_ ? duration_text(elapsed * (end_ - info.t) / (info.t - from_)) : "?";
  const std::string line = fmt::format("{:3.0f} %  t = {:.4g} of {:.4g} s  h = {:.2e} s  order {}  {} left", 100 * done,
                                       info.t, end_, info.h, info.order, left);
  if (terminal_) {
    constexpr int kWidth = 24;
    const auto filled = static_cast<std::size_t>(kWidth * done);
    print_nothrow(fmt::format("\r\x1b[K[{}{}] {}", std::string(filled, '='), std::string(kWidth - filled, ' '), line),
                  out_);
  } else {
    print_nothrow(line + "\n", out_);
  }
  std::fflush(out_);
  shown_ = true;
}

void TerminalProgress::on_end() noexcept {
  if (terminal_ && shown_) std::fputs("\r\x1b[K", out_);
  std::fflush(out_);
}

}  // namespace

// Prints a line to stderr if the set-up takes longer than 3 s.
class RunTerminal::SlowSetUpNotice {
 public:
  SlowSetUpNotice();
  ~SlowSetUpNotice();
  SlowSetUpNotice(const SlowSetUpNotice&) = delete;
  SlowSetUpNotice& operator=(const SlowSetUpNotice&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_over_ = false;
  std::thread waiting_;  // declared last, because the thread uses the other members
};

RunTerminal::SlowSetUpNotice::SlowSetUpNotice()
    : waiting_([this] {
        std::unique_lock lock(mutex_);
        if (!ended_.wait_for(lock, std::chrono::seconds(3), [this] { return is_over_; }))
          print_nothrow(
              "setting up: mesh, matrix, the response to the loads for scales and warnings, and the choice of a method "
              "...\n");
      }) {}

RunTerminal::SlowSetUpNotice::~SlowSetUpNotice() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  ended_.notify_one();
  waiting_.join();
}

RunTerminal::RunTerminal(bool quiet) : quiet_(quiet) {
  if (!quiet) slow_set_up_ = std::make_unique<SlowSetUpNotice>();
}

RunTerminal::~RunTerminal() = default;

void RunTerminal::on_warning(const std::string& text) { print_nothrow("warning: " + text + "\n"); }

void RunTerminal::on_notice(const std::string& text) {
  if (!quiet_) print_nothrow(text + "\n");
}

std::unique_ptr<Observer> RunTerminal::on_begin(const Setup& setup) {
  slow_set_up_.reset();
  if (quiet_ || setup.scene.is_static()) return nullptr;
  return std::make_unique<TerminalProgress>(setup.scene.time.start, setup.scene.time.end, stderr);
}

// A closed stdout does not stop the error estimate that may follow; main.cc reports the failed output.
void RunTerminal::on_result(const RunResult& result) {
  try {
    print_result(result, quiet_);
  } catch (const std::system_error&) {
  }
}

}  // namespace orthodyn
