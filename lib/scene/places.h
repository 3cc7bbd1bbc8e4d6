// Where the sections of a scene stand in the input: what is found out when a scene is built has no line of its own.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {

class Places {
 public:
  Places() = default;
  // `sections`: "file:line:column: key" by key; `file`: for what no section has.
  Places(std::string file, std::map<std::string, std::string> sections)
      : file_(std::move(file)), sections_(std::move(sections)) {}

  // With the section's line where the place is no more than its key, which `otherwise` is where there is none; the file
  // alone where the scene has no such section.
  ConfigError placed(const ConfigError& error, const std::string& otherwise = "") const {
    const std::string& key = error.place().empty() ? otherwise : error.place();
    if (const auto found = sections_.find(key); found != sections_.end())
      return {found->second, error.message(), error.fault()};
    const bool is_key = key.find_first_of(":./ ") == std::string::npos;
    if (file_.empty() || !is_key) return error;
    return {key.empty() ? file_ : file_ + ": " + key, error.message(), error.fault()};
  }

  // work(), whose ConfigErrors are placed.
  template <class Work>
  auto with(Work&& work, const std::string& otherwise = "") const {
    try {
      return work();
    } catch (const ConfigError& error) {
      throw placed(error, otherwise);
    }
  }

 private:
  std::string file_;
  std::map<std::string, std::string> sections_;
};

}  // namespace orthodyn
