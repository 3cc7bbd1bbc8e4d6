// Follower pressure on a surface: every triangle (x0, x1, x2), outward normal, gets
//   f_i = -p(t) a/3,  a = (x1 - x0) x (x2 - x0)/2,  on each of its nodes: exact for linear triangles.
//
// A surface without boundary has the energy p V; the force of an open one has none, so its work counts as that
// of a load. Of the derivative -df_i/dx_b = p/6 [x_{b+2} - x_{b+1}] a symmetric pattern takes the symmetric
// part p/12 ([..]_b - [..]_a): exact where the surface is closed, or its edge held; elsewhere the Newton matrix
// is approximate and the force exact (Hibbitt 1979, Some follower forces and load stiffness).
#pragma once

#include <memory>

#include "lib/fem/block_pattern.h"
#include "lib/fem/term.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

class Pressure : public Term {
 public:
  // pressure in Pa, pushing against the outward normal; the pattern must outlive the term.
  Pressure(std::string surface, std::vector<Triangle> triangles, double pressure,
           std::shared_ptr<const TimeFunction> factor, const BlockPattern& pattern);

  std::string name() const override { return "pressure on " + surface_; }
  std::size_t bytes() const override { return triangles_.capacity() * sizeof(Triangle); }
  void add_force(const NodalState& s, NodalVector& f) const override;
  void add_peak_force(const NodalState& s, double end, NodalVector& f) const override;
  void add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double* damping) const override;
  double load_power(const NodalState& s) const override;
  std::vector<double> breakpoints(double start, double end) const override;

 private:
  void add_force_of(double pressure, const NodalVector& x, NodalVector& f) const;

  std::string surface_;
  std::vector<Triangle> triangles_;
  double pressure_;
  std::shared_ptr<const TimeFunction> factor_;
  const BlockPattern& pattern_;
};

}  // namespace orthodyn
