#include "lib/simulation/output/extremes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lib/fem/fem_model.h"
#include "lib/ode/integrator.h"
#include "lib/scene/build.h"

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

ExtremeRecorder::ExtremeRecorder(const Scene& scene, const FemModel& model) : scene_(scene), model_(model) {
  for (const auto& name : scene.output.extremes) {
    if (const std::string probe = probe_of(name); !probe.empty()) {
      add_probe(name, probe);
      continue;
    }
    auto find = find_extreme(name, model, scene.output.origin);
    if (!find)
      scene.output.origin.fail(
          fmt::format("extremes: '{}' is neither an extreme of a stress or strain field nor of a probe's component; "
                      "use, for example, von_mises.largest, tsai_wu.largest, REGION.nodal_stress_material.11.smallest "
                      "or PROBE.displacement.z.largest",
                      name));
    find_.push_back(std::move(*find));
    found_.push_back({.quantity = name, .unit = unit_of_extreme(name)});
  }
}

// The probe named at the start of an extreme such as "tip.displacement.z.largest"; "" if no probe has that name. If a
// region has the same name, the extreme belongs to the region.
std::string ExtremeRecorder::probe_of(const std::string& name) const {
  const auto is_first_part = [&](const std::string& part) { return !part.empty() && name.starts_with(part + "."); };
  for (const auto& term : model_.parts().elastic)
    for (const std::string& region : {term->region(), term->definition().mesh_region, term->definition().ply})
      if (is_first_part(region)) return "";
  for (const auto& [probe, place] : scene_.output.probes)
    if (is_first_part(probe)) return probe;
  return "";
}

void ExtremeRecorder::add_probe(const std::string& name, const std::string& probe) {
  const SourceLocation& origin = scene_.output.origin;
  const auto dot = name.rfind('.');
  const std::string which = name.substr(dot + 1);
  if (which != "largest" && which != "smallest")
    origin.fail(fmt::format("extremes: '{}' must end with .largest or .smallest", name));
  const Quantity quantity = find_quantity(name.substr(0, dot), scene_, model_, origin);
  if (quantity.components() > 1) origin.fail("extremes: " + quantity.ask_for_component());
  const auto is_probe = [&](const auto& one) { return one.first == probe; };
  const int node = std::find_if(scene_.output.probes.begin(), scene_.output.probes.end(), is_probe)
                       ->second.node(model_.parts().mesh);
  find_.push_back([values = quantity.values, node](const ObservedState& observed) {
    return Extreme{values(observed)[0], node};
  });
  found_.push_back({.quantity = name, .unit = quantity.unit, .between_rows = !scene_.is_static()});
  if (scene_.is_static()) return;
  found_.back().node = node;
  found_.back().place = model_.parts().mesh.nodes.at(static_cast<std::size_t>(node));
  tracked_.push_back({found_.size() - 1, quantity, which == "largest" ? 1.0 : -1.0});
}

bool ExtremeRecorder::is_tracked(std::size_t index) const { return found_[index].between_rows; }

void ExtremeRecorder::begin_at(double t) {
  last_.t = t;
  if (slopes_) slopes_->begin_at(t);
}

void ExtremeRecorder::on_start(const ObservedState& observed) {
  begin_at(observed.t());
  last_ = observed.state();
  for (Tracked& tracked : tracked_) tracked.search.start(observed.t(), signed_value(tracked, observed));
  observe(observed);
}

