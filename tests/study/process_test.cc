// Child processes and their limits.
#include "lib/study/jobs/process.h"

#include <atomic>
#include <csignal>
#include <thread>

#include "lib/simulation/output/files.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::process_test {
namespace {

class Process : public InFolder {
 protected:
  ProcessEnd run(const std::string& command, double seconds = 30) {
    return run_process({"/bin/sh", "-c", command}, folder_ / "log", {seconds, 8e9}, stop_);
  }
  std::atomic<bool> interrupt_{false};
  const Stop stop_ = [this] { return interrupt_.load(); };
};

TEST_F(Process, HandsBackTheExitCodeAndTheOutput) {
  EXPECT_EQ(run("echo said; echo so >&2; exit 7").code, 7);
  EXPECT_EQ(read_text(folder_ / "log"), "said\nso\n");
}

TEST_F(Process, TellsASignalFromAnExit) {
  const auto end = run("kill -SEGV $$");
  EXPECT_EQ(end.kind, ProcessEnd::Kind::signalled);
  EXPECT_EQ(end.code, SIGSEGV);
}

TEST_F(Process, IsKilledAfterItsTime) { EXPECT_EQ(run("sleep 100", 0.2).kind, ProcessEnd::Kind::timed_out); }

TEST_F(Process, IsKilledWhenItTakesTooMuchMemory) {
  const auto end = run_process({"/bin/sh", "-c", "x=$(head -c 100000000 /dev/zero | tr '\\0' x); echo $x; sleep 100"},
                               folder_ / "log", {60, 5e7}, stop_);
  EXPECT_EQ(end.kind, ProcessEnd::Kind::out_of_memory);
}

// In its own session, as mpirun's ranks are in their own process groups.
TEST_F(Process, IsKilledWithAllThatItHasStarted) {
  const fs::path child = folder_ / "child";
  std::thread later([&] {
    while (!fs::exists(child)) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    interrupt_ = true;
  });
  EXPECT_EQ(run("setsid sh -c 'echo $$ > " + child.string() + ".new; mv " + child.string() + ".new " + child.string() +
                "; exec sleep 100' & sleep 100")
                .kind,
            ProcessEnd::Kind::interrupted);
  later.join();
  const fs::path process = fs::path("/proc") / std::to_string(std::stoi(read_text(child)));
  const auto is_over = [&] {
    return !fs::exists(process) || read_text(process / "stat").find(") Z ") != std::string::npos;
  };
  for (int k = 0; k < 500 && !is_over(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_TRUE(is_over());
}

TEST_F(Process, WhatItHasStartedCountsAsItsMemory) {
  const auto end = run_process(
      {"/bin/sh", "-c", "setsid sh -c 'x=$(head -c 100000000 /dev/zero | tr \"\\0\" x); echo $x; sleep 100'; true"},
      folder_ / "log", {60, 5e7}, stop_);
  EXPECT_EQ(end.kind, ProcessEnd::Kind::out_of_memory);
}

TEST_F(Process, EndsWhenThereIsAnInterrupt) {
  std::thread later([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    interrupt_ = true;
  });
  EXPECT_EQ(run("sleep 100").kind, ProcessEnd::Kind::interrupted);
  later.join();
}

TEST_F(Process, AMissingProgramIsAnExitCode) {
  EXPECT_EQ(run_process({"/no/such/program"}, folder_ / "log", {10, 8e9}, stop_).code, 127);
}

}  // namespace
}  // namespace orthodyn::process_test
