#include "lib/study/quantities/series.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orthodyn {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kSamplesPerStep = 4;

// The vertex of the parabola through the largest sample and its neighbours.
struct Vertex {
  double t = kNone, value = kNone;
};

// Whether the curve bends beside the sample, too, where there are samples: through a corner, such as that of a ramp,
// goes no parabola. `a` is half the second derivative of that through the sample and its neighbours.
bool is_round(const Series& s, std::size_t k, double a) {
  constexpr double kShare = 0.25;         // of the bend in the middle
  const auto bend = [&](std::size_t i) {  // half the second derivative
    const double h0 = s.times[i] - s.times[i - 1], h1 = s.times[i + 1] - s.times[i];
    return ((s.values[i + 1] - s.values[i]) / h1 - (s.values[i] - s.values[i - 1]) / h0) / (h0 + h1);
  };
  return (k < 2 || bend(k - 1) / a >= kShare) && (k + 2 >= s.size() || bend(k + 1) / a >= kShare);
}

Vertex vertex(const Series& s, double sign) {
  if (s.times.empty()) return {};
  const auto better = [&](double a, double b) { return sign * a < sign * b; };
  const auto k =
      static_cast<std::size_t>(std::max_element(s.values.begin(), s.values.end(), better) - s.values.begin());
  const Vertex sample{s.times[k], s.values[k]};
  if (k == 0 || k + 1 == s.size()) return sample;
  const double h0 = s.times[k - 1] - s.times[k], h1 = s.times[k + 1] - s.times[k];
  const double y0 = s.values[k - 1] - s.values[k], y1 = s.values[k + 1] - s.values[k];
  // y = b h + a h^2
  const double a = (y1 / h1 - y0 / h0) / (h1 - h0), b = y0 / h0 - a * h0;
  if (!(sign * a < 0) || !is_round(s, k, a)) return sample;
  return {s.times[k] - b / (2 * a), s.values[k] - b * b / (4 * a)};
}

// The integral of the parabola through the samples k, k + 1, k + 2 from the first to the second of them,
// by Newton's divided differences.
double integral_over_first(const Series& s, std::size_t k) {
  const double h = s.times[k + 1] - s.times[k], g = s.times[k + 2] - s.times[k + 1];
  const double slope = (s.values[k + 1] - s.values[k]) / h, next = (s.values[k + 2] - s.values[k + 1]) / g;
  return h * (s.values[k] + h * (slope / 2 - (next - slope) / (h + g) * h / 6));
}

// The same from the second to the third.
double integral_over_last(const Series& s, std::size_t k) {
  const double h = s.times[k + 1] - s.times[k], g = s.times[k + 2] - s.times[k + 1];
  const double slope = (s.values[k + 1] - s.values[k]) / h, next = (s.values[k + 2] - s.values[k + 1]) / g;
  return g * (s.values[k + 2] - g * (next / 2 + (next - slope) / (h + g) * g / 6));
}

bool is_even(const Series& s, std::size_t k) {
  const double h = s.times[k + 1] - s.times[k], g = s.times[k + 2] - s.times[k + 1];
  return std::max(h, g) <= 4 * std::min(h, g);
}

}  // namespace

double maximum(const Series& series, double sign) { return vertex(series, sign).value; }

double time_of_maximum(const Series& series, double sign) { return vertex(series, sign).t; }

double mean(const Series& s) {
  const auto n = s.size();
  if (n < 2) return kNone;
  double sum = 0;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    // Parabolas through either neighbour, averaged; at the ends there is one. None through samples of very different
    // distances, which lie beside a jump: it would leave their range by far.
    double pieces = 0;
    int count = 0;
    if (k > 0 && is_even(s, k - 1)) pieces += integral_over_last(s, k - 1), ++count;
    if (k + 2 < n && is_even(s, k)) pieces += integral_over_first(s, k), ++count;
    sum += count > 0 ? pieces / count : 0.5 * (s.values[k] + s.values[k + 1]) * (s.times[k + 1] - s.times[k]);
  }
  return sum / (s.times.back() - s.times.front());
}

double frequency(const Series& s) {
  const double level = mean(s);
  double first = kNone, last = kNone;
  int crossings = 0;
  for (std::size_t k = 1; k < s.size(); ++k) {
    const double before = s.values[k - 1] - level, now = s.values[k] - level;
    if (!(before < 0 && now >= 0)) continue;
    last = s.times[k - 1] + (s.times[k] - s.times[k - 1]) * before / (before - now);
    if (++crossings == 1) first = last;
  }
  return crossings < 2 ? kNone : (crossings - 1) / (last - first);
}