void ExtremeRecorder::observe(const ObservedState& observed) {
  for (std::size_t k = 0; k < find_.size(); ++k) {
    if (is_tracked(k)) continue;
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

double ExtremeRecorder::signed_value(const Tracked& tracked, const ObservedState& observed) const {
  return tracked.sign * tracked.quantity.values(observed)[0];
}

void ExtremeRecorder::on_step(const StepInfo& info, const ObservedState& end, const Integrator& integrator) {
  if (tracked_.empty()) return;
  const double begin = last_.t, h = info.t - begin, parts = smooth_parts(integrator, h);
  State state;
  for (Tracked& tracked : tracked_) {
    const auto value_at = [&](double t) {
      integrator.interpolate(t, state);
      return signed_value(tracked, {model_, state});
    };
    for (double part = 0; part < parts; ++part)
      tracked.search.advance(begin + part * h / parts, part + 1 < parts ? begin + (part + 1) * h / parts : info.t,
                             value_at);
    const TimeExtreme::Maximum largest = tracked.search.largest();
    if (!slopes_ || !largest.exists() || tracked.search.ends_run() || tracked.differentiated_at == largest.t) continue;
    integrator.interpolate(largest.t, state);
    update_derivatives(tracked, state);
  }
  last_ = end.state();
}

void ExtremeRecorder::update_derivatives(Tracked& tracked, const State& state) const {
  tracked.differentiated_at = state.t;
  tracked.failure.clear();
  tracked.slopes.clear();
  try {
    tracked.slopes = slopes_->derivatives(named_quantities({tracked.quantity.name}, scene_, model_), state);
  } catch (const std::exception& e) {
    tracked.failure = e.what();
  }
}

// The run may end while a value still rises. A resumed run goes on from the saved search.
void ExtremeRecorder::on_end() noexcept {
  try {
    for (Tracked& tracked : tracked_)
      if (slopes_ && tracked.search.ends_run()) update_derivatives(tracked, last_);
  } catch (...) {  // no memory: there are no derivatives
  }
}

std::string ExtremeRecorder::remark_on(const Tracked& tracked) const {
  const TimeExtreme::Maximum largest = tracked.search.largest(), next = tracked.search.next();
  if (!tracked.failure.empty()) return "has no derivatives: " + tracked.failure;
  if (largest.jumps) return fmt::format("has no derivatives: the quantity jumps at t = {:.6g} s", largest.t);
  if (tracked.search.ends_run() && stopped_)
    return "has no derivatives: it lies at the end of the run, which an event sets";
  const double tolerance = std::clamp(1e3 * scene_.integrator->settings().rtol.value_or(0), 1e-6, 1e-2);
  if (!next.exists() || largest.value - next.value > tolerance * tracked.search.range()) return "";
  return fmt::format(
      "is reached at t = {:.6g} s and, within the accuracy of the run, at {:.6g} s; its derivatives are those at "
      "{:.6g} "
      "s",
      largest.t, next.t, largest.t);
}

void ExtremeRecorder::copy_to(RecordedExtreme& found, const Tracked& tracked) const {
  const TimeExtreme::Maximum largest = tracked.search.largest();
  found.states = tracked.search.samples();
  if (!largest.exists()) {
    found.node = -1;
    return;
  }
  found.value = tracked.sign * largest.value;
  found.time = largest.t;
  if (!slopes_) return;
  found.remark = remark_on(tracked);
  if (found.remark.starts_with("has no") || tracked.differentiated_at != largest.t) return;
  const std::vector<std::string> paths = slopes_->paths();
  for (std::size_t i = 0; i < tracked.slopes.size(); ++i) found.derivatives.emplace_back(paths[i], tracked.slopes[i]);
}

std::vector<RecordedExtreme> ExtremeRecorder::found() const {
  std::vector<RecordedExtreme> all = found_;
  for (const Tracked& tracked : tracked_) copy_to(all[tracked.index], tracked);
  return all;
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
  for (const Tracked& tracked : tracked_) {
    const std::string& name = found_[tracked.index].quantity;
    tracked.search.save(name + ".search", archive);
    if (!tracked.differentiated_at || tracked.slopes.empty()) continue;
    archive.put(name + ".differentiated_at", *tracked.differentiated_at);
    archive.put(name + ".slopes", tracked.slopes);
  }
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
  for (Tracked& tracked : tracked_) {
    const std::string& name = found_[tracked.index].quantity;
    tracked.search.restore(name + ".search", archive);
    if (!slopes_ || !archive.entries().contains(name + ".slopes")) continue;
    tracked.differentiated_at = archive.number(name + ".differentiated_at");
    tracked.slopes = archive.numbers(name + ".slopes", slopes_->paths().size());
  }
}

}  // namespace orthodyn
