// Keeps the states of a run in memory, for numpy.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "lib/simulation/output/observer.h"

namespace orthodyn::python {

class Recorder : public Observer {
 public:
  // `fields`: node or cell outputs of the source that is observed, which must outlive the run.
  Recorder(const OutputSource& source, const std::vector<std::string>& fields);

  void on_start(const ObservedState& observed) override { record(observed); }
  void on_resume(const ObservedState&) override { complete_ = false; }
  void on_output(const ObservedState& observed) override { record(observed); }

  // "times" (frames,), "points" (nodes, 3), "cells" (cells, nodes of each), and each field (frames, nodes or cells,
  // components). Takes them out; empty where a run was resumed, whose first frames are in files only.
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
