// The dominant frequency of an evenly sampled signal, and the phase difference of two signals.
#pragma once

#include <optional>

#include "lib/core/types.h"

namespace orthodyn {

// Frequency (rad/s) at which the Hann-windowed Fourier transform of the signal, without its mean, is largest. Empty if
// the signal is constant, has fewer than 8 samples or spans fewer than 1.5 periods. `interval`: sampling interval, s.
std::optional<double> dominant_frequency(const Vector& signal, double interval);

// Absolute phase difference (rad, in [0, pi]) between the signals at frequency omega (rad/s).
double phase_difference(const Vector& signal, const Vector& reference, double omega, double interval);

}  // namespace orthodyn
