#include "tools/orthodyn/whole_numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "lib/core/errors.h"

namespace orthodyn {

std::vector<int> whole_numbers(const std::string& option, const std::string& text, int least, int most) {
  std::vector<int> numbers;
  std::istringstream words(text + ",");
  for (std::string word; std::getline(words, word, ',');) {
    int number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || number < least || number > most)
      throw ConfigError(
          fmt::format("{}: expected whole numbers from {} to {} as in 2,4,8, found '{}'", option, least, most, text));
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace orthodyn
