// From a comparison to its points: every scene as it will run, with every method and control.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lib/study/comparison.h"

namespace orthodyn {

using Assignments = std::vector<std::pair<std::string, std::string>>;  // path and YAML value

// A scene with its physics fixed: what errors are measured on.
struct Problem {
  std::string id, label;
  std::string file;
  Assignments set;
};

// An integrator with its options fixed, but for what controls its error.
struct Method {
  enum class Control { rtol, step };
  std::string id, label;
  std::string integrator;
  std::string sentence;
  Assignments set;  // keys of the integrator
  Control control = Control::rtol;
};

std::string control_word(Method::Control control);

struct Point {
  std::size_t problem = 0, method = 0;
  double control = 0;
};

struct Design {
  std::vector<Problem> problems;
  std::vector<Method> methods;
  std::vector<Point> points;  // by problem, then method, from loose to tight
};

// Throws ConfigError, also for a scene that cannot be read.
Design expand(const Comparison& comparison);

// "damped_beam, cvode_bdf, rtol 0.001"
std::string title(const Design& design, const Point& point);

// The scene of a problem with an integrator section; defaults are filled in, nothing is written by it but
// what probes need. Keys of the scene's own integrator are kept where the new one has them.
Config scene_config(const Problem& problem, const std::string& integrator, const Assignments& options);

// Of a method at a control.
Config point_scene(const Design& design, const Point& point);

// The first paragraph of a file's first comment, as one line.
std::string head_comment(const std::string& file);

}  // namespace orthodyn
