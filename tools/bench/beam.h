// The beam for benchmarks of kernels and solvers, bent and twisted to strains of a few per cent.
#pragma once

#include "lib/scene/build.h"

namespace orthodyn::bench {

struct Beam {
  bool damped = false;
  int order = 1;                                // order of the elements
  std::string material = "orthotropic_stable";  // or isotropic
  std::string elements = "tetrahedra";          // `elements` of a box mesh
  std::string formulation = "auto";
};

// A mesh of `across` cells over height and width and 5 * `across` cells along the beam.
class BentBeam {
 public:
  BentBeam(const Beam& beam, int across);

  const FemModel& model() const { return *built_.model; }
  const Vector& q() const { return q_; }
  const Vector& v() const { return v_; }
  int num_elements() const { return elements_; }

 private:
  BuiltScene built_;
  Vector q_, v_;
  int elements_;
};

}  // namespace orthodyn::bench
