// The points of a comparison: every scene with every method and every value of the option that controls the error.
#pragma once

#include <string>
#include <vector>

#include "lib/study/compare/comparison.h"
#include "lib/study/inputs/scene_variant.h"

namespace orthodyn::study::compare {

// A scene with one combination of the varied keys outside of `integrator`.
struct Problem {
  std::string id, label;  // ids are unique
  SceneVariant scene;
  std::size_t group = 0;  // index in Design::groups
  std::string mesh;       // distinguishes the members of a group: "order 1, cells [20, 2, 1]"
};

// Problems that share a reference: one problem alone, or all that differ only in their meshes.
struct Group {
  std::string id, label;   // ids are unique
  SceneVariant reference;  // scene of the reference
};

// An integrator with all options fixed except the one that controls its error.
struct Method {
  enum class Control { rtol, step, safety };  // safety: fraction of the critical step of an explicit method
  std::string id, label;
  std::string integrator;
  std::string sentence;  // describes the integrator
  Assignments set;       // the fixed options
  Control control = Control::rtol;
};

std::string control_word(Method::Control control);  // "rtol", "step" or "safety"

struct Point {
  std::size_t problem = 0, method = 0;  // indices in Design
  double control = 0;                   // rtol, step (s) or safety
  SourceLocation control_at = {};       // place of `tolerances` or `steps`; empty if the program chose the value
};

struct Design {
  std::vector<Group> groups;
  std::vector<Problem> problems;
  bool across_meshes = false;  // errors are measured at probes and include the mesh error
  std::vector<Method> methods;
  std::vector<Point> points;  // ordered by problem, then method, then from loose to tight
  std::optional<KeptFrames> frames = {};
  Method reference, check;  // `set` includes the option that controls the error
};

// Number of points that expand() would make, without making them.
double number_of_points(const Comparison& comparison);

// Makes all points and reads the scene of each, so that input errors appear before any run. Throws ConfigError.
Design expand(const Comparison& comparison);

// "damped_beam, cvode_bdf, rtol 0.001"
std::string title(const Design& design, const Point& point);

// The scene of a point, with defaults filled in. Output is reduced to the probes and the kept frames. Options of the
// scene's own integrator stay if the method has the same key and does not set it. Those that control the error never
// stay: rtol, step and safety, and with a fixed step also h0, h_min and h_max.
Config point_scene(const Design& design, const Point& point);

// The scene of the reference or of its check. Of the scene's own integrator options, only position_scale,
// velocity_scale and linear_solver stay.
Config reference_scene(const Group& group, const Method& method, const std::optional<KeptFrames>& frames = {});

}  // namespace orthodyn::study::compare
