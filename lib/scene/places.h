// Input locations of a scene's sections, for errors found when the scene is built.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {

class Places {
 public:
  Places() = default;
  // `sections`: "file:line:column: key" by key. `file`: location of errors without a section.
  Places(std::string file, std::map<std::string, std::string> sections)
      : file_(std::move(file)), sections_(std::move(sections)) {}

  // Adds a location to an error whose place is only a key: the line of that section, or the file if the scene has no
  // such section. `fallback`: key of an error without a place.
  ConfigError placed(const ConfigError& error, const std::string& fallback = "") const {
    const std::string& key = error.place().empty() ? fallback : error.place();
    if (const auto found = sections_.find(key); found != sections_.end())
      return {found->second, error.message(), error.fault()};
    const bool is_key = key.find_first_of(":./ ") == std::string::npos;
    if (file_.empty() || !is_key) return error;
    return {key.empty() ? file_ : file_ + ": " + key, error.message(), error.fault()};
  }

  // Returns work(); adds locations to the ConfigErrors that it throws.
  template <class Work>
  auto with(Work&& work, const std::string& fallback = "") const {
    try {
      return work();
    } catch (const ConfigError& error) {
      throw placed(error, fallback);
    }
  }

 private:
  std::string file_;
  std::map<std::string, std::string> sections_;
};

}  // namespace orthodyn
