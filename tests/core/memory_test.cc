// The memory that a process may use if control groups (cgroups) limit it.
#include "lib/core/memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <string>

namespace orthodyn::memory_test {
namespace {

namespace fs = std::filesystem;

class Groups : public testing::Test {
 protected:
  Groups() : folder_(fs::path(testing::TempDir()) / ("memory_groups_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
  }
  ~Groups() override { fs::remove_all(folder_); }

  void put(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }
  GroupMemory found(const std::string& groups) const {
    put("cgroup", groups);
    return memory_of_groups(folder_ / "cgroup", folder_);
  }

  fs::path folder_;
};

TEST_F(Groups, WithoutLimitsAreNone) {
  EXPECT_TRUE(std::isinf(found("0::/a/b\n").limit));
  put("a/memory.max", "max\n");
  put("a/memory.current", "5000\n");
  EXPECT_TRUE(std::isinf(found("0::/a/b\n").limit));
  EXPECT_TRUE(std::isinf(found("0::/a/b\n").left));
  EXPECT_TRUE(std::isinf(found("").left));
}

// The usage of a group includes all processes in it, such as eight workers in one container. Inactive file caches
// count as free.
TEST_F(Groups, CountWhatAllTheirProcessesUse) {
  put("a/memory.max", "8000\n");
  put("a/memory.current", "7000\n");
  put("a/memory.stat", "anon 5500\nfile 1500\ninactive_file 1200\nactive_file 300\n");
  EXPECT_EQ(found("0::/a\n").limit, 8000);
  EXPECT_EQ(found("0::/a\n").left, 8000 - (7000 - 1200));
}

TEST_F(Groups, TheOneWithTheLeastCounts) {
  put("memory.max", "9000\n");
  put("memory.current", "8900\n");
  put("a/b/memory.max", "5000\n");
  put("a/b/memory.current", "1000\n");
  EXPECT_EQ(found("0::/a/b/c\n").limit, 5000);
  EXPECT_EQ(found("0::/a/b/c\n").left, 100);
}

TEST_F(Groups, OfVersion1AreRead) {
  put("memory/a/memory.limit_in_bytes", "8000\n");
  put("memory/a/memory.usage_in_bytes", "7000\n");
  put("memory/a/memory.stat", "cache 1500\ntotal_inactive_file 1200\n");
  EXPECT_EQ(found("12:cpu:/x\n7:memory:/a\n").left, 8000 - (7000 - 1200));
}

TEST(Memory, LeftIsNoMoreThanTheLimit) {
  EXPECT_GT(memory_left(), 0);
  EXPECT_GT(memory_limit(), 0);
}

}  // namespace
}  // namespace orthodyn::memory_test
