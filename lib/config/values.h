// How each type of value is read from and written to YAML: Value<V>::schema(), read(), yaml().
// yaml() of a default that means "absent" is empty.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <typeinfo>
#include <utility>
#include <vector>

#include "lib/config/config.h"
#include "lib/config/value_schema.h"
#include "lib/core/spelling.h"
#include "lib/core/types.h"

namespace orthodyn {

inline constexpr Range kPositive{0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr Range kNonNegative{0, std::numeric_limits<double>::infinity(), false, false};

// Where a key means something: only if another one of the section, read before it, has this word.
struct Condition {
  std::string_view key = {}, word = {};
};

// What holds for a key's value. Views, so that declaring a key is little code.
struct Rule {
  bool required = false;
  std::string_view unit = {};
  Range range = {};                // of a number, and of each number of a list
  std::string_view fallback = {};  // YAML that stands for an absent section, such as "{type: box}"
  Condition with = {};             // elsewhere it is refused, and its default not filled in
};

// Named entries in the order of the file.
template <class V>
using Named = std::vector<std::pair<std::string, V>>;

// The words of an enum: specialise with `static constexpr std::array<std::pair<E, const char*>, N> list`.
template <class E>
struct EnumNames;

template <class V>
struct Value;

// A plain number in the key's SI unit, or a text with a unit of the same dimension ("11.9 GPa"). An angle other than 0
// must have a unit.
double read_number(const Config& config, const Rule& rule);
std::string number_text(double x);
std::vector<double> read_numbers(const Config& config, const Rule& rule, std::size_t count);

ValueSchema list_schema(ValueSchema item, std::size_t count = 0, std::string words = "");

// An integral number within both bounds and the rule's range. Throws ConfigError.
long read_integer(const Config& config, const Rule& rule, long low, long high);

template <>
struct Value<double> {
  static ValueSchema schema();
  static double read(const Config& c, const Rule& r);
  static std::string yaml(double x);
};

template <std::integral V>
struct Value<V> {
  static ValueSchema schema() { return {.kind = ValueSchema::Kind::integer}; }
  static V read(const Config& c, const Rule& r) {
    constexpr auto kLargest = std::min<std::uintmax_t>(std::numeric_limits<V>::max(), std::numeric_limits<long>::max());
    return static_cast<V>(read_integer(c, r, std::numeric_limits<V>::min(), static_cast<long>(kLargest)));
  }
  static std::string yaml(V x) { return std::to_string(x); }
};

template <>
struct Value<bool> {
  static ValueSchema schema();
  static bool read(const Config& c, const Rule&);
  static std::string yaml(bool x);
};

template <>
struct Value<std::string> {
  static ValueSchema schema();
  static std::string read(const Config& c, const Rule&);
  static std::string yaml(const std::string& x);
};

// A path in the input, made relative to the file that names it.
struct FilePath {
  std::string path;
  std::string where = "";  // in the input, for messages
};

template <>
struct Value<FilePath> {
  static ValueSchema schema();
  static FilePath read(const Config& c, const Rule&);
  static std::string yaml(const FilePath& x);
};

template <>
struct Value<Vec3> {
  static ValueSchema schema();
  static Vec3 read(const Config& c, const Rule& r);
  static std::string yaml(const Vec3& x);
};

template <>
struct Value<Mat3> {
  static ValueSchema schema();
  static Mat3 read(const Config& c, const Rule& r);
  static std::string yaml(const Mat3& m);
};

// Which of the words stands there. Throws ConfigError for another one.
std::size_t index_of_word(const Config& config, const std::vector<std::string>& words);

template <class E>
requires std::is_enum_v<E>
struct Value<E> {
  static std::vector<std::string> words() {
    std::vector<std::string> out;
    for (const auto& [value, word] : EnumNames<E>::list) out.emplace_back(word);
    return out;
  }
  static ValueSchema schema() { return {.kind = ValueSchema::Kind::word, .names = words()}; }
  static E read(const Config& c, const Rule&) { return EnumNames<E>::list[index_of_word(c, words())].first; }
  static std::string yaml(E x) {
    for (const auto& [value, word] : EnumNames<E>::list)
      if (value == x) return word;
    return "";
  }
};

template <class V>
struct Value<std::optional<V>> {
  static ValueSchema schema() { return Value<V>::schema(); }
  static std::optional<V> read(const Config& c, const Rule& r) { return Value<V>::read(c, r); }
  static std::string yaml(const std::optional<V>& x) { return x ? Value<V>::yaml(*x) : ""; }
};

template <class V, std::size_t N>
struct Value<std::array<V, N>> {
  static ValueSchema schema() { return list_schema(Value<V>::schema(), N); }
  static std::array<V, N> read(const Config& c, const Rule& r) {
    if (!c.is_sequence() || c.size() != N)
      c.fail("expected a list of " + std::to_string(N) + ", found " + c.shown(), InputFault::form);
    std::array<V, N> out;
    for (std::size_t i = 0; i < N; ++i) out[i] = Value<V>::read(c.at(i), r);
    return out;
  }
  static std::string yaml(const std::array<V, N>& x) {
    std::vector<std::string> parts;
    for (const auto& v : x) parts.push_back(Value<V>::yaml(v));
    return "[" + join(parts) + "]";
  }
};

template <class V>
struct Value<std::vector<V>> {
  static ValueSchema schema() { return list_schema(Value<V>::schema()); }
  static std::vector<V> read(const Config& c, const Rule& r) {
    if (!c.is_sequence()) c.fail("expected a list, found " + c.shown(), InputFault::form);
    std::vector<V> out;
    for (std::size_t i = 0; i < c.size(); ++i) out.push_back(Value<V>::read(c.at(i), r));
    return out;
  }
  static std::string yaml(const std::vector<V>& x) {
    if constexpr (requires { V::spec(); }) return "";  // a list of sections has no default
    std::vector<std::string> parts;
    for (const auto& v : x) parts.push_back(Value<V>::yaml(v));
    return "[" + join(parts) + "]";
  }
};

template <class V>
struct Value<Named<V>> {
  static ValueSchema schema() { return {.kind = ValueSchema::Kind::named, .items = {Value<V>::schema()}}; }
  static Named<V> read(const Config& c, const Rule& r) {
    if (!c.is_map()) c.fail("expected named sections, found " + c.shown(), InputFault::form);
    Named<V> out;
    for (const auto& name : c.keys()) out.emplace_back(name, Value<V>::read(c.at(name), r));
    return out;
  }
  static std::string yaml(const Named<V>&) { return ""; }
};

// A struct that declares its keys.
template <class V>
requires requires { V::spec(); }
struct Value<V> {
  static ValueSchema schema() {
    return {.kind = ValueSchema::Kind::section, .title = type_title(typeid(V).name()), .keys = [] {
              return V::spec().keys();
            }};
  }
  static V read(const Config& c, const Rule&) { return V::spec().read(c); }
  static std::string yaml(const V&) { return ""; }
};

}  // namespace orthodyn
