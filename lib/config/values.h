// Converts C++ types from and to YAML. Value<V> has schema(), read() and yaml(); yaml() returns "" for a value that
// means "absent".
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

// The condition under which a key applies: another key of the section, declared before it, has this word.
struct Condition {
  std::string_view key = {}, word = {};
};

// The rules for the value of a key. Texts are views, to keep the code that declares a key small.
struct Rule {
  bool required = false;
  std::string_view unit = {};
  Range range = {};                // of a number, or of each number in a list
  std::string_view fallback = {};  // YAML in place of an absent section, such as "{type: box}"
  Condition with = {};             // if violated, the key is refused and its default is not filled in
};

// Named entries in the order of the file.
template <class V>
using Named = std::vector<std::pair<std::string, V>>;

// The words of an enum: specialise with `static constexpr std::array<std::pair<E, const char*>, N> list`.
template <class E>
struct EnumNames;

template <class V>
struct Value;

// A struct with a Spec of its keys.
template <class V>
concept HasSpec = requires {
  V::spec();
};

// Reads a number in the key's SI unit, or with a unit of the same dimension ("11.9 GPa"). Angles except 0 need a unit.
double read_number(const Config& config, const Rule& rule);
std::string number_text(double x);
std::vector<double> read_numbers(const Config& config, const Rule& rule, std::size_t count);

ValueSchema list_schema(ValueSchema item, std::size_t count = 0, std::string words = "");

// Reads an integer in [low, high] that is also within the rule's range. Throws ConfigError.
long read_integer(const Config& config, const Rule& rule, long low, long high);

template <>
struct Value<double> {
  static ValueSchema schema() { return {.kind = ValueSchema::Kind::number}; }
  static double read(const Config& c, const Rule& r) { return read_number(c, r); }
  static std::string yaml(double x) { return number_text(x); }
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
  static ValueSchema schema() { return {.kind = ValueSchema::Kind::boolean}; }
  static bool read(const Config& c, const Rule&) { return c.boolean(); }
  static std::string yaml(bool x) { return x ? "true" : "false"; }
};

template <>
struct Value<std::string> {
  static ValueSchema schema() { return {.kind = ValueSchema::Kind::text}; }
  static std::string read(const Config& c, const Rule&) { return c.text(); }
  static std::string yaml(const std::string& x) { return x; }
};

// A path in the input, resolved relative to the file that names it.
struct FilePath {
  std::string path;
  std::string where = "";  // place in the input, for messages
};

template <>
struct Value<FilePath> {
  static ValueSchema schema() { return {.kind = ValueSchema::Kind::file}; }
  static FilePath read(const Config& c, const Rule&) { return {c.file_path(), c.where()}; }
  static std::string yaml(const FilePath& x) { return x.path; }
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

// The index of the given word. Throws ConfigError for a word that is not in `words`.
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

// A value, or the word `auto`.
template <class V>
struct AutoOr {
  std::optional<V> value;
};

template <class V>
struct Value<AutoOr<V>> {
  static ValueSchema schema() {
    return {.kind = ValueSchema::Kind::either,
            .items = {Value<V>::schema(), {.kind = ValueSchema::Kind::word, .names = {"auto"}}}};
  }
  static AutoOr<V> read(const Config& c, const Rule& r) {
    if (c.is_scalar() && c.text() == "auto") return {};
    if (const auto hint = c.is_scalar() ? did_you_mean(c.text(), {"auto"}) : ""; !hint.empty())
      c.fail_expected(type_text(schema()), hint);
    return {Value<V>::read(c, r)};
  }
  static std::string yaml(const AutoOr<V>& x) { return x.value ? Value<V>::yaml(*x.value) : "auto"; }
};

template <class V, std::size_t N>
struct Value<std::array<V, N>> {
  static ValueSchema schema() { return list_schema(Value<V>::schema(), N); }
  static std::array<V, N> read(const Config& c, const Rule& r) {
    if (!c.is_sequence() || c.size() != N) c.fail_expected("a list of " + std::to_string(N));
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
    if (!c.is_sequence()) c.fail_expected("a list");
    std::vector<V> out;
    for (std::size_t i = 0; i < c.size(); ++i) out.push_back(Value<V>::read(c.at(i), r));
    return out;
  }
  static std::string yaml(const std::vector<V>& x) {
    if constexpr (HasSpec<V>) return "";  // a list of sections has no default
    std::vector<std::string> parts;
    for (const auto& v : x) parts.push_back(Value<V>::yaml(v));
    return "[" + join(parts) + "]";
  }
};

template <class V>
struct Value<Named<V>> {
  static ValueSchema schema() { return {.kind = ValueSchema::Kind::named, .items = {Value<V>::schema()}}; }
  static Named<V> read(const Config& c, const Rule& r) {
    if (!c.is_map()) c.fail_expected("named sections");
    Named<V> out;
    for (const auto& name : c.keys()) out.emplace_back(name, Value<V>::read(c.at(name), r));
    return out;
  }
  static std::string yaml(const Named<V>&) { return ""; }
};

template <HasSpec V>
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
