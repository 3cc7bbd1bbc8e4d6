// From a comparison to its points: every scene as it will run, with every method and control.
#pragma once

#include <string>
#include <vector>

#include "lib/study/compare/comparison.h"
#include "lib/study/inputs/scene_variant.h"

namespace orthodyn::study::compare {

// A scene as points run it.
struct Problem {
  std::string id, label;  // ids are unique
  SceneVariant scene;
  std::size_t group = 0;
  std::string mesh;  // of a group with several: what tells it from the others, "order 1, cells [20, 2, 1]"
};

// Problems that are measured against the same reference: one, or all that differ only in their meshes.
struct Group {
  std::string id, label;   // ids are unique
  SceneVariant reference;  // its scene
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

std::string control_word(Method::Control control);

struct Point {
  std::size_t problem = 0, method = 0;
  double control = 0;
  SourceLocation control_at = {};  // its place in the comparison's file; "" where the program chooses it
};

struct Design {
  std::vector<Group> groups;
  std::vector<Problem> problems;
  bool across_meshes = false;  // errors are those of space and time, measured at probes
  std::vector<Method> methods;
  std::vector<Point> points;  // by problem, then method, from loose to tight
  std::optional<KeptFrames> frames = {};
  Method reference, check;  // with all that controls their errors among `set`
};

// How many points a comparison has, counted without making them.
double number_of_points(const Comparison& comparison);

// Throws ConfigError, also for a scene that cannot be read.
Design expand(const Comparison& comparison);

// "damped_beam, cvode_bdf, rtol 0.001"
std::string title(const Design& design, const Point& point);

// The scene that a point runs: defaults are filled in, nothing is written but what probes need and frames that are
// kept. Options of the scene's own integrator are kept where the method has such keys and says nothing else.
Config point_scene(const Design& design, const Point& point);

// The same for the reference or its check: of the scene's own options, scales and linear solver are kept.
// Frames are for those that are shown.
Config reference_scene(const Group& group, const Method& method, const std::optional<KeptFrames>& frames = {});

}  // namespace orthodyn::study::compare
