// Forces on nodes that keep their direction: f_i = factor(t) F_i.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/fem/term.h"
#include "lib/fem/time_function.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

class DeadLoad : public Term {
 public:
  using NodalForces = std::vector<std::pair<int, Vec3>>;  // node, N at factor 1

  DeadLoad(std::string description, NodalForces forces, std::shared_ptr<const TimeFunction> factor);

  std::string description() const override { return description_; }
  void add_force(const NodalState& s, NodalVector& f) const override;
  void add_peak_force(const NodalState& s, NodalVector& f) const override;
  double load_power(const NodalState& s) const override;
  std::vector<double> breakpoints(double start, double end) const override;

 private:
  std::string description_;
  NodalForces forces_;
  std::shared_ptr<const TimeFunction> factor_;
};

// The times of `all` within (start, end).
std::vector<double> times_between(const std::vector<double>& all, double start, double end);

double surface_area(const TetMesh& mesh, const std::vector<Triangle>& triangles);  // m^2

// A traction (Pa, per undeformed area) on a surface: F_i = integral of N_i t dA.
DeadLoad::NodalForces surface_forces(const TetMesh& mesh, const std::vector<Triangle>& triangles, const Vec3& traction);

}  // namespace orthodyn
