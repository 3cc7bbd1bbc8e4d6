// Implementations that the input chooses by name (`type: box`). Each source file registers its implementation:
//
//   const bool box_registered = Registry<MeshSource>::add<BoxSource>("box", "A box of tetrahedra.");
//
// T in add<T>() derives from Base and has a static spec(). An optional static facts() adds properties for lists.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lib/config/spec.h"

namespace orthodyn {

// Names that a faulty plugin registered a second time.
std::vector<std::string>& registry_conflicts();

// Reads the key `type` of a section. Replaces a former name by the present one, with a warning. Throws ConfigError for
// names not in `names`.
std::string registered_type(const Config& config, const std::vector<std::string>& names,
                            const std::map<std::string, std::string>& former_names);

template <class Base>
class Registry {
 public:
  struct Entry : Alternative {
    std::function<std::shared_ptr<const Base>(const Config&)> read;
    std::function<std::shared_ptr<const Base>()> make;  // an object with the defaults of its keys
  };

  static const std::map<std::string, Entry>& entries() { return mutable_entries(); }

  template <class T>
  static bool add(const std::string& name, const std::string& sentence) {
    Entry entry{{sentence, T::spec().keys()},
                [](const Config& config) -> std::shared_ptr<const Base> {
                  auto item = std::make_shared<T>();
                  T::spec().read_into(config, *item, {"type"});
                  return item;
                },
                [] { return std::make_shared<const T>(); }};
    if constexpr (requires { T::facts(); }) entry.facts = T::facts();
    const bool is_new = mutable_entries().emplace(name, std::move(entry)).second;
    if (!is_new) registry_conflicts().push_back(name);
    return is_new;
  }

  // Accepts `former` for `name`, with a warning.
  static bool rename(const std::string& former, const std::string& name) {
    return former_names().emplace(former, name).second;
  }

  // Reads a section by its key `type`. Throws ConfigError.
  static std::shared_ptr<const Base> read(const Config& config) {
    return entries().at(registered_type(config, names(), former_names())).read(config);
  }

  static std::vector<std::string> names() {
    std::vector<std::string> out;
    for (const auto& [name, entry] : entries()) out.push_back(name);
    return out;
  }

 private:
  static std::map<std::string, Entry>& mutable_entries() {
    static std::map<std::string, Entry> all;
    return all;
  }
  static std::map<std::string, std::string>& former_names() {
    static std::map<std::string, std::string> all;
    return all;
  }
};

template <class Base>
struct Value<std::shared_ptr<const Base>> {
  static ValueSchema schema() {
    return {.kind = ValueSchema::Kind::choice, .title = type_title(typeid(Base).name()), .alternatives = [] {
              const auto& entries = Registry<Base>::entries();
              return std::map<std::string, Alternative>(entries.begin(), entries.end());
            }};
  }
  static std::shared_ptr<const Base> read(const Config& c, const Rule&) { return Registry<Base>::read(c); }
  static std::string yaml(const std::shared_ptr<const Base>&) { return ""; }
};

}  // namespace orthodyn
