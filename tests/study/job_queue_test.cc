// Job queues: results are kept, several jobs run at a time, and failures are reported.
#include "lib/study/jobs/job_queue.h"

#include <fstream>

#include "lib/simulation/output/files.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::study::job_queue_test {
namespace {

// A shell script replaces the program; the job's folder is $2.
class Jobs : public InFolder {
 protected:
  std::string program(const std::string& script) {
    const auto path = folder_ / "program";
    write_file(path, {"#!/bin/sh\ncd $2\n" + script + "\n"});
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path.string();
  }

  std::vector<Job> jobs(int count, double seconds = 30) const {
    std::vector<Job> all;
    for (int i = 0; i < count; ++i) {
      const std::string name(1, static_cast<char>('a' + i));
      all.push_back({name, "do", folder_ / "jobs" / name, "{}", with_fingerprint({{"number", i}}), {seconds, 8e9}});
    }
    return all;
  }

  JobQueue queue(const std::string& script, int workers, OldFailures failures = OldFailures::keep) {
    return {{{program(script)}, workers, failures, [](const std::string&) {}}, interrupt_};
  }

  bool run(const std::string& script, const std::vector<Job>& all, int workers,
           OldFailures failures = OldFailures::keep) {
    results_.assign(all.size(), nullptr);
    cached_.assign(all.size(), false);
    started_ = 0;
    return queue(script, workers, failures)
        .run(all, {[&](std::size_t) { ++started_; },
                   [&](std::size_t i, const Json& result, bool cached) {
                     results_[i] = result;
                     cached_[i] = cached;
                   }});
  }

  // A result of an earlier run.
  static void leave(const Job& job, const std::string& result) {
    std::filesystem::create_directories(job.folder);
    std::ofstream(job.folder / kResultFile) << result;
  }

  std::atomic<bool> interrupt_{false};
  std::vector<Json> results_;
  std::vector<bool> cached_;
  int started_ = 0;
};

constexpr const char* kCopy = "cp job.json result.json";

TEST_F(Jobs, EachGetsItsInputAndLeavesItsResult) {
  for (const int workers : {1, 3}) {
    std::filesystem::remove_all(folder_ / "jobs");
    EXPECT_TRUE(run(kCopy, jobs(7), workers));
    for (int i = 0; i < 7; ++i) EXPECT_EQ(results_[static_cast<std::size_t>(i)].at("number"), i);
    EXPECT_EQ(started_, 7);
  }
}

// Two jobs with the same folder.
TEST_F(Jobs, ThoseThatShareAFolderAreDoneOnce) {
  auto all = jobs(2);
  all.push_back(all[0]);
  EXPECT_TRUE(run("sleep 0.05; " + std::string(kCopy), all, 3));
  EXPECT_EQ(started_, 2);
  EXPECT_EQ(cached_[0] + cached_[2], 1);
  EXPECT_EQ(results_[2], results_[0]);
}

// Each job waits for a file written by the other.
TEST_F(Jobs, RunSideBySide) {
  EXPECT_TRUE(run("touch here; until [ -e ../a/here ] && [ -e ../b/here ]; do sleep 0.01; done; " + std::string(kCopy),
                  jobs(2, 20), 2));
  for (const auto& result : results_) EXPECT_FALSE(result.contains("reason")) << result;
}

TEST_F(Jobs, AreNotDoneTwice) {
  run(kCopy, jobs(2), 1);
  EXPECT_TRUE(run(kCopy, jobs(3), 2));
  EXPECT_EQ(cached_, (std::vector{true, true, false}));
  EXPECT_EQ(started_, 1);
}

TEST_F(Jobs, OneThatDiesSaysHowAndIsTriedAgain) {
  EXPECT_TRUE(run("echo out of paper; exit 4", jobs(1), 1));
  EXPECT_EQ(results_[0].at("reason"), "crashed");
  EXPECT_NE(results_[0].at("message").get<std::string>().find("4: out of paper"), std::string::npos) << results_[0];
  EXPECT_TRUE(run(kCopy, jobs(1), 1));
  EXPECT_EQ(results_[0].at("number"), 0);
}

TEST_F(Jobs, OneThatTakesTooLongIsAResult) {
  EXPECT_TRUE(run("sleep 100", jobs(1, 0.2), 1));
  EXPECT_EQ(results_[0].at("reason"), "time limit");
  EXPECT_TRUE(run(kCopy, jobs(1, 0.2), 1));
  EXPECT_TRUE(cached_[0]);
}

TEST_F(Jobs, WhatFailedIsTriedAgainWhereThatIsAskedFor) {
  const auto all = jobs(2, 1);
  EXPECT_TRUE(run("[ $(basename $2) = a ] || sleep 100; " + std::string(kCopy), all, 1));
  EXPECT_EQ(number_at_limits({all[0], all[1], all[1]}), 1u);
  EXPECT_TRUE(run(kCopy, all, 1, OldFailures::retry));
  EXPECT_EQ(cached_, (std::vector{true, false}));
  EXPECT_EQ(number_at_limits(all), 0u);
}

// A refusal is final unless failures are retried. A crash is never final, and a truncated file is not a result.
TEST_F(Jobs, WhichResultsAreFinal) {
  const Job job = jobs(1)[0];
  const auto is_final = [&](OldFailures failures) { return !finished_result(job, failures).is_null(); };
  EXPECT_FALSE(is_final(OldFailures::keep));
  for (const char* damaged : {"{}", R"({"status": "compl)", R"({"status": "completed"})", "[]", ""}) {
    leave(job, damaged);
    EXPECT_FALSE(is_final(OldFailures::keep)) << damaged;
  }
  write_result(job.folder, {{"status", "completed"}});
  EXPECT_TRUE(is_final(OldFailures::keep));
  EXPECT_TRUE(is_final(OldFailures::retry));
  write_result(job.folder, to_json(Failure{"refused", "no"}));
  EXPECT_TRUE(is_final(OldFailures::keep));
  EXPECT_FALSE(is_final(OldFailures::retry));
  write_result(job.folder, to_json(Failure{"crashed", "no"}));
  EXPECT_FALSE(is_final(OldFailures::keep));
  EXPECT_FALSE(is_final(OldFailures::retry));
}

TEST_F(Jobs, AResultWithAFlippedBitIsDoneAgain) {
  const Job job = jobs(1)[0];
  write_result(job.folder, {{"status", "completed"}, {"error", 0.0152}});
  const std::string whole = read_text(job.folder / kResultFile);
  for (std::size_t at = 0; at + 1 < whole.size(); ++at) {  // but for the end of the line
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 2);
    leave(job, flipped);
    EXPECT_TRUE(finished_result(job).is_null()) << flipped;
  }
}

