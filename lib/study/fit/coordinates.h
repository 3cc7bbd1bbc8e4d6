// The unbounded coordinates z in which a fit searches its parameters: one coordinate per parameter.
//
// log: value = exp(z). linear: value = scale z. Poisson's ratios of a material: z is the position in the interval of
// ratios for which the material is stable given its other constants, by the logistic function. In the scaled ratios
// r_ij = nu_ij sqrt(E_j / E_i) an orthotropic material is stable if the matrix with unit diagonal and entries -r_ij is
// positive definite, so that
//
//     |r12| < 1,  |r13| < 1,  -r23 in  r12 r13 -+ sqrt((1 - r12^2)(1 - r13^2)).
//
// The last condition is |partial correlation of 2 and 3 given 1| < 1. With all three ratios fitted, each point z is a
// stable material, and each stable material is a point z. A ratio that is not fitted keeps its value, and intervals of
// the others are those that it leaves.
//
// Source of the parametrisation by partial correlations: Joe, J. Multivariate Analysis 97, 2006.
#pragma once

#include <complex>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/config.h"
#include "lib/core/types.h"

namespace orthodyn::study::fit {

class Coordinates {
 public:
  using Complex = std::complex<double>;
  // The ends of a ratio's interval, from the values of all parameters that come before it in the order of evaluation.
  using Interval = std::function<std::pair<Complex, Complex>(const std::vector<Complex>& values)>;

  // One parameter more. `scale`: value at z = 1.
  void add_log();
  void add_linear(double scale);
  // A placeholder for a ratio, whose interval follows by set_interval().
  void add_ratio() { transforms_.push_back({Kind::ratio, 1, {}}); }
  // Intervals are evaluated in the order of these calls, after all other values.
  void set_interval(std::size_t parameter, Interval interval);

  std::size_t size() const { return transforms_.size(); }
  bool is_log(std::size_t parameter) const { return transforms_[parameter].kind == Kind::log; }
  bool is_ratio(std::size_t parameter) const { return transforms_[parameter].kind == Kind::ratio; }

  // Parameter values in SI units. Not finite if fixed constants exclude every stable material.
  Vector values(const Vector& z) const;
  // d values / d z, by complex steps.
  Eigen::MatrixXd derivatives(const Vector& z) const;
  // The inverse of values(). NaN for values outside of the range of a coordinate.
  Vector at(const Vector& values) const;
  // The coordinate of one value of a parameter that is no ratio.
  double at(std::size_t parameter, double value) const;

 private:
  enum class Kind { log, linear, ratio };
  struct Transform {
    Kind kind;
    double scale;
    Interval interval;
  };
  std::vector<Complex> complex_values(const std::vector<Complex>& z) const;

  std::vector<Transform> transforms_;
  std::vector<std::size_t> order_;  // of the ratios
};

// A constant of a material: a parameter of the fit, or a number.
struct Constant {
  std::optional<std::size_t> parameter;
  double number = 0;
  Coordinates::Complex of(const std::vector<Coordinates::Complex>& values) const {
    return parameter ? values[*parameter] : number;
  }
};

// Whether a path is a Poisson's ratio of a material whose range depends on stability.
bool is_poisson_ratio(const std::string& path, const Config& scene);

// A path of a parameter, and a scene that has it.
struct PathOfParameter {
  std::size_t parameter;
  std::string path;
  Config scene;
};

// Sets the intervals of all ratios. Throws ConfigError for a material that gives both nu_ij and nu_ji.
void set_intervals(Coordinates& coordinates, const std::vector<PathOfParameter>& paths);

}  // namespace orthodyn::study::fit
