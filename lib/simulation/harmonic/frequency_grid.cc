#include "lib/simulation/harmonic/frequency_grid.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

namespace {

// Distances from a natural frequency, in half bandwidths.
constexpr double kBeside[] = {0.25, 0.5, 0.75, 1, 1.5, 2, 3, 5, 8, 13, 21};

std::vector<double> spaced(const Harmonic& harmonic) {
  std::vector<double> out;
  const double from = *harmonic.from, to = *harmonic.to;
  const int points = harmonic.points.value_or(200);
  for (int k = 0; k < points; ++k) {
    const double share = k / (points - 1.0);
    out.push_back(harmonic.spacing == Spacing::linear ? from + share * (to - from) : from * std::pow(to / from, share));
  }
  out.back() = to;
  return out;
}

// Frequencies at and beside one resonance, between two limits.
void add_resonance(const Resonance& resonance, double low, double high, std::vector<double>& out) {
  const auto add = [&](double f) {
    if (f >= low && f <= high) out.push_back(f);
  };
  add(resonance.frequency);
  for (const double distance : kBeside)
    for (const double side : {-0.5, 0.5}) add(resonance.frequency + side * distance * resonance.width());
}

}  // namespace

std::vector<double> frequency_grid(const Harmonic& harmonic, const std::vector<Resonance>& resonances) {
  if (harmonic.frequencies) return *harmonic.frequencies;
  std::vector<double> grid = spaced(harmonic);
  if (!harmonic.resonances.value_or(true)) return grid;
  const double from = *harmonic.from, to = *harmonic.to;
  for (std::size_t k = 0; k < resonances.size(); ++k) {
    const double f = resonances[k].frequency;
    if (f < from || f > to) continue;
    const double below = k > 0 ? (resonances[k - 1].frequency + f) / 2 : from;
    const double above = k + 1 < resonances.size() ? (resonances[k + 1].frequency + f) / 2 : to;
    add_resonance(resonances[k], std::max(from, below), std::min(to, above), grid);
  }
  std::sort(grid.begin(), grid.end());
  grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
  return grid;
}

namespace {

// At most `count` of the values, evenly distributed, with the first and the last.
std::vector<double> some_of(const std::vector<double>& all, std::size_t count) {
  if (all.size() <= count) return all;
  std::vector<double> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(all[k * (all.size() - 1) / (count - 1)]);
  return out;
}

}  // namespace

std::vector<double> check_frequencies(const std::vector<double>& grid, const std::vector<double>& natural) {
  constexpr std::size_t kChecks = 11, kResonances = 6;
  std::vector<double> within;
  for (const double f : natural)
    if (f >= grid.front() && f <= grid.back()) within.push_back(f);
  std::vector<double> out = some_of(grid, kChecks);
  const std::vector<double> resonances = some_of(within, kResonances);
  out.insert(out.end(), resonances.begin(), resonances.end());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<int> missed_resonances(const std::vector<double>& grid, const std::vector<Resonance>& resonances) {
  std::vector<int> missed;
  for (std::size_t k = 0; k < resonances.size(); ++k) {
    const Resonance& resonance = resonances[k];
    if (resonance.frequency < grid.front() || resonance.frequency > grid.back()) continue;
    const auto next = std::lower_bound(grid.begin(), grid.end(), resonance.frequency);
    double nearest = std::abs(*next - resonance.frequency);
    if (next != grid.begin()) nearest = std::min(nearest, std::abs(*(next - 1) - resonance.frequency));
    if (nearest > resonance.width() / 2) missed.push_back(static_cast<int>(k) + 1);
  }
  return missed;
}

}  // namespace orthodyn
