#include "lib/simulation/checkpoint/checkpointer.h"

#include <algorithm>

#include "lib/simulation/run/run.h"

namespace orthodyn {

namespace {

// Least ratio of the time between checkpoints to the time to write one, so that writing takes at most a tenth of the
// run.
constexpr double kRest = 10;
constexpr double kBetweenRemembered = 1;  // least time between states kept in memory, s

double seconds_between(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

}  // namespace

Checkpointer::Checkpointer(std::filesystem::path path, Checkpoint begin, CheckpointTimes times, NamedObservers others,
                           const FemModel& model, const Integrator& integrator)
    : path_(std::move(path)),
      checkpoint_(std::move(begin)),
      before_(checkpoint_.cost),
      times_(times),
      others_(std::move(others)),
      model_(model),
      integrator_(integrator) {
  start_clock();
}

void Checkpointer::start_clock() {
  begin_ = written_ = Clock::now();
  begin_cpu_ = cpu_seconds_now();
}

void Checkpointer::on_start(const ObservedState& observed) {
  start_clock();
  checkpoint_.begun = true;
  checkpoint_.last_output = checkpoint_.last_history = observed.t();
  if (!times_.never) write(observed.state());
}

void Checkpointer::on_resume(const ObservedState&) { start_clock(); }

void Checkpointer::on_output(const ObservedState& observed) {
  checkpoint_.last_output = observed.t();
  ++outputs_;
}

void Checkpointer::on_history(const ObservedState& observed) { checkpoint_.last_history = observed.t(); }

void Checkpointer::on_step(const StepInfo&, const ObservedState& observed, const Integrator&) {
  if (times_.never) return remember_periodically(observed.state());
  const double since = seconds_between(written_, Clock::now());
  const bool enough_outputs = times_.frames > 0 && outputs_ >= times_.frames;
  const bool is_due = enough_outputs || since >= std::max(times_.every, kRest * write_seconds_);
  if (for_all_ranks(is_due)) write(observed.state());
}

// The first rank decides, because the clocks of ranks differ.
bool Checkpointer::for_all_ranks(bool decision) const {
  return model_.ranks() ? model_.ranks()->broadcast_flag(decision) : decision;
}

void Checkpointer::capture(const State& state) {
  checkpoint_.state = model_.whole(state);
  checkpoint_.cost = cost();
  for (const auto& [name, observer] : others_) {
    Archive archive;
    observer->save(archive);
    checkpoint_.observers[name] = std::move(archive);
  }
}

void Checkpointer::write(const State& state) {
  const auto begin = Clock::now();
  capture(state);
  checkpoint_.save(path_);
  outputs_ = 0;
  written_ = Clock::now();
  write_seconds_ = seconds_between(begin, written_);
}

// The interval is longer on a slow disk, because capture() syncs the files of the observers.
void Checkpointer::remember_periodically(const State& state) {
  const auto begin = Clock::now();
  const bool is_recent =
      remembered_ && seconds_between(written_, begin) < std::max(kBetweenRemembered, kRest * write_seconds_);
  if (for_all_ranks(is_recent)) return;
  capture(state);
  remembered_ = checkpoint_;
  written_ = Clock::now();
  write_seconds_ = seconds_between(begin, written_);
}

bool Checkpointer::write_remembered() {
  if (remembered_) remembered_->save(path_);
  return remembered_.has_value();
}

TotalCost Checkpointer::cost() const {
  return before_ +
         TotalCost{integrator_.statistics(), seconds_between(begin_, Clock::now()), cpu_seconds_now() - begin_cpu_};
}

}  // namespace orthodyn
