// Records the states of a run in memory, as numpy arrays.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "lib/simulation/output/observer.h"

namespace orthodyn::python {

class Recorder : public Observer {
 public:
  // `fields`: names of outputs of `source` at nodes or cells; other names are ignored.
  Recorder(const OutputSource& source, const std::vector<std::string>& fields);

  void on_start(const ObservedState& observed) override { record(observed); }
  void on_resume(const ObservedState&) override { complete_ = false; }
  void on_output(const ObservedState& observed) override { record(observed); }

  // Moves out "times" (frames,), "points" (nodes, 3), "cells" (cells, nodes of the largest cell; -1 where
  // absent), "cell_types" (cells,) as numbered by VTK, "fields" by name (frames, nodes or cells, components) and
  // "cell_fields", the names of the fields at cells. Empty after a resumed run, whose first frames are only in files.
  pybind11::dict take();

 private:
  void record(const ObservedState& observed);

  struct Field {
    OutputInfo info;
    std::vector<double> values;
  };
  Geometry geometry_;
  std::vector<double> times_;
  std::vector<Field> fields_;
  bool complete_ = true;
};

}  // namespace orthodyn::python
