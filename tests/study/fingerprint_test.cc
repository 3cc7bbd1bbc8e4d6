// What figures depend on besides their input.
#include "lib/study/fingerprint.h"

#include <cstdlib>
#include <functional>

#include "tests/run/command.h"

namespace orthodyn {
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

}  // namespace
}  // namespace orthodyn