double settling_time(const Series& s, double share) {
  if (s.size() < 2) return kNone;
  const auto [least, most] = std::minmax_element(s.values.begin(), s.values.end());
  const double last = s.values.back(), band = share * (*most - *least), start = s.times.front();
  std::size_t k = s.size() - 1;
  while (k > 0 && std::abs(s.values[k - 1] - last) <= band) --k;
  if (k == 0) return 0;
  // Between the last sample outside and the first inside.
  const double outside = std::abs(s.values[k - 1] - last), inside = std::abs(s.values[k] - last);
  const double t = s.times[k - 1] + (s.times[k] - s.times[k - 1]) * (outside - band) / (outside - inside);
  return t - start > 0.9 * (s.times.back() - start) ? kNone : t - start;
}

double drift(const Series& s) {
  const auto n = static_cast<std::size_t>(s.components);
  double largest = s.size() == 0 ? kNone : 0;
  for (std::size_t k = 0; k < s.size(); ++k) {
    double squares = 0;
    for (std::size_t c = 0; c < n; ++c) squares += std::pow(s.values[k * n + c] - s.values[c], 2);
    if (std::isnan(squares)) return kNone;
    largest = std::max(largest, std::sqrt(squares));
  }
  return largest;
}

double gain(const Series& s) {
  double largest = s.size() == 0 ? kNone : 0;
  for (const double value : s.values) {
    if (std::isnan(value)) return kNone;
    largest = std::max(largest, value - s.values[0]);
  }
  return largest;
}

double onset(const Series& s, double level) {
  for (std::size_t k = 0; k < s.size(); ++k) {
    const double now = std::abs(s.values[k]);
    if (now < level) continue;
    if (k == 0) return s.times[0];
    const double before = std::abs(s.values[k - 1]);
    return s.times[k - 1] + (s.times[k] - s.times[k - 1]) * (level - before) / (now - before);
  }
  return kNone;
}

SeriesRecorder::SeriesRecorder(const Model& model, const Integrator& integrator, std::vector<Quantity> quantities)
    : model_(model), quantities_(std::move(quantities)) {
  for (const auto& q : quantities_) {
    series_.push_back({q.components(), {}, {}});
    if (!q.values && !energy_) energy_ = std::make_unique<EnergyMeter>(model, integrator);
  }
}

void SeriesRecorder::on_start(const ObservedState& observed) {
  if (energy_) energy_->on_start(observed);
  record(observed);
}

// In the order of time with the other samples, as the energy balance needs: see on_step().
void SeriesRecorder::on_output(const ObservedState& observed) { pending_.push_back(observed.t()); }

void SeriesRecorder::on_step(const StepInfo& info, const ObservedState& observed, const Integrator& integrator) {
  std::vector<double> samples = pending_;
  const double h = info.t - last_t_, count = kSamplesPerStep * smooth_parts(integrator, h);
  for (double k = 1; k < count; ++k) samples.push_back(last_t_ + h * k / count);
  std::sort(samples.begin(), samples.end());
  for (const double t : samples) {
    if (t <= last_t_ || t >= info.t) continue;
    State within;
    integrator.interpolate(t, within);
    record({model_, within});
  }
  record(observed);
  pending_.clear();
}

double SeriesRecorder::at(std::size_t quantity, double t) const {
  const Series& s = series_[quantity];
  const auto after = std::lower_bound(s.times.begin(), s.times.end(), t);
  const auto nearest = after == s.times.begin()                                  ? after
                       : after == s.times.end() || t - *(after - 1) < *after - t ? after - 1
                                                                                 : after;
  return s.values[static_cast<std::size_t>(nearest - s.times.begin())];
}

void SeriesRecorder::record(const ObservedState& observed) {
  if (energy_) energy_->on_output(observed);
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const auto v = values(q, observed);
    series_[q].times.push_back(observed.t());
    series_[q].values.insert(series_[q].values.end(), v.begin(), v.end());
  }
  last_t_ = observed.t();
}

std::vector<double> SeriesRecorder::values(std::size_t quantity, const ObservedState& observed) const {
  const auto& q = quantities_[quantity];
  if (!q.values) return {energy_->last().balance()};
  return q.values(observed);
}

}  // namespace orthodyn
