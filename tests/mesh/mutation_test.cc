// Two thousand damaged files: each loads or is refused with its name, nothing else happens.
#include <gtest/gtest.h>

#include <cstddef>
#include <exception>
#include <random>
#include <string>

#include "lib/core/errors.h"
#include "lib/mesh/gmsh.h"
#include "tests/mesh/gmsh_test_file.h"

namespace orthodyn {
namespace {

// One to four changes of bytes: to any byte, to one that means something, or cut off.
std::string mutated(std::string text, std::mt19937& random) {
  const std::string meaningful = "0123456789-+.eE$ \n\r\t\"";
  for (std::size_t changes = 1 + random() % 4; changes > 0 && !text.empty(); --changes) {
    const std::size_t at = random() % text.size();
    switch (random() % 6) {
      case 0:
        text[at] = static_cast<char>(random() % 256);
        break;
      case 1:
        text[at] = meaningful[random() % meaningful.size()];
        break;
      case 2:
        text.insert(at, 1, meaningful[random() % meaningful.size()]);
        break;
      case 3:
        text.erase(at, 1 + random() % 8);
        break;
      case 4:
        text.insert(at, text.substr(random() % text.size(), random() % 40));
        break;
      default:
        if (random() % 4 == 0) text.resize(at);
    }
  }
  return text;
}

TEST(Gmsh, LoadsOrRefusesAnyMutationOfAFile) {
  std::mt19937 random(20240229);  // its sequence is fixed by the standard
  int loaded = 0;
  const TemporaryFile file("");
  for (int i = 0; i < 2000; ++i) {
    const std::string content = mutated(i % 2 == 0 ? kFile22 : kFile41, random);
    file.write(content);
    try {
      read_gmsh(file.path());
      ++loaded;
    } catch (const ConfigError& error) {
      const std::string start = file.path() + ":";
      EXPECT_EQ(std::string(error.what()).substr(0, start.size()), start) << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << "mutation " << i << ": " << error.what() << "\n" << content;
    }
  }
  EXPECT_GT(loaded, 0);
  EXPECT_LT(loaded, 2000);
}

}  // namespace
}  // namespace orthodyn
