// The dominant oscillation of a signal that is sampled evenly, and the phase between two signals.
#pragma once

#include <optional>

#include "lib/core/types.h"

namespace orthodyn {

// The frequency (rad/s) at which the Hann-windowed Fourier transform of the signal, its mean taken out,
// is largest; none if there are fewer than 1.5 periods in the samples. `interval` in s.
std::optional<double> dominant_frequency(const Vector& signal, double interval);

// By how much `signal` lags or leads `reference` at a frequency, rad in [0, pi].
double phase_difference(const Vector& signal, const Vector& reference, double omega, double interval);

}  // namespace orthodyn
