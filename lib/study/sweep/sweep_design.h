// From a sweep to its points: every scene as it will be computed, and what the closed forms say of it.
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
  std::string impossible;            // why the scene cannot be; "" if it can
  std::vector<double> closed_forms;  // by quantity; NaN for none
};

// How many expand() would make.
double number_of_points(const Sweep& sweep);

// The scene of the first point, with the places of its keys. Throws ConfigError.
Config first_scene(const Sweep& sweep);

// Every scene is read and checked, and the first one's quantities are looked up in its model. Throws ConfigError.
std::vector<Point> expand(const Sweep& sweep);

}  // namespace orthodyn::study::sweep
