#include "tools/orthodyn/input_tree.h"

#include <set>

#include "lib/config/config.h"
#include "lib/scene/scene.h"
#include "lib/study/compare/comparison.h"
#include "lib/study/fit/fit.h"
#include "lib/study/stability/stability.h"
#include "lib/study/sweep/sweep.h"

namespace orthodyn {

namespace {

class SectionCollector {
 public:
  void visit(const std::string& path, const std::vector<Key>& keys) {
    for (const Key& key : keys) visit(path.empty() ? key.name : path + "." + key.name, key.sentence, key.schema);
  }

  std::vector<InputSection> sections;

 private:
  void visit(const std::string& path, const std::string& sentence, const ValueSchema& schema) {
    switch (schema.kind) {
      case ValueSchema::Kind::list: return visit(path + ".<n>", sentence, schema.items.front());
      case ValueSchema::Kind::named: return visit(path + ".<name>", sentence, schema.items.front());
      case ValueSchema::Kind::either:
        for (const ValueSchema& item : schema.items) visit(path, sentence, item);
        return;
      case ValueSchema::Kind::section: return visit_section(path, sentence, schema);
      case ValueSchema::Kind::choice: return visit_choice(path, schema);
      default: return;
    }
  }

  void visit_section(const std::string& path, const std::string& sentence, const ValueSchema& schema) {
    if (!seen_.insert(schema.title).second) return;
    const auto keys = schema.keys();
    sections.push_back({path, "", sentence, keys});
    visit(path, keys);
  }

  void visit_choice(const std::string& path, const ValueSchema& schema) {
    if (!seen_.insert(schema.title).second) return;
    for (const auto& [type, alternative] : schema.alternatives()) {
      sections.push_back({path, type, alternative.sentence, alternative.keys, alternative.facts});
      visit(path, alternative.keys);
    }
  }

  std::set<std::string> seen_;
};

}  // namespace

const std::vector<InputKind>& input_kinds() {
  static const std::vector<InputKind> all = {
      {"scene", "One simulation, for `orthodyn run`; with `expect` also a case for `orthodyn verify`.",
       Scene::spec().keys()},
      {"comparison", "Integrators on scenes, error against time, for `orthodyn compare`.", Comparison::spec().keys()},
      {"sweep", "Metrics of a scene for varied parameters, for `orthodyn sweep`.", Sweep::spec().keys()},
      {"fit", "Parameters of scenes from measured values, for `orthodyn fit`.", study::fit::Fit::spec().keys()},
      {"stability", "Grades of integrators on hard cases, for `orthodyn stability`.", Stability::spec().keys()},
  };
  return all;
}

std::vector<InputSection> input_sections(const InputKind& kind) {
  SectionCollector collector;
  collector.sections.push_back({"", "", kind.sentence, kind.keys});
  collector.visit("", kind.keys);
  return collector.sections;
}

std::string default_type(const Key& key) {
  if (key.fallback.empty() || key.fallback.front() != '{') return "";
  const Config usual = Config::from_text(key.fallback);
  return usual.has("type") ? usual.at("type").text() : "";
}

}  // namespace orthodyn
