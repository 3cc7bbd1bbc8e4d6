// Dead traction on a surface: f_i = factor(t) * integral of N_i t dA over the undeformed surface.
#pragma once

#include <memory>

#include "lib/fem/term.h"
#include "lib/fem/time_function.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

double surface_area(const TetMesh& mesh, const std::vector<Triangle>& triangles);  // m^2

class Traction : public Term {
 public:
  // traction in Pa, per undeformed area.
  Traction(std::string surface, const TetMesh& mesh, const std::vector<Triangle>& triangles,
           const Vec3& traction, std::shared_ptr<const TimeFunction> factor);

  std::string description() const override { return "traction on " + surface_; }
  void add_force(const NodalState& s, NodalVector& f) const override;
  void add_peak_force(const NodalState& s, NodalVector& f) const override;
  double load_power(const NodalState& s) const override;
  std::vector<double> breakpoints(double start, double end) const override;

 private:
  std::string surface_;
  std::vector<std::pair<int, Vec3>> forces_;  // node, N at factor 1
  std::shared_ptr<const TimeFunction> factor_;
};

}  // namespace orthodyn
