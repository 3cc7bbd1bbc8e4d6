// The frequencies of a harmonic analysis.
#pragma once

#include <vector>

#include "lib/scene/harmonic.h"

namespace orthodyn {

struct Resonance {
  double frequency = 0;                                     // natural frequency, Hz; 0 for a rigid mode
  double loss_factor = 0;                                   // at the natural frequency: twice the damping ratio
  double width() const { return frequency * loss_factor; }  // half-power bandwidth, Hz
};

// The requested frequencies; with Harmonic::resonances also each natural frequency in the range, and frequencies beside
// it, up to halfway to its neighbours, at most half a bandwidth apart near the peak and less dense away from it.
// Ascending.
std::vector<double> frequency_grid(const Harmonic& harmonic, const std::vector<Resonance>& resonances);

// Frequencies at which the error is estimated, ascending: about ten of the grid, with the first and the last, and some
// of the natural frequencies (Hz) between them.
std::vector<double> check_frequencies(const std::vector<double>& grid, const std::vector<double>& natural);

// The numbers, from 1, of the resonances in the range whose peak can lie between two frequencies of the grid: none is
// within half a bandwidth of the natural frequency.
std::vector<int> missed_resonances(const std::vector<double>& grid, const std::vector<Resonance>& resonances);

}  // namespace orthodyn
