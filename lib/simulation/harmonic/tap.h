// The sound of a tap: the velocity of a probe after an impulse of the loads, as a WAV file.
#pragma once

#include <filesystem>
#include <vector>

#include "lib/simulation/harmonic/harmonic_response.h"

namespace orthodyn {

inline constexpr int kSamplesPerSecond = 44100;

// The velocity of a column, m/s, at kSamplesPerSecond: the sum over the modes up to the highest frequency, each with
// the damping at its natural frequency. Rigid motions are left out, as are frequencies of 22 kHz or more. Precondition:
// the column is a motion.
std::vector<double> tap(const HarmonicResponse& response, std::size_t column, double seconds);

// Writes samples as 16-bit mono PCM, scaled to 0.9 of the range. Throws RunError if the file cannot be written.
void write_wav(const std::filesystem::path& path, const std::vector<double>& samples);

// Writes taps/PROBE.wav for each probe with a motion: of its component with the largest velocity.
void write_taps(const std::filesystem::path& folder, const HarmonicResponse& response, double seconds);

}  // namespace orthodyn
