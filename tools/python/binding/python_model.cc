#include "tools/python/binding/python_model.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>

#include <algorithm>

#include "lib/core/errors.h"

namespace orthodyn::python {

namespace {

namespace py = pybind11;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// A copy, so that an array that Python keeps does not change later.
Numbers copied(const ConstVectorRef& x) { return Numbers(static_cast<py::ssize_t>(x.size()), x.data()); }

Numbers numbers(const py::object& given, py::ssize_t size, const char* what) {
  const auto array = given.is_none() ? Numbers() : Numbers::ensure(given);
  if (given.is_none() || !array) {
    PyErr_Clear();
    throw py::type_error(fmt::format("{} is not an array of numbers", what));
  }
  if (array.size() != size)
    throw py::value_error(fmt::format("{} has {} numbers, expected {}", what, array.size(), size));
  return array;
}

}  // namespace

PythonModel::PythonModel(PythonModelParts parts) : parts_(std::move(parts)) {
  const Pattern& pattern = parts_.pattern;
  for (int j = 0; j < pattern.n; ++j) {
    const auto begin = pattern.row.begin() + pattern.column_start[static_cast<std::size_t>(j)];
    const auto end = pattern.row.begin() + pattern.column_start[static_cast<std::size_t>(j) + 1];
    diagonal_.push_back(static_cast<std::size_t>(std::lower_bound(begin, end, j) - pattern.row.begin()));
  }
  traits_.linear = parts_.linear;
  traits_.damping_matrix = parts_.damped;
  traits_.time_dependent = parts_.time_dependent;
  traits_.conservative = false;
}

template <class Call>
py::object PythonModel::called(Call&& call) const {
  try {
    return call();
  } catch (const py::builtin_exception& error) {  // the function returned an unusable value
    thrown_ = std::current_exception();
    throw RunError(error.what());
  } catch (const py::error_already_set& error) {
    if (error.matches(py::module_::import("orthodyn._core").attr("RecoverableError")))
      throw RecoverableError(error.what());
    thrown_ = std::current_exception();
    throw RunError(error.what());
  }
}

void PythonModel::force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const {
  const Numbers out = called([&] { return numbers(parts_.force(t, copied(q), copied(v)), q.size(), "the force"); });
  f = Eigen::Map<const Vector>(out.data(), q.size());
}

void PythonModel::combine(const Weights& w, const Linearization& at, double* values) const {
  for (std::size_t i = 0; i < at.stiffness.size(); ++i) {
    values[i] = w.stiffness * at.stiffness[i];
    if (!at.damping.empty()) values[i] += w.damping * at.damping[i];
  }
  for (std::size_t j = 0; j < diagonal_.size(); ++j)
    values[diagonal_[j]] += w.mass * parts_.mass[static_cast<Eigen::Index>(j)];
}

void PythonModel::assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind,
                           Linearization& out) const {
  const auto values = [&](const py::object& given, const char* what) {
    const Numbers array = numbers(given, parts_.pattern.non_zeros(), what);
    return std::vector<double>(array.data(), array.data() + array.size());
  };
  called([&]() -> py::object {
    const py::object both = parts_.tangent(t, copied(q), copied(v));
    if (!py::isinstance<py::tuple>(both) || py::len(both) != 2)
      throw py::type_error("the tangent is not a pair (K, D)");
    const auto pair = both.cast<py::tuple>();
    out.stiffness = values(pair[0], "the stiffness");
    out.damping.clear();
    if (parts_.damped) out.damping = values(pair[1], "the damping");
    return py::none();
  });
}

}  // namespace orthodyn::python
