#include "integrators/sundials/vector_operations.h"

#include <nvector/nvector_serial.h>

#include <cmath>
#include <type_traits>

#include "lib/core/types.h"

namespace orthodyn::sundials {

namespace {

static_assert(std::is_same_v<sunrealtype, double>);

using Index = Eigen::Index;

template <int size>
using Part = Eigen::Array<double, size, 1>;

// Blocks of fixed length, counted from the first entry, so that the order of summation does not depend on alignment.
constexpr int kBlock = 32;

Index length(N_Vector v) { return static_cast<Index>(NV_LENGTH_S(v)); }

template <int size>
auto part(N_Vector v, Index i) {
  return Eigen::Map<Part<size>>(NV_DATA_S(v) + i);
}

// Calls body<size>(i) for all parts [i, i + size).
template <class Body>
void for_each_part(Index n, const Body& body) {
  Index i = 0;
  for (; i + kBlock <= n; i += kBlock) body.template operator()<kBlock>(i);
  for (; i < n; ++i) body.template operator()<1>(i);
}

// The sum over all entries, where term<size>(i) returns an array of entries i to i + size - 1.
template <class Term>
double sum(Index n, const Term& term) {
  Part<kBlock> sums = Part<kBlock>::Zero();
  Index i = 0;
  for (; i + kBlock <= n; i += kBlock) sums += term.template operator()<kBlock>(i);
  double total = sums.sum();
  for (; i < n; ++i) total += term.template operator()<1>(i).value();
  return total;
}

// z = a x + b y; z may be x or y. If a = -b, the result for equal entries of x and y is exactly 0.
void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
  if (a == -b)
    return for_each_part(length(z),
                         [=]<int size>(Index i) { part<size>(z, i) = a * (part<size>(x, i) - part<size>(y, i)); });
  for_each_part(length(z), [=]<int size>(Index i) { part<size>(z, i) = a * part<size>(x, i) + b * part<size>(y, i); });
}

void set_all(double c, N_Vector z) {
  for_each_part(length(z), [=]<int size>(Index i) { part<size>(z, i).setConstant(c); });
}

void scale(double c, N_Vector x, N_Vector z) {
  for_each_part(length(z), [=]<int size>(Index i) { part<size>(z, i) = c * part<size>(x, i); });
}

double dot_product(N_Vector x, N_Vector y) {
  return sum(length(x), [=]<int size>(Index i) -> Part<size> { return part<size>(x, i) * part<size>(y, i); });
}

// Root of the mean of (x w)^2.
double wrms_norm(N_Vector x, N_Vector w) {
  const Index n = length(x);
  const double squares =
      sum(n, [=]<int size>(Index i) -> Part<size> { return (part<size>(x, i) * part<size>(w, i)).square(); });
  return std::sqrt(squares / static_cast<double>(n));
}

// z = sum of c_k x_k; z may be one of them.
int linear_combination(int count, double* c, N_Vector* x, N_Vector z) {
  if (count < 1) return -1;
  for_each_part(length(z), [=]<int size>(Index i) {
    Part<size> sums = c[0] * part<size>(x[0], i);
    for (int k = 1; k < count; ++k) sums += c[k] * part<size>(x[k], i);
    part<size>(z, i) = sums;
  });
  return 0;
}

// z_k = a_k x + y_k; z_k may be y_k.
int scale_add_multi(int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) {
  for_each_part(length(x), [=]<int size>(Index i) {
    const Part<size> shared = part<size>(x, i);
    for (int k = 0; k < count; ++k) part<size>(z[k], i) = a[k] * shared + part<size>(y[k], i);
  });
  return 0;
}

}  // namespace

void use_fast_operations(N_Vector v) {
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvconst = set_all;
  v->ops->nvscale = scale;
  v->ops->nvdotprod = dot_product;
  v->ops->nvwrmsnorm = wrms_norm;
  v->ops->nvlinearcombination = linear_combination;
  v->ops->nvscaleaddmulti = scale_add_multi;
}

}  // namespace orthodyn::sundials
