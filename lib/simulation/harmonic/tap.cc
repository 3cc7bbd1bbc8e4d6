#include "lib/simulation/harmonic/tap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "lib/core/write_file.h"

namespace orthodyn {

namespace {

// Appends an integer in `bytes` bytes, the least significant first.
void append(std::string& out, std::uint32_t value, int bytes) {
  for (int k = 0; k < bytes; ++k) out.push_back(static_cast<char>(value >> (8 * k) & 0xff));
}

double loudest(const std::vector<double>& samples) {
  double out = 0;
  for (const double x : samples) out = std::max(out, std::abs(x));
  return out;
}

// The name of a probe without characters that have a meaning in paths, and different from those `used`.
std::string file_name(std::string probe, const std::set<std::string>& used) {
  for (char& c : probe)
    if (static_cast<unsigned char>(c) < 128 && !std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  std::string name = probe;
  for (int k = 2; used.contains(name); ++k) name = fmt::format("{}_{}", probe, k);
  return name;
}

}  // namespace

std::vector<double> tap(const HarmonicResponse& response, std::size_t column, double seconds) {
  constexpr double kHighest = 22000;  // Hz
  std::vector<double> out(static_cast<std::size_t>(seconds * kSamplesPerSecond));
  for (std::size_t k = 0; k < response.modes_in_range(); ++k) {
    const auto& [frequency, loss_factor] = response.resonances()[k];
    const double velocity = response.impulse_velocity(column, k);
    if (frequency == 0 || frequency >= kHighest || velocity == 0) continue;
    const double omega = 2 * std::numbers::pi * frequency, decay = omega * loss_factor / 2;
    if (decay >= omega) continue;  // does not vibrate
    const double damped = std::sqrt(omega * omega - decay * decay);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double t = static_cast<double>(i) / kSamplesPerSecond;
      out[i] += velocity * std::exp(-decay * t) * (std::cos(damped * t) - decay / damped * std::sin(damped * t));
    }
  }
  return out;
}

void write_wav(const std::filesystem::path& path, const std::vector<double>& samples) {
  constexpr std::uint32_t kBytes = 2, kPcm = 1, kMono = 1;
  const auto data = static_cast<std::uint32_t>(kBytes * samples.size());
  std::string out = "RIFF";
  append(out, 36 + data, 4);
  out += "WAVEfmt ";
  append(out, 16, 4);
  append(out, kPcm, 2);
  append(out, kMono, 2);
  append(out, kSamplesPerSecond, 4);
  append(out, kBytes * kSamplesPerSecond, 4);
  append(out, kBytes, 2);
  append(out, 8 * kBytes, 2);
  out += "data";
  append(out, data, 4);
  const double top = loudest(samples), scale = top > 0 ? 0.9 * 32767 / top : 0;
  for (const double x : samples) append(out, static_cast<std::uint16_t>(std::lround(scale * x)), kBytes);
  write_file(path, {out});
}

void write_taps(const std::filesystem::path& folder, const HarmonicResponse& response, double seconds) {
  std::map<std::string, std::vector<double>> of_probe;
  for (std::size_t c = 0; c < response.columns().size(); ++c) {
    const ResponseColumn& column = response.columns()[c];
    if (!column.is_motion) continue;
    std::vector<double> samples = tap(response, c, seconds);
    auto& best = of_probe[column.probe];
    if (best.empty() || loudest(samples) > loudest(best)) best = std::move(samples);
  }
  std::set<std::string> used;
  for (const auto& [probe, samples] : of_probe) {
    const std::string name = *used.insert(file_name(probe, used)).first;
    write_wav(folder / "taps" / (name + ".wav"), samples);
  }
}

}  // namespace orthodyn
