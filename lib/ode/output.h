// What a model can tell about a state, by name: observers ask for fields and scalars and know no
// mesh behind them. Nothing is computed that nobody asks for.
#pragma once

#include <string>
#include <vector>

#include "lib/core/cells.h"
#include "lib/core/types.h"

namespace orthodyn {

struct State {
  double t = 0;  // s
  Vector q, v;   // generalised positions and velocities
};

enum class Location { node, cell, global };

struct OutputInfo {
  std::string name;  // "displacement", "energy.elastic"
  Location location;
  int components;
  std::string unit;
  std::string sentence;
};

// Points and cells that fields live on.
struct Geometry {
  std::vector<Vec3> points;  // m
  Cells cells;
  int vtk_cell_type = 0;  // their kind, by the numbers of VTK
};

class OutputSource {
 public:
  virtual ~OutputSource() = default;
  virtual std::vector<OutputInfo> outputs() const { return {}; }
  // Values of one output, components fastest. Precondition: `name` is one of outputs().
  virtual std::vector<double> evaluate(const std::string& name, const State& state) const;
  virtual Geometry geometry() const { return {}; }
};

}  // namespace orthodyn
