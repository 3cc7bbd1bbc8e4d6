#include "lib/config/value_schema.h"

#include <cxxabi.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "lib/core/spelling.h"

namespace orthodyn {

namespace {

std::string list_text(const ValueSchema& schema) {
  const std::string item = type_text(schema.items.front());
  if (schema.count == 0) return "list of " + item;
  return item == "number" || item == "integer" ? fmt::format("list of {} {}s", schema.count, item)
                                               : fmt::format("list of {}: {}", schema.count, item);
}

std::string either_text(const ValueSchema& schema) {
  std::vector<std::string> all;
  for (const ValueSchema& one : schema.items) all.push_back(type_text(one));
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

std::string type_text(const ValueSchema& schema) {
  if (!schema.words.empty()) return schema.words;
  switch (schema.kind) {
    case ValueSchema::Kind::number: return "number";
    case ValueSchema::Kind::integer: return "integer";
    case ValueSchema::Kind::boolean: return "true|false";
    case ValueSchema::Kind::text: return "text";
    case ValueSchema::Kind::file: return "file";
    case ValueSchema::Kind::word: return join(schema.names, "|");
    case ValueSchema::Kind::list: return list_text(schema);
    case ValueSchema::Kind::named: return "name: " + type_text(schema.items.front());
    case ValueSchema::Kind::section: return "section";
    case ValueSchema::Kind::choice: return "section with type";
    case ValueSchema::Kind::either: return either_text(schema);
    case ValueSchema::Kind::anything: break;
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
