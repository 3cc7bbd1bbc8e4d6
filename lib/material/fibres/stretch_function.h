// A function g of the strain x = lambda - 1 of a fibre with the stretch lambda: a nominal stress (Pa), or a factor.
#pragma once

namespace orthodyn {

class StretchFunction {
 public:
  virtual ~StretchFunction() = default;
  virtual double value(double x) const = 0;
  virtual double slope(double x) const = 0;     // right-hand value at a kink
  virtual double integral(double x) const = 0;  // antiderivative; not negative for lambda >= 0

  // The mean between x0 and x1: (integral(x1) - integral(x0)) / (x1 - x0), without cancellation for x1 near x0.
  virtual double mean(double x0, double x1) const = 0;

  // Upper bound of |slope| near lambda = 1.
  virtual double slope_bound() const = 0;
  // Upper bound of the values; infinite if there is none.
  virtual double value_bound() const = 0;
};

// The mean by Gauss quadrature with five points, for functions that are smooth from x0 to x1.
double gauss_mean(const StretchFunction& g, double x0, double x1);

}  // namespace orthodyn
