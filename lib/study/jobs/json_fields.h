// A struct as a JSON object and as CSV columns, from one list of its members:
//
//   template <>
//   const JsonFields<Drift> json_fields<Drift>{{"energy", &Drift::energy, {"energy"}}, ...};
//
// A double that is not finite is written as null, and anything but a number is read as NaN. Reading throws
// Json::out_of_range if a key is missing that is always written.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "lib/study/jobs/json_values.h"

namespace orthodyn::study {

template <class T>
class JsonFields;

// The list of T's members. Specialise for every struct that is written as JSON.
template <class T>
extern const JsonFields<T> json_fields;

// Heading of a member in a CSV table: "wall.median [s]" is {"wall"} above {"median", "s"}. A member without a heading
// has no column; one with an empty heading adds no word to the headings of its own members.
struct CsvHeading {
  const char* words = nullptr;
  const char* unit = "";
};

// One column: its heading and the path of its value in the object.
struct CsvColumn {
  std::string words, unit;
  std::vector<std::string> path;
  std::string title() const { return csv_heading(words, unit); }
};

// Returns the names of the entries of the object at `key` (probes, quantities).
using NamesBelow = std::function<std::vector<std::string>(const std::string& key)>;

// The column of a member, seen from the object that holds the member at `key`.
CsvColumn below(const std::string& key, const CsvHeading& heading, CsvColumn column);

// Treatment of empty members. `unspecified` leaves out an optional member without a value; `null` writes it as null;
// `omitted` leaves out any member that is "", false or without entries.
enum class Empty { unspecified, null, omitted };

// Converts a value to JSON and back, and lists the CSV columns that it fills. The primary template is for structs.
template <class T>
struct JsonValue {
  static Json to(const T& x) { return json_fields<T>.write(x); }
  static T from(const Json& json) { return json_fields<T>.read(json); }
  static std::vector<CsvColumn> columns(const std::string&, const NamesBelow& names) {
    return json_fields<T>.columns(names);
  }
};

struct JsonScalar {
  static std::vector<CsvColumn> columns(const std::string&, const NamesBelow&) { return {{}}; }
};

template <class T>
requires std::is_integral_v<T> || std::is_same_v<T, std::string>
struct JsonValue<T> : JsonScalar {
  static Json to(const T& x) { return x; }
  static T from(const Json& json) { return json.get<T>(); }
};

template <>
struct JsonValue<double> : JsonScalar {
  static Json to(double x) { return finite_or_null(x); }
  static double from(const Json& json) { return number_or_nan(json); }
};

template <class T>
requires std::is_enum_v<T>
struct JsonValue<T> : JsonScalar {
  static Json to(T x) { return Value<T>::yaml(x); }
  static T from(const Json& json) { return from_word<T>(json); }
};

template <>
struct JsonValue<Statistics> {
  static Json to(const Statistics& statistics) { return orthodyn::to_json(statistics); }
  static Statistics from(const Json& json) { return statistics_from(json); }
  static std::vector<CsvColumn> columns(const std::string&, const NamesBelow&);
};

template <class T>
struct JsonValue<std::optional<T>> {
  static Json to(const std::optional<T>& x) { return x ? JsonValue<T>::to(*x) : Json(); }
  static std::optional<T> from(const Json& json) {
    return json.is_null() ? std::nullopt : std::optional<T>(JsonValue<T>::from(json));
  }
  static std::vector<CsvColumn> columns(const std::string& key, const NamesBelow& names) {
    return JsonValue<T>::columns(key, names);
  }
};

template <class T>
struct JsonValue<std::vector<T>> {
  static Json to(const std::vector<T>& list) {
    Json out = Json::array();
    for (const auto& x : list) out.push_back(JsonValue<T>::to(x));
    return out;
  }
  static std::vector<T> from(const Json& json) {
    std::vector<T> out;
    for (const auto& x : json) out.push_back(JsonValue<T>::from(x));
    return out;
  }
  static std::vector<CsvColumn> columns(const std::string&, const NamesBelow&) { return {}; }
};

template <class T>
struct JsonValue<std::vector<std::pair<std::string, T>>> {  // Named<T>
  static Json to(const Named<T>& entries) {
    Json out = Json::object();
    for (const auto& [name, x] : entries) out[name] = JsonValue<T>::to(x);
    return out;
  }
  static Named<T> from(const Json& json) {
    Named<T> out;
    for (const auto& [name, x] : json.items()) out.emplace_back(name, JsonValue<T>::from(x));
    return out;
  }
  static std::vector<CsvColumn> columns(const std::string& key, const NamesBelow& names) {
    std::vector<CsvColumn> out;
    for (const auto& name : names(key))
      for (auto& column : JsonValue<T>::columns("", names))
        out.push_back(below(name, {name.c_str()}, std::move(column)));
    return out;
  }
};

template <class T>
class JsonFields {
 public:
  class Field {
   public:
    template <class V>
    Field(const char* name, V T::*member, CsvHeading column_heading = {}, Empty empty = Empty::unspecified)
        : key(name), heading(column_heading), columns(&JsonValue<V>::columns) {
      using Inner = std::remove_cvref_t<decltype(inner(std::declval<const V&>()))>;
      const bool is_optional = !std::is_same_v<V, Inner>;
      required = empty == Empty::unspecified && !is_optional;
      if (empty == Empty::omitted || (is_optional && empty != Empty::null)) {
        write = [=](const T& object, Json& json) {
          if (has_any(object.*member)) json[name] = JsonValue<Inner>::to(inner(object.*member));
        };
        read = [=](const Json& json, T& object) { object.*member = JsonValue<Inner>::from(json); };
      } else {
        write = [=](const T& object, Json& json) { json[name] = JsonValue<V>::to(object.*member); };
        read = [=](const Json& json, T& object) { object.*member = JsonValue<V>::from(json); };
      }
    }
    template <class V>
    Field(const char* name, V T::*member, Empty empty) : Field(name, member, CsvHeading{}, empty) {}

