#include "lib/simulation/checkpoint/archive.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

// Counts are stored as doubles, which represent integers exactly up to 2^53.
constexpr double kLargestCount = 9007199254740992;

}  // namespace

std::size_t Archive::count(const std::string& name) const {
  const double value = number(name);
  if (!(value >= 0 && value <= kLargestCount) || value != std::floor(value))
    throw ConfigError(fmt::format("checkpoint: '{}' is {}, which is not a count", name, value));
  return static_cast<std::size_t>(value);
}

const std::vector<double>& Archive::numbers(const std::string& name, std::size_t length) const {
  const auto found = values_.find(name);
  if (found == values_.end()) throw ConfigError(fmt::format("checkpoint: '{}' is missing", name));
  if (found->second.size() != length)
    throw ConfigError(fmt::format("checkpoint: '{}' has {} numbers, expected {}", name, found->second.size(), length));
  return found->second;
}

}  // namespace orthodyn
