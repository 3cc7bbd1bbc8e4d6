// orthodyn._core, the compiled module. The Python modules in orthodyn/ are its user interface.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cctype>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lib/core/versions.h"
#include "lib/simulation/sensitivity/gradient.h"
#include "lib/simulation/simulation.h"
#include "tools/python/binding/arrays.h"
#include "tools/python/binding/integrate.h"
#include "tools/python/binding/listener.h"
#include "tools/python/binding/python_model.h"
#include "tools/python/binding/scene_model.h"

namespace orthodyn::python {

namespace {

constexpr std::pair<const char*, const char*> kWords[] = {{"--estimate-error", "estimate_error=True"},
                                                          {"--force", "force=True"},
                                                          {"--resume", "resume=True"},
                                                          {"--retry", "retry=True"},
                                                          {"--integrator", "with_integrator"},
                                                          {"--jobs", "jobs"},
                                                          {"--out", "out"},
                                                          {"--set", "set"}};

bool is_part_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '/'; }

// Replaces program options in a message by Python arguments: "use --force to replace it" becomes "use force=True to
// replace it".
std::string in_python(std::string message) {
  for (const auto& [option, argument] : kWords) {
    const std::string_view word = option;
    for (auto at = message.find(word); at != std::string::npos; at = message.find(word, at + 1)) {
      const auto after = at + word.size();
      if (at > 0 && is_part_of_word(message[at - 1])) continue;
      if (after < message.size() && is_part_of_word(message[after])) continue;
      message.replace(at, word.size(), argument);
    }
  }
  return message;
}

// Declares the Python exception `name`, which is raised for a C++ exception of type E.
template <class E>
void declare_error(py::module_& m, const char* name, PyObject* base, const char* doc) {
  static py::exception<E> type(m, name, base);
  type.doc() = doc;
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const E& e) {
      PyErr_SetString(type.ptr(), in_python(e.what()).c_str());
    }
  });
}

void declare_errors(py::module_& m) {
  declare_error<ConfigError>(m, "ConfigError", PyExc_ValueError,
                             "Invalid input: what was found, where (file:line), what is allowed, what to do.");
  declare_error<RunError>(m, "RunError", PyExc_RuntimeError,
                          "A computation failed: the time reached, the reason, what to try.");
  py::register_exception<RecoverableError>(m, "RecoverableError", PyExc_RuntimeError).doc() =
      "The state cannot be evaluated; raise it in a Problem to request a smaller step.";
}

py::tuple run_simulation(const Simulation& simulation, const std::string& folder, bool force, bool resume,
                         bool estimate_error, std::optional<std::vector<std::string>> fields, py::object callbacks) {
  Listener listener(std::move(callbacks), std::move(fields));
  RunResult result;
  {
    const py::gil_scoped_release unlocked;
    result = simulation.run({.folder = folder, .force = force, .resume = resume, .estimate_error = estimate_error},
                            listener.interrupt(), listener);
  }
  listener.rethrow();
  return py::make_tuple(status_word(result.outcome.status), result.outcome.message, listener.take_recording());
}

void declare_simulation(py::module_& m) {
  py::class_<Simulation>(m, "Simulation", "A scene that can be run, once or several times.")
      .def_static(
          "from_text",
          [](const std::string& text, const std::string& name, std::vector<std::string> set,
             std::optional<std::string> integrator) {
            return Simulation::from_text(text, name, {std::move(set), std::move(integrator)});
          },
          py::arg("text"), py::arg("name"), py::arg("set") = std::vector<std::string>(),
          py::arg("integrator") = py::none())
      .def("resolved", [](const Simulation& s) { return s.scene().dump(); })
      .def("run", run_simulation, py::arg("folder"), py::arg("force"), py::arg("resume"), py::arg("estimate_error"),
           py::arg("fields"), py::arg("listener"));
}

using Released = py::call_guard<py::gil_scoped_release>;

