// The points of a sweep: their scenes and the values of the closed forms.
#pragma once

#include <string>
#include <vector>

#include "lib/study/points/point_jobs.h"
#include "lib/study/sweep/sweep.h"

namespace orthodyn::study::sweep {

struct Point {
  std::vector<VariedValue> values;  // by variable
  std::string title;                // "angle 30 deg, mesh fine"
  PointScene scene;
  std::string impossible;            // error of an invalid scene; else ""
  std::vector<double> closed_forms;  // by metric; NaN for a metric without a closed form
};

// Number of points that expand() would make, without making them.
double number_of_points(const Sweep& sweep);

// The scene of the first point. Its keys know their places, for error messages. Throws ConfigError.
Config first_scene(const Sweep& sweep);

// Makes all points. Reads and checks every scene, and checks the quantities in the first scene that can be built.
// Throws ConfigError.
std::vector<Point> expand(const Sweep& sweep);

}  // namespace orthodyn::study::sweep
