#include "integrators/native/oscillator.h"

#include <cmath>
#include <cstddef>

namespace orthodyn {
namespace {

constexpr double kSeries = 4;  // largest x and sqrt(y) for the series, which then loses at most two digits
constexpr std::size_t kCount = kLoadTerms + 2;

struct Factorials {
  std::array<double, kCount> reciprocal{};
  Factorials() {
    reciprocal[0] = 1;
    for (std::size_t k = 1; k < kCount; ++k) reciprocal[k] = reciprocal[k - 1] / static_cast<double>(k);
  }
};
const Factorials kFactorials;

OscillatorPhi by_series(double x, double y) {
  OscillatorPhi phi = kFactorials.reciprocal, term = phi;  // 1/(k+j)!
  double before = 0, b = 1;
  for (int j = 1; j <= 60; ++j) {
    const double next = -x * b - y * before;
    before = b;
    b = next;
    for (std::size_t k = 0; k < kCount; ++k) {
      term[k] /= static_cast<double>(k) + j;
      phi[k] += b * term[k];
    }
    if ((std::abs(b) + std::abs(before) * kSeries) * term[0] < 1e-20) break;
  }
  return phi;
}

// For complex roots and for real roots close to each other: y is large, and y >= x^2/8.
OscillatorPhi by_recursion(double x, double y) {
  OscillatorPhi phi;
  const double discriminant = y - x * x / 4;
  if (discriminant >= 0) {
    const double w = std::sqrt(discriminant), decay = std::exp(-x / 2);
    phi[1] = decay * (w > 1e-4 ? std::sin(w) / w : 1 - w * w / 6);
    phi[0] = decay * std::cos(w) - x / 2 * phi[1];
  } else {
    const double w = std::sqrt(-discriminant), decay = std::exp(-y / (x / 2 + w));  // exp(w - x/2)
    phi[1] = decay * (w > 1e-4 ? -std::expm1(-2 * w) / (2 * w) : 1 - w);
    phi[0] = decay * (1 + std::exp(-2 * w)) / 2 - x / 2 * phi[1];
  }
  for (std::size_t k = 0; k + 2 < kCount; ++k) phi[k + 2] = (kFactorials.reciprocal[k] - phi[k] - x * phi[k + 1]) / y;
  return phi;
}

// The phi functions of one argument z <= 0: phi_0 = exp(z), phi_{k+1} = (phi_k - 1/k!) / z.
OscillatorPhi single_root_phi(double z) {
  OscillatorPhi phi;
  if (z > -1) {
    phi = kFactorials.reciprocal;
    OscillatorPhi term = phi;
    for (int j = 1; j <= 20; ++j)
      for (std::size_t k = 0; k < kCount; ++k) phi[k] += term[k] *= z / (static_cast<double>(k) + j);
    return phi;
  }
  phi[0] = std::exp(z);
  for (std::size_t k = 0; k + 1 < kCount; ++k) phi[k + 1] = (phi[k] - kFactorials.reciprocal[k]) / z;
  return phi;
}

// For two real roots, one at least five times the other.
OscillatorPhi by_differences(double x, double y) {
  const double w = std::sqrt(x * x / 4 - y), far = -(x / 2 + w), near = y / far, distance = near - far;
  const OscillatorPhi at_near = single_root_phi(near), at_far = single_root_phi(far);
  OscillatorPhi phi;
  phi[0] = (near * at_near[0] - far * at_far[0]) / distance;
  for (std::size_t k = 1; k < kCount; ++k) phi[k] = (at_near[k - 1] - at_far[k - 1]) / distance;
  return phi;
}

}  // namespace

OscillatorPhi oscillator_phi(double x, double y) {
  if (x <= kSeries && y <= kSeries * kSeries) return by_series(x, y);
  return y >= x * x / 8 ? by_recursion(x, y) : by_differences(x, y);
}

Oscillation oscillate(double d, double lambda, Oscillation start, const ConstVectorRef& c, double h, double tau) {
  const double x = d * tau, y = lambda * tau * tau;
  const OscillatorPhi phi = oscillator_phi(x, y);
  Oscillation now{start.r * (phi[0] + x * phi[1]) + start.rate * tau * phi[1],
                  start.rate * phi[0] - lambda * start.r * tau * phi[1]};
  double weight = 1;  // k! (tau/h)^k
  for (Eigen::Index k = 0; k < c.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    now.r += c[k] * weight * tau * tau * phi[at + 2];
    now.rate += c[k] * weight * tau * phi[at + 1];
    weight *= (static_cast<double>(k) + 1) * tau / h;
  }
  return now;
}

}  // namespace orthodyn
