#include "lib/simulation/output/extremes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lib/fem/fem_model.h"

namespace orthodyn {

bool is_failure_criterion(const std::string& quantity) {
  const std::string parts = "." + quantity + ".";
  constexpr std::array kCriteria{".max_stress.", ".tsai_wu.", ".hashin."};
  return std::any_of(kCriteria.begin(), kCriteria.end(),
                     [&](const char* name) { return parts.find(name) != std::string::npos; });
}

std::vector<std::string> exceeded_strengths(const std::vector<RecordedExtreme>& extremes, bool is_static) {
  std::vector<std::string> all;
  for (const auto& e : extremes)
    if (e.node >= 0 && e.value > 1 && e.quantity.ends_with(".largest") && is_failure_criterion(e.quantity))
      all.push_back(fmt::format(
          "{} reaches {:.3g}: the strength is exceeded from 1 on, {}at ({:.4g}, {:.4g}, {:.4g}) m, {} {:.4g}{}",
          e.quantity.substr(0, e.quantity.rfind('.')), e.value, in_region(e), e.place[0], e.place[1], e.place[2],
          is_static ? "at load factor" : "at t =", e.time, is_static ? "" : " s"));
  return all;
}

std::string in_region(const RecordedExtreme& extreme) {
  return extreme.region.empty() ? "" : fmt::format("in {}, ", extreme.region);
}

ExtremeRecorder::ExtremeRecorder(const std::vector<std::string>& quantities, const FemModel& model,
                                 const SourceLocation& origin)
    : model_(model) {
  for (const auto& name : quantities) {
    auto find = find_extreme(name, model, origin);
    if (!find)
      origin.fail(
          fmt::format("extremes: '{}' is not an extreme of a stress or strain field; use, for example, "
                      "von_mises.largest, tsai_wu.largest or REGION.nodal_stress_material.11.smallest",
                      name));
    find_.push_back(std::move(*find));
    found_.push_back({.quantity = name, .unit = unit_of_extreme(name)});
  }
}

void ExtremeRecorder::observe(const ObservedState& observed) {
  for (std::size_t k = 0; k < find_.size(); ++k) {
    const Extreme now = find_[k](observed);
    RecordedExtreme& found = found_[k];
    ++found.states;
    const double sign = found.quantity.ends_with(".largest") ? 1 : -1;
    if (now.node < 0 || !(found.node < 0 || sign * now.value > sign * found.value)) continue;
    found.value = now.value;
    found.time = observed.t();
    found.node = now.node;
    found.term = now.term;
    locate(found);
  }
}

void ExtremeRecorder::locate(RecordedExtreme& found) const {
  const FemModel::Parts& parts = model_.parts();
  found.place = parts.mesh.nodes.at(static_cast<std::size_t>(found.node));
  found.region = found.term < 0 ? "" : parts.elastic.at(static_cast<std::size_t>(found.term))->region();
}

void ExtremeRecorder::save(Archive& archive) {
  for (const auto& f : found_)
    archive.put(f.quantity, {f.value, f.time, static_cast<double>(f.node), static_cast<double>(f.term),
                             static_cast<double>(f.states)});
}

void ExtremeRecorder::restore(const Archive& archive) {
  for (auto& f : found_) {
    const auto& saved = archive.numbers(f.quantity, 5);
    f.value = saved[0];
    f.time = saved[1];
    f.node = static_cast<int>(saved[2]);
    f.term = static_cast<int>(saved[3]);
    f.states = static_cast<long>(saved[4]);
    if (f.node >= 0) locate(f);
  }
}

}  // namespace orthodyn
