// Follower pressure on a surface: every triangle (x0, x1, x2), outward normal, gets
//   f_i = -factor(t) p_i a,  a = (x1 - x0) x (x2 - x0)/2,
// on each of its nodes, where p_i is the mean over it of N_i p at rest: p/3 of a uniform pressure. Exact for linear
// triangles.
//
// A surface without boundary under uniform pressure has the energy p V; the force of others has none, so its work
// counts as that of a load. Of the derivative -df_i/dx_b = p_i/2 [x_{b+2} - x_{b+1}] a symmetric pattern takes the
// symmetric part (p_i [..]_b - p_b [..]_i)/4: exact where the pressure is uniform on a closed surface, or on one whose
// edge is held; elsewhere the Newton matrix is approximate and the force exact (Hibbitt 1979, Some follower forces and
// load stiffness).
#pragma once

#include <memory>

#include "lib/fem/block_pattern.h"
#include "lib/fem/term.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

struct PressedTriangle {
  Triangle nodes;
  Vec3 pressures;  // p_i of each node, Pa; positive where it pushes against the outward normal

  // The force -p_i a on node i, at positions x (m), N.
  Vec3 force(const NodalVector& x, std::size_t i) const;
};

class Pressure : public Term {
 public:
  // The pattern must outlive the term.
  Pressure(std::string surface, std::vector<PressedTriangle> triangles, std::shared_ptr<const TimeFunction> factor,
           const BlockPattern& pattern);

  std::string name() const override { return "pressure on " + surface_; }
  std::string description() const override { return name() + ": follows the surface"; }
  std::size_t bytes() const override { return triangles_.capacity() * sizeof(PressedTriangle); }
  void add_force(const NodalState& s, NodalVector& f) const override;
  void add_peak_force(const NodalState& s, double end, NodalVector& f) const override;
  void add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double* damping) const override;
  double load_power(const NodalState& s) const override;
  std::vector<double> breakpoints(double start, double end) const override;

 private:
  void add_force_of(double factor, const NodalVector& x, NodalVector& f) const;

  std::string surface_;
  std::vector<PressedTriangle> triangles_;
  std::shared_ptr<const TimeFunction> factor_;
  const BlockPattern& pattern_;
};

}  // namespace orthodyn
