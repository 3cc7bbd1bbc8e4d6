// Fingerprints of what results depend on besides their input.
#include <chrono>
#include <cstdlib>
#include <functional>

#include "lib/core/errors.h"
#include "lib/simulation/run/fingerprints.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::fingerprint_test {
namespace {

class PluginFingerprint : public InFolder {
 protected:
  ~PluginFingerprint() override { unsetenv("ORTHODYN_PLUGINS"); }
};

TEST_F(PluginFingerprint, TheCodeIsAnotherWithPluginsAndWhenOneOfThemChanges) {
  const std::string without = code_fingerprint();
  const std::string one = write("one.so", "1").string(), two = write("two.so", "2").string();
  setenv("ORTHODYN_PLUGINS", (one + ":" + two).c_str(), 1);
  const std::string with = code_fingerprint();
  EXPECT_NE(with, without);
  write("two.so", "3");
  EXPECT_NE(code_fingerprint(), with);
  write("two.so", "2");
  EXPECT_EQ(code_fingerprint(), with);
}

TEST_F(PluginFingerprint, APluginThatTheLoaderFindsByItselfCountsByItsName) {
  const std::string without = code_fingerprint();
  setenv("ORTHODYN_PLUGINS", "libsomewhere.so", 1);
  EXPECT_NE(code_fingerprint(), without);
}

class FilesFingerprint : public InFolder {};

TEST_F(FilesFingerprint, AFileIsReadAgainOnlyWhenItHasChanged) {
  FileFingerprints files;
  const auto file = write("mesh", "one");
  const std::string one = files.of(file);
  EXPECT_EQ(one, Fingerprint().add_file(file).text());
  const auto changed = fs::last_write_time(file);
  write("mesh", "two");
  fs::last_write_time(file, changed);  // as long as it looks the same
  EXPECT_EQ(files.of(file), one);
  fs::last_write_time(file, changed + std::chrono::seconds(1));
  EXPECT_NE(files.of(file), one);
  write("mesh", "three");
  fs::last_write_time(file, changed + std::chrono::seconds(1));
  EXPECT_EQ(files.of(file), Fingerprint().add_file(file).text());
  fs::remove(file);
  EXPECT_THROW(files.of(file), RunError);
}

}  // namespace
}  // namespace orthodyn::fingerprint_test
