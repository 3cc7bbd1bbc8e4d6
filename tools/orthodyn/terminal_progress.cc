#include "tools/orthodyn/terminal_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "lib/core/duration.h"
#include "tools/orthodyn/notice.h"

namespace orthodyn {

namespace {

constexpr auto kTerminalPeriod = std::chrono::milliseconds(100);
constexpr auto kPlainPeriod = std::chrono::seconds(5);

}  // namespace

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
    print_notice(fmt::format("\r\x1b[K[{}{}] {}", std::string(filled, '='), std::string(kWidth - filled, ' '), line),
                 out_);
  } else {
    print_notice(line + "\n", out_);
  }
  std::fflush(out_);
  shown_ = true;
}

void TerminalProgress::on_end() noexcept {
  if (terminal_ && shown_) std::fputs("\r\x1b[K", out_);
  std::fflush(out_);
}

}  // namespace orthodyn
