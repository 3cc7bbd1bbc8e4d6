// From a comparison to its points: every scene as it will run, with every method and control.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lib/study/compare/comparison.h"

namespace orthodyn {

// A scene with its physics fixed: what errors are measured on.
struct Problem {
  std::string id, label;  // ids are unique
  std::string file, text;  // read once: a scene that is edited meanwhile is another one
  Assignments set;
};

// An integrator with its options fixed, but for what controls its error.
struct Method {
  enum class Control { rtol, step, safety };  // safety: the share of the critical step that an explicit method takes
  std::string id, label;
  std::string integrator;
  std::string sentence;
  Assignments set;  // keys of the integrator
  Control control = Control::rtol;
};

bool has_key(const std::string& integrator, const std::string& key);

std::string control_word(Method::Control control);

struct Point {
  std::size_t problem = 0, method = 0;
  double control = 0;
};

struct Design {
  std::vector<Problem> problems;
  std::vector<Method> methods;
  std::vector<Point> points;  // by problem, then method, from loose to tight
  Method reference, check;    // with all that controls their errors among `set`
};

// Throws ConfigError, also for a scene that cannot be read.
Design expand(const Comparison& comparison);

// "damped_beam, cvode_bdf, rtol 0.001"
std::string title(const Design& design, const Point& point);

// The scene that a point runs: defaults are filled in, nothing is written but what probes need. Options
// of the scene's own integrator are kept where the method has such keys and says nothing else.
Config point_scene(const Design& design, const Point& point);

// The scene of a problem with an integrator of these options, as text still: of the scene's own options those that
// `kept` names stay where the integrator has such keys.
Config with_integrator(const Problem& problem, const std::string& integrator, const Assignments& options,
                       const std::function<bool(const std::string&)>& kept);

// The same for the reference or its check: of the scene's own options, scales and linear solver are kept.
Config reference_scene(const Problem& problem, const Method& method);

// The text of a file that is YAML; throws ConfigError.
std::string read_yaml(const FilePath& file);

// The first paragraph of the first comment of a YAML text, as one line.
std::string head_comment(const std::string& yaml);

}  // namespace orthodyn
