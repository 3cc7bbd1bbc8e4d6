#include "lib/material/fibres/stretch_function.h"

#include <array>

namespace orthodyn {

double gauss_mean(const StretchFunction& g, double x0, double x1) {
  // Abramowitz & Stegun, table 25.4.
  constexpr std::array<double, 2> kAbscissas{0.538469310105683091, 0.906179845938663993};
  constexpr std::array<double, 2> kWeights{0.478628670499366468, 0.236926885056189088};
  constexpr double kMiddle = 0.568888888888888889;
  const double middle = 0.5 * (x0 + x1), half = 0.5 * (x1 - x0);
  double sum = kMiddle * g.value(middle);
  for (std::size_t i = 0; i < kWeights.size(); ++i)
    sum += kWeights[i] * (g.value(middle - half * kAbscissas[i]) + g.value(middle + half * kAbscissas[i]));
  return 0.5 * sum;
}

}  // namespace orthodyn
