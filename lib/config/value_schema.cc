#include "lib/config/value_schema.h"

#include <cxxabi.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "lib/core/spelling.h"

namespace orthodyn {

namespace {

std::string list_text(const Shape& shape) {
  const std::string item = type_text(shape.items.front());
  if (shape.count == 0) return "list of " + item;
  return item == "number" || item == "integer" ? fmt::format("list of {} {}s", shape.count, item)
                                               : fmt::format("list of {}: {}", shape.count, item);
}

std::string either_text(const Shape& shape) {
  std::vector<std::string> all;
  for (const Shape& one : shape.items) all.push_back(type_text(one));
  return join(all, ", or ");
}

}  // namespace

std::string range_text(const Range& r) {
  const bool low = std::isfinite(r.low), high = std::isfinite(r.high);
  if (low && high) return fmt::format("in {}{}, {}{}", r.low_open ? '(' : '[', r.low, r.high, r.high_open ? ')' : ']');
  if (low) return fmt::format("{} {}", r.low_open ? ">" : ">=", r.low);
  if (high) return fmt::format("{} {}", r.high_open ? "<" : "<=", r.high);
  return "";
}

std::string type_text(const Shape& shape) {
  if (!shape.words.empty()) return shape.words;
  switch (shape.kind) {
    case Shape::Kind::number: return "number";
    case Shape::Kind::integer: return "integer";
    case Shape::Kind::boolean: return "true|false";
    case Shape::Kind::text: return "text";
    case Shape::Kind::file: return "file";
    case Shape::Kind::word: return join(shape.names, "|");
    case Shape::Kind::list: return list_text(shape);
    case Shape::Kind::named: return "name: " + type_text(shape.items.front());
    case Shape::Kind::section: return "section";
    case Shape::Kind::choice: return "section with type";
    case Shape::Kind::either: return either_text(shape);
    case Shape::Kind::anything: break;
  }
  return "any value";
}

std::string type_title(const char* mangled) {
  char* demangled = abi::__cxa_demangle(mangled, nullptr, nullptr, nullptr);
  std::string name = demangled ? demangled : mangled;
  std::free(demangled);
  const auto colon = name.rfind("::");
  return colon == std::string::npos ? name : name.substr(colon + 2);
}

}  // namespace orthodyn
