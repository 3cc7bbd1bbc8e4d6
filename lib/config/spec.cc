#include "lib/config/spec.h"

#include <algorithm>

#include "lib/core/words.h"

namespace orthodyn {

namespace {

std::vector<std::string> names_of(const std::vector<Key>& keys) {
  std::vector<std::string> names;
  for (const auto& key : keys) names.push_back(key.name);
  return names;
}

void refuse_unknown_keys(const Config& section, std::vector<std::string> known, const std::vector<std::string>& also) {
  known.insert(known.end(), also.begin(), also.end());
  for (const auto& given : section.keys()) {
    if (std::find(known.begin(), known.end(), given) != known.end()) continue;
    section.at(given).fail("unknown key" + did_you_mean(given, known, ".") + " Known here: " + join(known) + ".",
                           InputFault::form);
  }
}

bool is_given(const Config& section, const std::string& name) {
  return section.has(name) && !section.at(name).is_null();
}

void refuse_meaningless(const Config& section, const std::string& name, const std::string& with_key,
                        const std::string& with_word) {
  if (!is_given(section, name)) return;
  section.at(name).fail("has a meaning only with " + with_key + ": " + with_word + ", found " + with_key + ": " +
                        section.at(with_key).text() + "; remove it (--set " + name + "=null)");
}

// `integrator: {rtol: 1e-5}` keeps the type of the fallback "{type: cvode_bdf}".
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
  keys_.push_back({std::string(name), type.shape(), std::string(rule.unit), rule.range, fallback,
                   std::string(sentence), rule.required});
  fields_.push_back({keys_.back(), std::string(rule.fallback), std::string(rule.with.key),
                     std::string(rule.with.word), &type, std::move(member)});
}

Config Keys::read_fields(const Config& given, void* target, const std::vector<std::string>& also) const {
  if (!given.is_map())
    given.fail("expected a section of keys (" + join(names_of(keys_)) + "), found " + given.shown(), InputFault::form);
  const Config section = given.resolving();
  refuse_unknown_keys(section, names_of(keys_), also);
  for (const Field& field : fields_) {
    const Key& key = field.doc;
    const Rule rule{key.required, key.unit, key.range, field.fallback, {field.with_key, field.with_word}};
    void* const member = field.member(target);
    if (!field.with_key.empty() && section.at(field.with_key).text() != field.with_word) {
      refuse_meaningless(section, key.name, field.with_key, field.with_word);
    } else if (is_given(section, key.name)) {
      if (!field.fallback.empty()) complete_type(section.at(key.name), field.fallback);
      field.type->read(section.at(key.name), rule, member);
    } else if (key.required) {
      section.fail("key '" + key.name + "' is missing (" + type_text(key.shape) +
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
