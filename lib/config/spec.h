// Declares the keys of a section. The reader, its checks, the defaults in the resolved scene and the text of
// `orthodyn list` follow from this declaration.
//
//   struct Gravity { Vec3 acceleration{0, 0, -9.81}; static const Spec<Gravity>& spec(); };
//   const Spec<Gravity>& Gravity::spec() {
//     static const auto s = Spec<Gravity>().key("acceleration", &Gravity::acceleration,
//                                               "Acceleration of free fall.", {.unit = "m/s^2"});
//     return s;
//   }
//
// The default of a key is the member's value in a default-constructed T.
#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lib/config/config.h"
#include "lib/config/values.h"

namespace orthodyn {

// The place of a section in the input, for errors found after reading (an empty selection, a surface that the mesh does
// not have). Spec sets it in structs with a member `SourceLocation origin`.
struct SourceLocation {
  std::string where;
  [[noreturn]] void fail(const std::string& message) const { throw ConfigError(where, message); }
};

// The type-erased operations of Value<V>.
struct ValueType {
  ValueSchema (*schema)();
  void (*read)(const Config& config, const Rule& rule, void* target);
  std::string (*yaml)(const void* value);  // "" means "absent"
  bool section;                            // V has keys of its own
};

template <class V>
inline constexpr ValueType kValueType{
    [] { return Value<V>::schema(); },
    [](const Config& config, const Rule& rule, void* target) {
      *static_cast<V*>(target) = Value<V>::read(config, rule);
    },
    [](const void* value) { return std::string(Value<V>::yaml(*static_cast<const V*>(value))); }, HasSpec<V>};

// The part of Spec that does not depend on T. It is compiled once, so that declaring a key takes few instructions.
class Keys {
 public:
  Keys();
  Keys(const Keys&);
  Keys& operator=(const Keys&) = delete;
  ~Keys();

  const std::vector<Key>& keys() const { return keys_; }

 protected:
  using Member = std::function<void*(void* target)>;
  struct Field {
    Key doc;
    std::string fallback, with_key, with_word;  // copies of Rule::fallback and Rule::with, which are views
    const ValueType* type;
    Member member;
  };

  void add(std::string_view name, std::string_view sentence, const Rule& rule, const ValueType& type,
           const void* default_value, Member member);
  // Reads the fields of `target`; returns the section completed by defaults. `also`: further keys that are allowed.
  Config read_fields(const Config& given, void* target, const std::vector<std::string>& also) const;

  std::map<std::string, std::string> former_names_;

 private:
  std::vector<Field> fields_;
  std::vector<Key> keys_;
};

template <class T>
class Spec : public Keys {
 public:
  // Declares a key; the member may belong to a base class of T.
  template <class V, class Owner>
  requires std::derived_from<T, Owner> Spec& key(std::string_view name, V Owner::*member, std::string_view sentence,
                                                 const Rule& rule = {}) {
    add(name, sentence, rule, kValueType<V>, &(defaults().*member),
        [member](void* target) -> void* { return &(static_cast<T*>(target)->*member); });
    return *this;
  }

  // Accepts `former` for `name`, with a warning.
  Spec& rename(std::string_view former, std::string_view name) {
    former_names_.emplace(former, name);
    return *this;
  }

  // Adds a condition on several keys, which calls config.fail() if it is violated.
  Spec& check(std::function<void(const T&, const Config&)> condition) {
    checks_.push_back(std::move(condition));
    return *this;
  }

  // Reads a section. `also`: keys that the caller reads itself ("type").
  void read_into(const Config& given, T& target, const std::vector<std::string>& also = {}) const {
    const Config section = read_fields(given, &target, also);
    if constexpr (requires { target.origin.where; }) target.origin.where = section.where();
    for (const auto& condition : checks_) condition(target, section);
  }

  T read(const Config& section) const {
    T target{};
    read_into(section, target);
    return target;
  }

  // A T with all defaults.
  T by_default() const { return read(Config::from_text("{}", "defaults")); }

 private:
  static const T& defaults() {
    static const T all{};
    return all;
  }

  std::vector<std::function<void(const T&, const Config&)>> checks_;
};

}  // namespace orthodyn
