#include "lib/config/spec.h"

#include <algorithm>

#include "lib/config/yaml_typos.h"
#include "lib/core/spelling.h"

namespace orthodyn {

namespace {

std::vector<std::string> names_of(const std::vector<Key>& keys) {
  std::vector<std::string> names;
  for (const auto& key : keys) names.push_back(key.name);
  return names;
}

bool is_given(const Config& section, const std::string& name) {
  return section.has(name) && !section.at(name).is_null();
}

// An unknown key. If an enclosing section has the key, that section reports the wrong indentation with throw_above().
class UnknownKey : public ConfigError {
 public:
  UnknownKey(const Config& at, const std::string& name, const std::string& hint, const std::vector<std::string>& known)
      : ConfigError(at.where(), "unknown key" + hint + list_of(known), InputFault::form), name_(name), known_(known) {}

  [[noreturn]] void throw_above(const std::string& section) const {
    throw ConfigError(place(),
                      "unknown key; it belongs beside '" + section + "', not below: indent it less." + list_of(known_),
                      fault());
  }

  const std::string& name() const { return name_; }

 private:
  static std::string list_of(const std::vector<std::string>& known) { return " Known here: " + join(known) + "."; }

  std::string name_;
  std::vector<std::string> known_;
};

bool has_key(const std::vector<Key>& keys, const std::string& name) {
  return std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
}

// Whether the section that the schema describes, or a section in its list, has the key.
bool takes(const ValueSchema& schema, const std::string& name) {
  if (schema.kind == ValueSchema::Kind::section) return has_key(schema.keys(), name);
  if (schema.kind == ValueSchema::Kind::choice) {
    const auto alternatives = schema.alternatives();
    return name == "type" || std::any_of(alternatives.begin(), alternatives.end(),
                                         [&](const auto& entry) { return has_key(entry.second.keys, name); });
  }
  return std::any_of(schema.items.begin(), schema.items.end(),
                     [&](const ValueSchema& item) { return takes(item, name); });
}

std::string place_below(const Key& key) {
  const bool has_entries = key.schema.kind == ValueSchema::Kind::named || key.schema.kind == ValueSchema::Kind::list;
  return (has_entries ? "an entry of '" : "'") + key.name + "'";
}

std::string belongs_below(const std::string& section) { return "; it belongs below " + section + ": indent it."; }

// Detects a decimal comma as in `{density: 400,5}`: the digits after the comma parse as a key without a value.
std::string decimal_comma(const std::string& name, const Config& section, const std::string& before) {
  const bool is_digits = !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
  if (!is_digits || before.empty() || !section.at(name).is_null() || !section.at(before).is_scalar()) return "";
  const std::string text = section.at(before).text();
  if (!section.at(before).reads_as_number() || text.find('.') != std::string::npos) return "";
  return "; is it meant as '" + before + ": " + text + "." + name + "'? A comma separates keys; decimals have a point.";
}

// A hint for an unknown key: "; it belongs below 'mesh': indent it.", or a similar name. Prefers the section
// `before` if it takes the key and has no value.
std::string hint_for(const std::string& name, const Config& section, const std::string& before,
                     const std::vector<Key>& keys, const std::vector<std::string>& known) {
  constexpr std::size_t kMostHolders = 3;
  std::vector<std::string> holders;
  for (const Key& key : keys) {
    if (!takes(key.schema, name)) continue;
    if (key.name == before && !is_given(section, before)) return belongs_below(place_below(key));
    if (name != "type") holders.push_back(place_below(key));
  }
  if (const std::string hint = decimal_comma(name, section, before); !hint.empty()) return hint;
  if (const std::string hint = hint_for_foreign_key(name, known); !hint.empty()) return hint;
  if (holders.empty() || holders.size() > kMostHolders) return did_you_mean(name, known, ".");
  return belongs_below(join(holders, " or "));
}

void refuse_unknown_keys(const Config& section, const std::vector<Key>& keys, const std::vector<std::string>& also) {
  std::vector<std::string> known = names_of(keys);
  known.insert(known.end(), also.begin(), also.end());
  std::string before;
  for (const auto& given : section.keys()) {
    if (std::find(known.begin(), known.end(), given) == known.end())
      throw UnknownKey(section.at(given), given, hint_for(given, section, before, keys, known), known);
    before = given;
  }
}

void rename_keys(const Config& section, const std::map<std::string, std::string>& former_names) {
  for (const auto& [former, name] : former_names) {
    if (!section.has(former)) continue;
    if (section.has(name))
      section.at(former).fail("is now called '" + name + "', which is also given; remove this key");
    section.at(former).warn("is now called '" + name + "'");
    section.rename(former, name);
  }
}

void refuse_meaningless(const Config& section, const std::string& name, const std::string& with_key,
                        const std::string& with_word) {
  if (!is_given(section, name)) return;
  section.at(name).fail("applies only with " + with_key + ": " + with_word + ", found " + with_key + ": " +
                        section.at(with_key).text() + "; remove it, or set " + section.at(name).path() + " to null");
}

// Adds the type of the fallback "{type: cvode_bdf}" to `integrator: {rtol: 1e-5}`.
void complete_type(const Config& given, const std::string& fallback) {
  const Config usual = Config::from_text(fallback);
  if (given.is_map() && usual.has("type") && !given.has("type")) given.fill_text("type", usual.at("type").text());
}

}  // namespace

Keys::Keys() = default;
Keys::Keys(const Keys&) = default;
Keys::~Keys() = default;

void Keys::add(std::string_view name, std::string_view sentence, const Rule& rule, const ValueType& type,
               const void* default_value, Member member) {
  const std::string fallback = rule.required           ? ""
                               : rule.fallback.empty() ? type.yaml(default_value)
                                                       : std::string(rule.fallback);
  keys_.push_back({std::string(name), type.schema(), std::string(rule.unit), rule.range, fallback,
                   std::string(sentence), rule.required});
  fields_.push_back({keys_.back(), std::string(rule.fallback), std::string(rule.with.key), std::string(rule.with.word),
                     &type, std::move(member)});
}

Config Keys::read_fields(const Config& given, void* target, const std::vector<std::string>& also) const {
  if (!given.is_map())
    given.fail_expected("a section of keys (" + join(names_of(keys_)) + ")",
                        given.is_scalar() ? missing_space(given.text()) : "");
  const Config section = given.resolving();
  rename_keys(section, former_names_);
  refuse_unknown_keys(section, keys_, also);
  for (const Field& field : fields_) {
    const Key& key = field.doc;
    const Rule rule{key.required, key.unit, key.range, field.fallback, {field.with_key, field.with_word}};
    void* const member = field.member(target);
    if (!field.with_key.empty() && section.at(field.with_key).text() != field.with_word) {
      refuse_meaningless(section, key.name, field.with_key, field.with_word);
    } else if (is_given(section, key.name)) {
      if (!field.fallback.empty()) complete_type(section.at(key.name), field.fallback);
      try {
        field.type->read(section.at(key.name), rule, member);
      } catch (const UnknownKey& e) {
        if (has_key(keys_, e.name())) e.throw_above(key.name);
        throw;
      }
    } else if (key.required) {
      section.fail("key '" + key.name + "' is missing (" + type_text(key.schema) +
                   (key.unit.empty() ? "" : ", " + key.unit) + ")");
    } else if (!field.fallback.empty()) {
      field.type->read(section.fill(key.name, field.fallback), rule, member);
    } else if (field.type->section) {
      field.type->read(section.fill(key.name, "{}"), {}, member);
    } else if (const std::string text = field.type->yaml(member); !text.empty()) {
      section.fill(key.name, text);
    }
  }
  return section;
}

}  // namespace orthodyn
