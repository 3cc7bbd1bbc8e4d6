#include "lib/simulation/observers/extremes.h"

#include <fmt/format.h>

#include "lib/fem/fem_model.h"

namespace orthodyn {

ExtremeRecorder::ExtremeRecorder(const std::vector<std::string>& quantities, const FemModel& model,
                                 const Origin& origin)
    : model_(model) {
  for (const auto& name : quantities) {
    auto find = find_extreme(name, model, origin);
    if (!find)
      origin.fail(fmt::format("extremes: '{}' is not an extreme of a field of stress or strain: give one such as "
                              "von_mises.largest, tsai_wu.largest or REGION.nodal_stress_material.11.smallest",
                              name));
    find_.push_back(std::move(*find));
    found_.push_back({.quantity = name, .unit = unit_of_extreme(name)});
  }
}

void ExtremeRecorder::look_at(const ObservedState& observed) {
  for (std::size_t k = 0; k < find_.size(); ++k) {
    const Extreme now = find_[k](observed);
    RecordedExtreme& found = found_[k];
    ++found.states;
    const double sign = found.quantity.ends_with(".largest") ? 1 : -1;
    if (now.node < 0 || !(found.node < 0 || sign * now.value > sign * found.value)) continue;
    found.value = now.value;
    found.time = observed.t();
    found.node = now.node;
    found.place = model_.parts().mesh.nodes[static_cast<std::size_t>(now.node)];
  }
}

void ExtremeRecorder::save(Archive& archive) {
  for (const auto& f : found_)
    archive.put(f.quantity, {f.value, f.time, static_cast<double>(f.node), static_cast<double>(f.states)});
}

void ExtremeRecorder::restore(const Archive& archive) {
  for (auto& f : found_) {
    const auto& kept = archive.numbers(f.quantity, 4);
    f.value = kept[0];
    f.time = kept[1];
    f.node = static_cast<int>(kept[2]);
    f.states = static_cast<long>(kept[3]);
    if (f.node >= 0) f.place = model_.parts().mesh.nodes.at(static_cast<std::size_t>(f.node));
  }
}

}  // namespace orthodyn
