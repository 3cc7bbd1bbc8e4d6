// The section `harmonic`: frequencies and damping of a harmonic analysis, which computes the steady vibration under
// loads that vary as a cosine.
#pragma once

#include <optional>
#include <vector>

#include "lib/config/spec.h"

namespace orthodyn {

enum class Spacing { logarithmic, linear };

// Loss factors of a material: the energy lost in a cycle, over 2 pi times the largest elastic energy. Exactly one of
// `factor`, `quality` and `young` (with `shear`) is set.
struct MaterialLoss {
  std::optional<double> factor = {};              // the same for all strains
  std::optional<double> quality = {};             // Q, the reciprocal of `factor`
  std::optional<std::vector<double>> young = {};  // for E1, E2, E3
  std::optional<std::vector<double>> shear = {};  // for G12, G23, G31
  SourceLocation origin = {};
  static const Spec<MaterialLoss>& spec();
};

struct Harmonic {
  std::optional<double> from = {}, to = {};             // Hz
  std::optional<int> points = {};                       // with from and to: default 200
  std::optional<Spacing> spacing = {};                  // of the points; default logarithmic
  std::optional<bool> resonances = {};                  // also at and beside each natural frequency; default true
  std::optional<std::vector<double>> frequencies = {};  // Hz; instead of `from` and `to`
  double damping_ratio = 0;                             // of all modes, relative to critical damping
  Named<MaterialLoss> losses = {};                      // by material
  std::optional<Vec3> base_acceleration = {};           // amplitude of the acceleration of all supports, m/s^2
  std::optional<double> tap_seconds = {};               // s, duration of the sound of a tap; empty: no sound
  double rtol = 1e-4;                                   // of the amplitudes, in the energy norm
  SourceLocation origin = {};
  static const Spec<Harmonic>& spec();

  double lowest() const { return frequencies ? frequencies->front() : *from; }
  double highest() const { return frequencies ? frequencies->back() : *to; }
};

}  // namespace orthodyn
