#include "lib/simulation/sensitivity/event_sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace orthodyn {

namespace {

std::vector<std::string> header_of(const MotionSlopes& slopes) {
  std::vector<std::string> header{"t [s]", "event"};
  for (const std::string& path : slopes.paths()) header.push_back(fmt::format("d t / d {} [s / SI unit]", path));
  header.emplace_back("remark");
  return header;
}

// df/dt at a time within [begin, end], by a difference of second order with steps of a thousandth of the interval.
double rate(const std::function<double(double)>& f, double t, double begin, double end) {
  const double step = 1e-3 * (end - begin);
  if (t - step < begin) return (-3 * f(t) + 4 * f(t + step) - f(t + 2 * step)) / (2 * step);
  if (t + step > end) return (3 * f(t) - 4 * f(t - step) + f(t - 2 * step)) / (2 * step);
  return (f(t + step) - f(t - step)) / (2 * step);
}

}  // namespace

EventSensitivityWriter::EventSensitivityWriter(const std::filesystem::path& path, const Scene& scene,
                                               const FemModel& model, MotionSlopes& slopes)
    : TableWriter(path, header_of(slopes)), scene_(scene), model_(model), slopes_(slopes) {}

void EventSensitivityWriter::on_start(const ObservedState& observed) {
  TableWriter::on_start(observed);
  begin_at(observed.t());
}

void EventSensitivityWriter::on_resume(const ObservedState& observed) {
  TableWriter::on_resume(observed);
  begin_at(observed.t());
}

void EventSensitivityWriter::begin_at(double t) {
  begin_ = t;
  slopes_.begin_at(t);
}

void EventSensitivityWriter::on_step(const StepInfo& info, const ObservedState&, const Integrator& integrator) {
  for (const Crossing& crossing : std::exchange(crossings_, {})) {
    const Row row = row_of(crossing, info.t, integrator);
    std::string text = fmt::format("{},{}", crossing.state.t, crossing.event->name);
    for (std::size_t i = 0; i < slopes_.paths().size(); ++i)
      text += row.derivatives.empty() ? "," : fmt::format(",{}", row.derivatives[i]);
    file_.append(text + "," + row.remark + "\n");
  }
  begin_ = info.t;
}

EventSensitivityWriter::Row EventSensitivityWriter::row_of(const Crossing& crossing, double end,
                                                           const Integrator& integrator) const {
  // Smallest change in the step at this rate, of the largest distance from the threshold.
  constexpr double kStill = 1e-2;
  const Event& event = *crossing.event;
  const double t = crossing.state.t, h = end - begin_;
  const std::string quantity = quantity_of(event);
  if (quantity.empty()) return {{}, "another event has this name and threshold and direction: choose different names"};
  if (h <= 1e4 * std::numeric_limits<double>::epsilon() * std::abs(t))
    return {{}, "the step before the event is too short to find the rate of the quantity"};
  if (t <= begin_) return {{}, "the quantity jumps over the threshold"};
  State state;
  const auto excess = [&](double time) {
    integrator.interpolate(time, state);
    return event.quantity({model_, state}) - event.value;
  };
  const double dg_dt = rate(excess, t, begin_, end);
  const double distance = std::max(std::abs(excess(begin_)), std::abs(excess(end)));
  if (!(std::abs(dg_dt) * h > kStill * distance)) return {{}, "the quantity does not move at the threshold"};
  Row row{slopes_.derivatives(named_quantities({quantity}, scene_, model_), crossing.state)};
  for (double& dg_dp : row.derivatives) dg_dp /= -dg_dt;
  return row;
}

std::string EventSensitivityWriter::quantity_of(const Event& event) const {
  std::string found;
  for (const EventSpec& spec : scene_.events) {
    if (spec.name.value_or(spec.quantity) != event.name || spec.crosses != event.value ||
        spec.direction != event.direction)
      continue;
    if (!found.empty() && found != spec.quantity) return "";
    found = spec.quantity;
  }
  return found;
}

}  // namespace orthodyn
