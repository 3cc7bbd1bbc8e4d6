#include "tools/orthodyn/failures.h"

#include <fmt/format.h>

#include <cstdio>

namespace orthodyn {

void Failures::add(const std::string& title, const Json& result) {
  ++count_;
  if (result.at("status") == "completed" || ++failed_ > 1) return;
  first_ = title;
  for (const char* key : {"reason", "message"})
    if (result.contains(key) && result.at(key).is_string()) first_ += ": " + result.at(key).get<std::string>();
}

void Failures::print() const {
  if (failed_ > 0) fmt::print(stderr, "{} of {} points failed; the first, {}\n", failed_, count_, first_);
}

void tell_of_kept_limits(std::size_t count) {
  if (count > 0)
    fmt::print(stderr, "kept from an earlier run: {} that met the limit of time or memory; --retry tries what failed "
                       "again\n", count);
}

}  // namespace orthodyn
