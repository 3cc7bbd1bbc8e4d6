// The finite element model of a scene, for Python.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "lib/simulation/run/setup.h"

namespace orthodyn::python {

using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

class SceneModel {
 public:
  explicit SceneModel(const Config& scene) : setup_(set_up(scene)) {}

  const FemModel& model() const { return *setup_.built.model; }
  const State& initial() const { return setup_.built.initial; }
  const Setup& setup() const { return setup_; }

  // Vectors contain only the free coordinates. A vector of another length raises ValueError.
  Vector force(double t, const ConstVectorRef& q, const ConstVectorRef& v) const;
  // Values of K and D on pattern(); D is empty without damping.
  std::pair<std::vector<double>, std::vector<double>> tangent(double t, const ConstVectorRef& q,
                                                              const ConstVectorRef& v, bool gauss_newton) const;
  std::vector<double> mass() const;
  Vector solve_mass(const ConstVectorRef& x) const;

  // (nodes, 3): number of each coordinate among the free ones, -1 if prescribed.
  std::vector<int> unknowns() const;
  std::vector<double> points() const;
  std::vector<double> evaluate(const std::string& name, double t, const ConstVectorRef& q,
                               const ConstVectorRef& v) const;

  // Frequencies in Hz; shapes (count x n), M-orthonormal; relative mesh errors. By parameter: derivatives of the
  // frequencies and, if wanted, of the shapes, NaN where there are none.
  struct FoundModes {
    std::vector<double> frequencies, shapes, mesh_errors;
    std::vector<std::vector<double>> frequency_slopes, shape_slopes;
  };
  FoundModes modes(int count, bool about_equilibrium, const std::vector<std::string>& parameters, bool of_shapes) const;
  // Displacements (m) of the free coordinates in static equilibrium under the loads at the end of the scene's time.
  Vector equilibrium() const;

 private:
  void require_size(const ConstVectorRef& x, const char* name) const;

  Setup setup_;
};

}  // namespace orthodyn::python
