// What a model can tell about a state, by name: observers ask for fields and scalars and know no mesh behind them.
// Nothing is computed that nobody asks for, and nothing twice that outputs of one state share.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/core/cells.h"
#include "lib/core/types.h"

namespace orthodyn {

struct State {
  double t = 0;            // s
  Vector q, v;             // generalised positions and velocities
  double load_factor = 1;  // of what loads the model (Model::load_parts())
};

enum class Location { node, cell, global };

struct OutputInfo {
  std::string name;  // "displacement", "energy.elastic"
  Location location;
  int components;
  std::string unit;
  std::string sentence;
  std::vector<std::string> component_names = {};  // "x", "y", "z"; "11", ..., "31"; empty where they have none
};

// Points and cells that fields live on.
struct Geometry {
  std::vector<Vec3> points;  // m
  Cells cells;
  int vtk_cell_type = 0;  // their kind, by the numbers of VTK
};

// One state, evaluated. It computes what an output needs when it is first asked for, and keeps what others need too:
// positions of all nodes, forces, momenta. For one thread at a time.
class StateView {
 public:
  virtual ~StateView() = default;

  // Values of one output in its unit: components fastest, then nodes or cells in the order of Geometry.
  // Precondition: `name` is one of the source's outputs(). Throws RecoverableError where it cannot be evaluated.
  virtual std::vector<double> evaluate(const std::string& name) const = 0;
};

class OutputSource {
 public:
  virtual ~OutputSource() = default;

  virtual std::vector<OutputInfo> outputs() const { return {}; }

  // For several outputs of one state, which need not outlive the view; the source must. Views of one source may be
  // used at the same time.
  virtual std::unique_ptr<StateView> view(const State& state) const;

  // One output of a state, where it is the only one that is wanted.
  std::vector<double> evaluate(const std::string& name, const State& state) const {
    return view(state)->evaluate(name);
  }

  virtual Geometry geometry() const { return {}; }
};

// A state with its source's view of it, which is made when it is first asked for and shared by all that look at the
// state. For one thread at a time.
class ObservedState {
 public:
  // Both must outlive it.
  ObservedState(const OutputSource& source, const State& state) : source_(source), state_(state) {}
  ObservedState(const OutputSource& source, State&& state) = delete;

  double t() const { return state_.t; }
  const State& state() const { return state_; }

  // For one that keeps the values of an output: who asks for it later gets a copy. `values` must outlive this.
  void share(const std::string& name, std::span<const double> values) const { shared_[name] = values; }

  // As StateView::evaluate().
  std::vector<double> evaluate(const std::string& name) const {
    if (const auto found = shared_.find(name); found != shared_.end())
      return {found->second.begin(), found->second.end()};
    if (!view_) view_ = source_.view(state_);
    return view_->evaluate(name);
  }

 private:
  const OutputSource& source_;
  const State& state_;
  mutable std::unique_ptr<StateView> view_;
  mutable std::map<std::string, std::span<const double>> shared_;
};

}  // namespace orthodyn
