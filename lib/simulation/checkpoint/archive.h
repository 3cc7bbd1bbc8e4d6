// The state that an observer saves in a checkpoint: lists of numbers by name.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace orthodyn {

class Archive {
 public:
  void put(const std::string& name, double value) { values_[name] = {value}; }
  void put(const std::string& name, std::vector<double> values) { values_[name] = std::move(values); }
  void put_count(const std::string& name, std::size_t value) { put(name, static_cast<double>(value)); }

  // Throw ConfigError if the entry is missing, has another length or, for count(), is not a non-negative integer.
  double number(const std::string& name) const { return numbers(name, 1)[0]; }
  std::size_t count(const std::string& name) const;
  const std::vector<double>& numbers(const std::string& name, std::size_t length) const;

  const std::map<std::string, std::vector<double>>& entries() const { return values_; }

 private:
  std::map<std::string, std::vector<double>> values_;
};

}  // namespace orthodyn
