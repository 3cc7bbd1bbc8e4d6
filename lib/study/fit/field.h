// A field of parameters: the stiffness factors of a region (lib/scene/stiffness_factors.h), one parameter of the search
// for each cell of the grid.
//
// Neighbouring cells are assumed to be similar. For each pair the difference of the logarithms of their factors has
// mean 0 and standard deviation `smoothness`. This is the discrete form of Tikhonov's regularisation of first order,
// and the prior of Bayesian inversion with a Gaussian Markov random field (Rue & Held 2005).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lib/config/config.h"
#include "lib/scene/stiffness_factors.h"

namespace orthodyn::study::fit {

struct ParameterField {
  std::string name, path;  // path: "regions.body.stiffness_factors"
  std::size_t first = 0;   // of the parameters of the problem
  StiffnessFactors factors;
  Box box;  // of the region, m
  double smoothness = 0;

  std::size_t size() const {
    std::size_t cells = 1;
    for (const int count : factors.grid) cells *= static_cast<std::size_t>(count);
    return cells;
  }
  // Indices of neighbouring parameters of the problem.
  std::vector<std::pair<std::size_t, std::size_t>> neighbours() const;
};

// Whether the path is the `stiffness_factors` of a region of the scene.
bool is_field(const std::string& path, const Config& scene);

// Writes a factor of 1 for each cell into a scene whose field has no values. Throws ConfigError for a field from a
// file.
void fill_values(const std::string& path, Config& scene);

// The field at this path. Precondition: is_field().
ParameterField read_field(const std::string& path, const Config& scene);

}  // namespace orthodyn::study::fit