void declare_scene_model(py::module_& m) {
  py::class_<SceneModel>(m, "SceneModel", "The finite element model of a scene, on its free coordinates.")
      .def(py::init([](const Simulation& simulation) { return std::make_unique<SceneModel>(simulation.scene()); }))
      .def_property_readonly("n", [](const SceneModel& s) { return s.model().num_dofs(); })
      .def_property_readonly("t0", [](const SceneModel& s) { return s.initial().t; })
      .def_property_readonly("q0", [](const SceneModel& s) { return s.initial().q; })
      .def_property_readonly("v0", [](const SceneModel& s) { return s.initial().v; })
      .def("force", &SceneModel::force, Released())
      .def("solve_mass", &SceneModel::solve_mass, Released())
      .def("equilibrium", &SceneModel::equilibrium, Released())
      .def("pattern",
           [](const SceneModel& s) {
             const Pattern& p = s.model().pattern();
             return py::make_tuple(array_of(p.column_start), array_of(p.row), p.symmetric);
           })
      .def("tangent",
           [](const SceneModel& s, double t, const Vector& q, const Vector& v, bool gauss_newton) {
             std::pair<std::vector<double>, std::vector<double>> found;
             {
               const py::gil_scoped_release unlocked;
               found = s.tangent(t, q, v, gauss_newton);
             }
             return py::make_tuple(array_of(std::move(found.first)), array_of(std::move(found.second)));
           })
      .def("mass", [](const SceneModel& s) { return array_of(s.mass()); })
      .def("modes",
           [](const SceneModel& s, int count, bool about_equilibrium, const std::vector<std::string>& parameters,
              bool of_shapes) {
             SceneModel::FoundModes found;
             {
               const py::gil_scoped_release unlocked;
               found = s.modes(count, about_equilibrium, parameters, of_shapes);
             }
             const auto k = static_cast<py::ssize_t>(found.frequencies.size());
             py::list frequency_slopes, shape_slopes;
             for (auto& slopes : found.frequency_slopes) frequency_slopes.append(array_of(std::move(slopes)));
             for (auto& slopes : found.shape_slopes)
               shape_slopes.append(array_of(std::move(slopes), {k, s.model().num_dofs()}));
             return py::make_tuple(array_of(std::move(found.frequencies)),
                                   array_of(std::move(found.shapes), {k, s.model().num_dofs()}),
                                   array_of(std::move(found.mesh_errors)), frequency_slopes, shape_slopes);
           })
      .def("gradient",
           [](const SceneModel& s, const std::string& quantity, std::optional<double> at,
              const std::vector<std::string>& paths) {
             Gradient found;
             {
               const py::gil_scoped_release unlocked;
               found = gradient(s.setup().config, {quantity, at, paths});
             }
             std::vector<std::string> names;
             for (const SceneParameter& parameter : found.parameters) names.push_back(parameter.path());
             return py::make_tuple(found.value, names, array_of(std::move(found.derivatives)));
           })
      .def("unknowns",
           [](const SceneModel& s) {
             return array_of(s.unknowns(), {static_cast<py::ssize_t>(s.model().parts().dofs->num_nodes()), 3});
           })
      .def("points",
           [](const SceneModel& s) {
             return array_of(s.points(), {static_cast<py::ssize_t>(s.model().parts().dofs->num_nodes()), 3});
           })
      .def("evaluate", [](const SceneModel& s, const std::string& name, double t, const Vector& q,
                          const Vector& v) { return array_of(s.evaluate(name, t, q, v)); })
      .def("outputs", [](const SceneModel& s) {
        py::list out;
        for (const OutputInfo& info : s.model().outputs())
          out.append(
              py::make_tuple(info.name, static_cast<int>(info.location), info.components, info.unit, info.sentence));
        return out;
      });
}

Pattern pattern_of(const std::vector<int>& column_start, const std::vector<int>& row, bool symmetric) {
  return {static_cast<int>(column_start.size()) - 1, symmetric, column_start, row, {}};
}

void declare_own_models(py::module_& m) {
  py::class_<PythonModel>(m, "PythonModel", "M q'' = f(t, q, v) defined by Python functions.")
      .def(py::init([](const Vector& mass, py::function force, py::object tangent, const std::vector<int>& column_start,
                       const std::vector<int>& row, bool symmetric, bool damped, bool linear, bool time_dependent) {
        return std::make_unique<PythonModel>(PythonModelParts{mass, std::move(force), std::move(tangent),
                                                              pattern_of(column_start, row, symmetric), damped, linear,
                                                              time_dependent});
      }))
      .def("integrate",
           [](const PythonModel& model, const std::string& integrator, double t0, const Vector& q0, const Vector& v0,
              const std::vector<double>& times, double position_scale, double velocity_scale) {
             return integrate(model, {integrator, {t0, q0, v0}, times, position_scale, velocity_scale});
           });
}

}  // namespace

// Option names of each integrator.
py::dict integrators() {
  py::dict out;
  for (const auto& [name, entry] : Registry<IntegratorChoice>::entries()) {
    py::list keys;
    for (const Key& key : entry.keys) keys.append(key.name);
    out[name.c_str()] = keys;
  }
  return out;
}

PYBIND11_MODULE(_core, m) {
  m.doc() = "The compiled part of orthodyn.";
  m.attr("version") = orthodyn_version();
  declare_errors(m);
  declare_simulation(m);
  declare_scene_model(m);
  declare_own_models(m);
  m.def("integrators", integrators);
  m.def("in_python", in_python);
}

}  // namespace orthodyn::python