    std::string key;
    CsvHeading heading;
    std::function<void(const T&, Json&)> write;
    std::function<void(const Json&, T&)> read;
    std::vector<CsvColumn> (*columns)(const std::string& key, const NamesBelow& names);
    bool required = true;

   private:
    template <class V>
    static const V& inner(const V& x) {
      return x;
    }
    template <class V>
    static const V& inner(const std::optional<V>& x) {
      return *x;
    }
    template <class V>
    static bool has_any(const V& x) {
      if constexpr (requires { x.has_value(); }) return x.has_value();
      else if constexpr (requires { x.empty(); }) return !x.empty();
      else if constexpr (std::is_same_v<V, bool>) return x;
      else return true;
    }
  };

  JsonFields(std::initializer_list<Field> fields) : fields_(fields) {}
  void add(Field field) { fields_.push_back(std::move(field)); }

  void write(const T& object, Json& json) const {
    for (const auto& field : fields_) field.write(object, json);
  }
  Json write(const T& object) const {
    Json json = Json::object();
    write(object, json);
    return json;
  }
  void read(const Json& json, T& object) const {
    for (const auto& field : fields_)
      if (field.required || json.contains(field.key)) field.read(json.at(field.key), object);
  }
  // As read(), but a missing key leaves the member as it is.
  void read_present(const Json& json, T& object) const {
    for (const auto& field : fields_)
      if (json.contains(field.key)) field.read(json.at(field.key), object);
  }
  T read(const Json& json) const {
    T object;
    read(json, object);
    return object;
  }

  std::vector<std::string> keys() const {
    std::vector<std::string> out;
    for (const auto& field : fields_) out.push_back(field.key);
    return out;
  }
  std::vector<CsvColumn> columns(const NamesBelow& names) const {
    std::vector<CsvColumn> out;
    for (const auto& field : fields_)
      if (field.heading.words)
        for (auto& column : field.columns(field.key, names))
          out.push_back(below(field.key, field.heading, std::move(column)));
    return out;
  }

 private:
  std::vector<Field> fields_;
};

// The heading line, and the line with the values of an object; both without a line break.
std::string csv_head(const std::vector<CsvColumn>& columns);
std::string csv_row(const std::vector<CsvColumn>& columns, const Json& object);

}  // namespace orthodyn::study
