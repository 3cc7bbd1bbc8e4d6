// One declaration per key of the input: from it come the reader, its checks, the defaults of the
// resolved scene and the text of `orthodyn list`.
//
//   struct Gravity { Vec3 acceleration{0, 0, -9.81}; static const Spec<Gravity>& spec(); };
//   const Spec<Gravity>& Gravity::spec() {
//     static const auto s = Spec<Gravity>().key("acceleration", &Gravity::acceleration,
//                                               "Acceleration of free fall.", {.unit = "m/s^2"});
//     return s;
//   }
//
// The default of a key is what a default-constructed T holds: it stands in one place.
#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/config.h"
#include "lib/config/values.h"
#include "lib/core/words.h"

namespace orthodyn {

// Where a part of the input stands, for errors that show only later (an empty selection, a surface that the mesh does
// not have). A struct with a member `Origin origin` gets it from its Spec.
struct Origin {
  std::string where;
  [[noreturn]] void fail(const std::string& message) const {
    throw ConfigError(where, message);
  }
};

template <class T>
class Spec {
 public:
  // The member may be one of T's base class.
  template <class V, class Owner>
    requires std::derived_from<T, Owner>
  Spec& key(const std::string& name, V Owner::*member, const std::string& sentence, Rule rule = {}) {
    const T defaults{};
    const std::string fallback = rule.required            ? ""
                                 : rule.fallback.empty() ? Value<V>::yaml(defaults.*member)
                                                         : rule.fallback;
    Key doc{name, Value<V>::shape(), rule.unit, rule.range, fallback, sentence, rule.required};
    fields_.push_back({doc, [=](const Config& section, T& target) {
                         read_field<V>(section, name, rule, target.*member);
                       }});
    keys_.push_back(doc);
    return *this;
  }

  // A condition that joins several keys; it calls config.fail() if it does not hold.
  Spec& check(std::function<void(const T&, const Config&)> condition) {
    checks_.push_back(std::move(condition));
    return *this;
  }

  const std::vector<Key>& keys() const { return keys_; }

  // Reads a section. `also` names keys that somebody else reads ("type").
  void read_into(const Config& given, T& target, const std::vector<std::string>& also = {}) const {
    if (!given.is_map())
      given.fail("expected a section of keys (" + join(names()) + "), found " + given.shown(), InputFault::form);
    const Config section = given.resolving();
    refuse_unknown_keys(section, also);
    for (const auto& field : fields_) field.read(section, target);
    if constexpr (requires { target.origin.where; }) target.origin.where = section.where();
    for (const auto& condition : checks_) condition(target, section);
  }

  T read(const Config& section) const {
    T target{};
    read_into(section, target);
    return target;
  }

 private:
  struct Field {
    Key doc;
    std::function<void(const Config&, T&)> read;
  };

  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& key : keys_) out.push_back(key.name);
    return out;
  }

  void refuse_unknown_keys(const Config& section, const std::vector<std::string>& also) const {
    auto known = names();
    known.insert(known.end(), also.begin(), also.end());
    for (const auto& given : section.keys()) {
      if (std::find(known.begin(), known.end(), given) != known.end()) continue;
      section.at(given).fail("unknown key" + did_you_mean(given, known, ".") + " Known here: " + join(known) + ".",
                             InputFault::form);
    }
  }

  template <class V>
  static void read_field(const Config& section, const std::string& name, const Rule& rule,
                         V& target) {
    if (!rule.with.key.empty() && section.at(rule.with.key).text() != rule.with.word)
      refuse_meaningless(section, name, rule.with);
    else if (section.has(name) && !section.at(name).is_null()) {
      if (!rule.fallback.empty()) complete_type(section.at(name), rule.fallback);
      target = Value<V>::read(section.at(name), rule);
    } else if (rule.required) {
      section.fail("key '" + name + "' is missing (" + type_text(Value<V>::shape()) +
                   (rule.unit.empty() ? "" : ", " + rule.unit) + ")");
    } else if (!rule.fallback.empty()) {
      target = Value<V>::read(section.fill(name, rule.fallback), rule);
    } else if constexpr (requires { V::spec(); }) {
      target = V::spec().read(section.fill(name, "{}"));
    } else if (const std::string text = Value<V>::yaml(target); !text.empty()) {
      section.fill(name, text);
    }
  }

  static void refuse_meaningless(const Config& section, const std::string& name, const Condition& with) {
    if (!section.has(name) || section.at(name).is_null()) return;
    section.at(name).fail("has a meaning only with " + with.key + ": " + with.word + ", found " + with.key + ": " +
                          section.at(with.key).text() + "; remove it (--set " + name + "=null)");
  }

  // `integrator: {rtol: 1e-5}` keeps the type of the fallback "{type: cvode_bdf}".
  static void complete_type(const Config& given, const std::string& fallback) {
    const Config usual = Config::from_text(fallback);
    if (given.is_map() && usual.has("type") && !given.has("type"))
      given.fill_text("type", usual.at("type").text());
  }

  std::vector<Field> fields_;
  std::vector<Key> keys_;
  std::vector<std::function<void(const T&, const Config&)>> checks_;
};

}  // namespace orthodyn
