#include "lib/simulation/error_estimate/dominant_frequency.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace orthodyn {

namespace {

constexpr double kPi = std::numbers::pi;

std::complex<double> transform(const Vector& signal, double omega, double interval) {
  const auto n = signal.size();
  const double mean = signal.mean();
  std::complex<double> sum = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double window = 0.5 - 0.5 * std::cos(2 * kPi * static_cast<double>(k) / static_cast<double>(n - 1));
    sum += window * (signal[k] - mean) * std::polar(1.0, -omega * interval * static_cast<double>(k));
  }
  return sum;
}

// Golden-section search for the maximum of a function with one peak in [low, high].
template <class F>
double golden_maximum(F&& f, double low, double high) {
  const double ratio = std::numbers::phi - 1;
  for (int i = 0; i < 60; ++i) {
    const double a = high - ratio * (high - low), b = low + ratio * (high - low);
    if (f(a) < f(b)) low = a;
    else high = b;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::optional<double> dominant_frequency(const Vector& signal, double interval) {
  const auto n = signal.size();
  if (n < 8) return std::nullopt;
  const double span = interval * static_cast<double>(n - 1), bin = 2 * kPi / span;
  const auto amplitude = [&](double omega) { return std::abs(transform(signal, omega, interval)); };
  double best = 0, at = 0;
  for (double omega = 0.5 * bin; omega < kPi / interval; omega += 0.25 * bin)
    if (const double a = amplitude(omega); a > best) best = a, at = omega;
  if (best == 0) return std::nullopt;
  const double refined = golden_maximum(amplitude, at - 0.25 * bin, at + 0.25 * bin);
  if (refined < 1.5 * bin) return std::nullopt;
  return refined;
}

double phase_difference(const Vector& signal, const Vector& reference, double omega, double interval) {
  const auto ratio = transform(signal, omega, interval) * std::conj(transform(reference, omega, interval));
  return std::abs(std::arg(ratio));
}

}  // namespace orthodyn
