// Work in processes: what is done stays done, several at a time, and what dies says how.
#include "lib/study/jobs/errand.h"

#include <chrono>

#include "lib/simulation/files.h"
#include "tests/simulation/command.h"

namespace orthodyn {
namespace {

// A shell script stands in for the program; it finds the errand's folder in $2.
class Errands : public InFolder {
 protected:
  std::string program(const std::string& script) {
    const auto path = folder_ / "program";
    write_file(path, {"#!/bin/sh\ncd $2\n" + script + "\n"});
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path.string();
  }

  std::vector<Errand> errands(int count, double seconds = 30) const {
    std::vector<Errand> all;
    for (int i = 0; i < count; ++i) {
      const std::string name(1, static_cast<char>('a' + i));
      all.push_back({name, "do", folder_ / "errands" / name, "{}", {{"number", i}}, {seconds, 8e9}});
    }
    return all;
  }

  bool run(const std::string& script, const std::vector<Errand>& all, int jobs) {
    results_.assign(all.size(), nullptr);
    started_ = cached_ = 0;
    return carry_out_all(program(script), all, jobs, interrupt_,
                         {[&](std::size_t) { ++started_; },
                          [&](std::size_t i, const Json& result, bool cached) {
                            results_[i] = result;
                            cached_ += cached;
                          }});
  }

  std::atomic<bool> interrupt_{false};
  std::vector<Json> results_;
  int started_ = 0, cached_ = 0;
};

constexpr const char* kCopy = "cp job.json result.json";

TEST_F(Errands, EachGetsItsInputAndLeavesItsResult) {
  for (const int jobs : {1, 3}) {
    std::filesystem::remove_all(folder_ / "errands");
    EXPECT_TRUE(run(kCopy, errands(7), jobs));
    for (int i = 0; i < 7; ++i) EXPECT_EQ(results_[static_cast<std::size_t>(i)].at("number"), i);
    EXPECT_EQ(started_, 7);
  }
}

// Two names for the same work.
TEST_F(Errands, ThoseThatShareAFolderAreDoneOnce) {
  auto all = errands(2);
  all.push_back(all[0]);
  EXPECT_TRUE(run("sleep 0.05; " + std::string(kCopy), all, 3));
  EXPECT_EQ(started_, 2);
  EXPECT_EQ(cached_, 1);
  EXPECT_EQ(results_[2], results_[0]);
}

// Each waits for the mark of the other.
TEST_F(Errands, RunSideBySide) {
  EXPECT_TRUE(run("touch here; until [ -e ../a/here ] && [ -e ../b/here ]; do sleep 0.01; done; " + std::string(kCopy),
                  errands(2, 20), 2));
  for (const auto& result : results_) EXPECT_FALSE(result.contains("reason")) << result;
}

TEST_F(Errands, AreNotDoneTwice) {
  run(kCopy, errands(2), 1);
  EXPECT_TRUE(run(kCopy, errands(3), 2));
  EXPECT_EQ(cached_, 2);
  EXPECT_EQ(started_, 1);
}

TEST_F(Errands, OneThatDiesSaysHowAndIsTriedAgain) {
  EXPECT_TRUE(run("echo out of paper; exit 4", errands(1), 1));
  EXPECT_EQ(results_[0].at("reason"), "crashed");
  EXPECT_NE(results_[0].at("message").get<std::string>().find("4: out of paper"), std::string::npos) << results_[0];
  EXPECT_TRUE(run(kCopy, errands(1), 1));
  EXPECT_EQ(results_[0].at("number"), 0);
}

TEST_F(Errands, OneThatTakesTooLongIsAResult) {
  EXPECT_TRUE(run("sleep 100", errands(1, 0.2), 1));
  EXPECT_EQ(results_[0].at("reason"), "time limit");
  EXPECT_TRUE(run(kCopy, errands(1, 0.2), 1));
  EXPECT_EQ(cached_, 1);
}

TEST_F(Errands, WhatFailedIsTriedAgainWhereThatIsAskedFor) {
  const auto all = errands(2, 0.2);
  EXPECT_TRUE(run("[ $(basename $2) = a ] || sleep 100; " + std::string(kCopy), all, 1));
  EXPECT_EQ(number_at_limits({all[0], all[1], all[1]}), 1u);
  const std::atomic<bool> never{false};
  std::vector<bool> cached;
  EXPECT_TRUE(carry_out_all(program(kCopy), all, 1, never,
                            {[](std::size_t) {}, [&](std::size_t, const Json&, bool c) { cached.push_back(c); }},
                            OldFailures::retry));
  EXPECT_EQ(cached, (std::vector{true, false}));
  EXPECT_EQ(number_at_limits(all), 0u);
}

// One that is still at work when another throws would take its hundred seconds.
TEST_F(Errands, AnErrorEndsThoseInProgress) {
  const auto all = errands(2, 100);
  const auto started = std::chrono::steady_clock::now();
  const std::string script = "if [ $(basename $2) = b ]; then touch here; sleep 100; fi; "
                             "until [ -e ../b/here ]; do sleep 0.01; done; " + std::string(kCopy);
  EXPECT_THROW(carry_out_all(program(script), all, 2, interrupt_,
                             {[](std::size_t) {}, [](std::size_t, const Json&, bool) { throw RunError("no"); }}),
               RunError);
  EXPECT_LT(std::chrono::steady_clock::now() - started, std::chrono::seconds(50));
}

TEST_F(Errands, AnInterruptEndsThoseInProgressAndKeepsTheRest) {
  auto all = errands(3);
  const bool complete = carry_out_all(program("[ $(basename $2) = a ] || sleep 100; " + std::string(kCopy)), all, 1, interrupt_,
                                      {[&](std::size_t i) { interrupt_ = i == 1; }, [](std::size_t, const Json&, bool) {}});
  EXPECT_FALSE(complete);
  EXPECT_FALSE(finished(all[0].folder).is_null());
  EXPECT_TRUE(finished(all[1].folder).is_null());
}

TEST_F(Errands, WhatAnEventThrowsReachesTheCaller) {
  EXPECT_THROW(carry_out_all(program(kCopy), errands(4), 2, interrupt_,
                             {[](std::size_t) { throw RunError("no"); }, [](std::size_t, const Json&, bool) {}}),
               RunError);
}

}  // namespace
}  // namespace orthodyn