TEST_F(Jobs, AResultWhoseOtherFilesAreNotWholeIsDoneAgain) {
  auto all = jobs(1);
  EXPECT_TRUE(run(kCopy, all, 1));
  all[0].is_whole = [](const Json& result) { return result.at("number") != 0; };
  EXPECT_TRUE(run(kCopy, all, 1));
  EXPECT_EQ(started_, 1);
  all[0].is_whole = [](const Json& result) { return result.at("number") == 0; };
  EXPECT_TRUE(run(kCopy, all, 1));
  EXPECT_EQ(started_, 0);
}

TEST_F(Jobs, OneWorkerTakesThemInTheirOrderAndAStageEndsBeforeTheNextBegins) {
  const auto all = jobs(4);
  std::vector<std::string> order;
  const JobQueue one = queue(kCopy, 1);
  const auto run_stage = [&](const std::vector<Job>& stage) {
    return one.run(stage, {[&](std::size_t i) { order.push_back("begin " + stage[i].title); },
                           [&](std::size_t i, const Json&, bool) { order.push_back("end " + stage[i].title); }});
  };
  EXPECT_TRUE(run_stage({all[2]}));
  EXPECT_TRUE(run_stage({all[1], all[0]}));
  EXPECT_EQ(order, (std::vector<std::string>{"begin c", "end c", "begin b", "end b", "begin a", "end a"}));
}

// Without an interrupt the other job would write its result after a hundred seconds.
TEST_F(Jobs, AnErrorEndsThoseInProgress) {
  const auto all = jobs(2, 100);
  const std::string script =
      "if [ $(basename $2) = b ]; then touch here; sleep 100; fi; until [ -e ../b/here ]; do sleep 0.01; done; " +
      std::string(kCopy);
  EXPECT_THROW(queue(script, 2).run(all, {.ends = [](std::size_t, const Json&, bool) { throw RunError("no"); }}),
               RunError);
  EXPECT_TRUE(finished_result(all[1]).is_null());
}

TEST_F(Jobs, AnInterruptEndsThoseInProgressAndKeepsTheRest) {
  const auto all = jobs(3);
  const bool complete =
      queue("[ $(basename $2) = a ] || sleep 100; " + std::string(kCopy), 1)
          .run(all, {[&](std::size_t i) { interrupt_ = i == 1; }, [](std::size_t, const Json&, bool) {}});
  EXPECT_FALSE(complete);
  EXPECT_FALSE(finished_result(all[0]).is_null());
  EXPECT_TRUE(finished_result(all[1]).is_null());
}

TEST_F(Jobs, WhatAnEventThrowsReachesTheCaller) {
  EXPECT_THROW(
      queue(kCopy, 2).run(jobs(4), {[](std::size_t) { throw RunError("no"); }, [](std::size_t, const Json&, bool) {}}),
      RunError);
}

}  // namespace
}  // namespace orthodyn::study::job_queue_test
