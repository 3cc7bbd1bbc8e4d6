// Earlier results in the result folder.
#include "lib/simulation/output/result_folder.h"

#include "lib/core/errors.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::result_folder_test {
namespace {

class ResultFolders : public InFolder {
 protected:
  ResultFolders() { fs::create_directories(out()); }

  fs::path out() const { return folder_ / "out"; }
  void put(const std::string& name, const std::string& text = "") const { write("out/" + name, text); }
  void put_result(const std::string& status) const { put("run.json", "{\"status\": \"" + status + "\"}"); }

  ResultFolder open(EarlierResult earlier) const {
    return ResultFolder(out(), earlier, [](const std::string& warning) { ADD_FAILURE() << warning; });
  }

  // The message of a rejected folder.
  std::string refusal(EarlierResult earlier) const {
    try {
      open(earlier);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  }

  bool has(const std::string& name) const { return fs::exists(out() / name); }
};

TEST_F(ResultFolders, IsMadeOnlyWhenItIsPrepared) {
  fs::remove(out());
  auto folder = open(EarlierResult::keep);
  EXPECT_FALSE(fs::exists(out()));
  folder.prepare();
  EXPECT_TRUE(fs::is_directory(out()));
}

TEST_F(ResultFolders, ThatCannotBeMadeIsRefusedBeforeAnythingIsWritten) {
  const auto warn = [](const std::string& warning) { ADD_FAILURE() << warning; };
  try {
    ResultFolder("/proc/nope/x", EarlierResult::keep, warn).prepare();
    ADD_FAILURE() << "no error";
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("/proc/nope/x: cannot write there"), std::string::npos) << e.what();
  }
}

TEST_F(ResultFolders, ThatIsAFileIsRefused) {
  fs::remove(out());
  write("out", "text");
  for (const auto earlier : {EarlierResult::keep, EarlierResult::replace, EarlierResult::resume})
    EXPECT_NE(refusal(earlier).find("is a file"), std::string::npos);
}

TEST_F(ResultFolders, WithFilesOfOthersIsRefused) {
  put("thesis.tex");
  for (const auto earlier : {EarlierResult::keep, EarlierResult::replace, EarlierResult::resume})
    EXPECT_NE(refusal(earlier).find("no result of a run"), std::string::npos);
  EXPECT_TRUE(has("thesis.tex"));
}

TEST_F(ResultFolders, WithAnEarlierResultIsRefusedUnlessItIsToBeReplaced) {
  put_result("completed");
  EXPECT_NE(refusal(EarlierResult::keep).find("holds an earlier result"), std::string::npos);
  EXPECT_TRUE(has("run.json"));
  EXPECT_EQ(refusal(EarlierResult::replace), "");
}

TEST_F(ResultFolders, LosesTheEarlierResultWhenItIsPreparedAndNothingElse) {
  put_result("completed");
  put("energy.csv");
  put("notes.txt");
  auto folder = open(EarlierResult::replace);
  EXPECT_TRUE(has("energy.csv"));
  folder.prepare();
  EXPECT_FALSE(has("run.json"));
  EXPECT_FALSE(has("energy.csv"));
  EXPECT_TRUE(has("notes.txt"));
}

TEST_F(ResultFolders, IsForOneRunAtATime) {
  const auto first = open(EarlierResult::keep);
  EXPECT_NE(refusal(EarlierResult::keep).find("another run is at work there"), std::string::npos);
}

TEST_F(ResultFolders, ResumesFromACheckpoint) {
  put_result("running");
  put("checkpoint.cbor");
  const auto folder = open(EarlierResult::resume);
  EXPECT_TRUE(folder.resumes());
  EXPECT_EQ(folder.checkpoint(), out() / "checkpoint.cbor");
  EXPECT_EQ(folder.earlier_status(), "killed");
}

TEST_F(ResultFolders, DoesNotResumeWhatIsToBeReplaced) {
  put_result("interrupted");
  put("checkpoint.cbor");
  const auto folder = open(EarlierResult::replace);
  EXPECT_FALSE(folder.resumes());
  EXPECT_EQ(folder.earlier_status(), "interrupted");
}

TEST_F(ResultFolders, BeginsAnewWhereARunHadJustBegun) {
  put_result("running");
  put("scene.yaml");
  put("run.json.part");
  const auto folder = open(EarlierResult::resume);
  EXPECT_FALSE(folder.resumes());
  EXPECT_FALSE(folder.is_completed_without_checkpoint());
}

TEST_F(ResultFolders, WithAPartOfARecordAloneIsUnused) {
  put("run.json.part");
  EXPECT_FALSE(open(EarlierResult::resume).resumes());
  open(EarlierResult::keep).prepare();
}

TEST_F(ResultFolders, WithoutACheckpointIsCompleteOrCannotBeResumed) {
  put("energy.csv");
  put_result("completed");
  EXPECT_TRUE(open(EarlierResult::resume).is_completed_without_checkpoint());
  for (const char* status : {"failed", "interrupted", "running"}) {
    put_result(status);
    EXPECT_NE(refusal(EarlierResult::resume).find("nothing can be resumed"), std::string::npos) << status;
  }
}

TEST_F(ResultFolders, WithADamagedRecordIsThatOfARunThatWasKilled) {
  for (const char* text : {"", "{\"status\":", "[]", "{\"status\": 3}", "{\"status\": \"coopleted\"}"}) {
    put("run.json", text);
    EXPECT_EQ(open(EarlierResult::replace).earlier_status(), "killed") << text;
  }
}

}  // namespace
}  // namespace orthodyn::result_folder_test
