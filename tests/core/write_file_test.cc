// Files are written completely or not at all, and no other file is touched.
#include "lib/core/write_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include "lib/core/errors.h"

namespace orthodyn::write_file_test {
namespace {

namespace fs = std::filesystem;

class WriteFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) / "write_file" / testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(WriteFile, JoinsPartsAndReplacesWhatWasThere) {
  const fs::path file = folder_ / "deep" / "file";
  write_file(file, {"a", "", "bc"});
  EXPECT_EQ(content(file), "abc");
  write_durable_file(file, {"d"});
  EXPECT_EQ(content(file), "d");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "deep"), fs::directory_iterator()), 1);
}

// The user's links that happen to have the names of temporary files, of this or an earlier version, must stay intact.
TEST_F(WriteFile, LeavesNeighboursOfAnyKindAlone) {
  std::ofstream(folder_ / "precious") << "kept";
  const auto names = [&](unsigned k) { return std::to_string(::getpid()) + "-" + std::to_string(k); };
  for (unsigned k = 0; k < 40; ++k) fs::create_symlink(folder_ / "precious", folder_ / ("file." + names(k) + ".part"));
  fs::create_symlink(folder_ / "precious", folder_ / "file.part");
  const std::size_t before = entries();
  for (const char* text : {"one", "two"}) {
    write_file(folder_ / "file", {text});
    EXPECT_EQ(content(folder_ / "file"), text);
  }
  EXPECT_EQ(content(folder_ / "precious"), "kept");
  EXPECT_TRUE(fs::is_symlink(folder_ / "file.part"));
  EXPECT_EQ(entries(), before + 1);
}

// Limits the size of files. The system then writes the part that fits and reports EFBIG for the rest.
class WithLimitOfSize {
 public:
  explicit WithLimitOfSize(rlim_t bytes) {
    before_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit less{bytes, limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &less);
  }
  ~WithLimitOfSize() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, before_);
  }

 private:
  rlimit limit_{};
  void (*before_)(int) = nullptr;
};

TEST_F(WriteFile, OnlyPartsThatAKilledProcessLeftAreRemoved) {
  fs::create_directories(folder_ / "frames");
  for (const char* name : {"a.csv.123-4.part", "frames/b.vtu.7-1.part", "mine.part", "c.1-2.part.txt"})
    write_file(folder_ / name, {"x"});
  remove_partial_files(folder_);
  EXPECT_FALSE(fs::exists(folder_ / "a.csv.123-4.part"));
  EXPECT_FALSE(fs::exists(folder_ / "frames/b.vtu.7-1.part"));
  EXPECT_TRUE(fs::exists(folder_ / "mine.part"));
  EXPECT_TRUE(fs::exists(folder_ / "c.1-2.part.txt"));
}

TEST_F(WriteFile, AFailureLeavesTheOldFileAndTellsTheReasonOfTheSystem) {
  write_file(folder_ / "file", {"old"});
  const WithLimitOfSize limit(4096);
  try {
    write_file(folder_ / "file", {std::string(10'000, 'x')});
    FAIL();
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("File too large"), std::string::npos) << e.what();
  }
  EXPECT_EQ(content(folder_ / "file"), "old");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WriteFile, AllOfATextOrTheReasonOfTheSystem) {
  const fs::path file = folder_ / "file";
  const int open_file = ::open(file.c_str(), O_WRONLY | O_CREAT, 0666);
  EXPECT_TRUE(write_all(open_file, "abcdef", 0));
  EXPECT_TRUE(write_all(open_file, "XY", 2));
  EXPECT_TRUE(write_all(open_file, "", 2));
  EXPECT_EQ(content(file), "abXYef");
  {
    const WithLimitOfSize limit(4096);
    EXPECT_FALSE(write_all(open_file, std::string(10'000, 'x'), 0));
    EXPECT_EQ(errno, EFBIG);  // after a short write of 4096 bytes
  }
  ::close(open_file);
  EXPECT_EQ(fs::file_size(file), 4096u);
}

}  // namespace
}  // namespace orthodyn::write_file_test
