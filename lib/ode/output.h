// Named outputs of a model: fields and scalars of a state, for observers that need not know the mesh. Each output is
// computed only on request; intermediate results of one state are shared.
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
  double load_factor = 1;  // factor on the loads (Model::load_parts())
  Vector z = {};           // internal variables (internal_variables.h); empty: at equilibrium
  Vector lambda = {};      // multipliers of the constraints (constraints.h), N; empty if unknown
  Vector angles = {};      // rad, near Model::angles() and with all turns; empty: turns are not counted
};

enum class Location { node, cell, global };

struct OutputInfo {
  std::string name;  // "displacement", "energy.elastic"
  Location location;
  int components;
  std::string unit;
  std::string sentence;
  std::vector<std::string> component_names = {};  // "x", "y", "z"; "11", ..., "31"; may be empty
};

// The points and cells on which fields are given.
struct Geometry {
  std::vector<Vec3> points;  // m
  Cells cells;
};

// Evaluates outputs of one state. Intermediate results that outputs share (positions of all nodes, forces, momenta) are
// computed at first use and kept. Use it from one thread at a time.
class StateView {
 public:
  virtual ~StateView() = default;

  // Values of one output in its unit. Components vary fastest, then nodes or cells in the order of Geometry.
  // Precondition: `name` is one of the source's outputs(). Throws RecoverableError if it cannot be evaluated.
  virtual std::vector<double> evaluate(const std::string& name) const = 0;

  // The components of one output at a node, from the node alone if that costs less. Precondition: the output is given
  // at nodes, with so many components.
  virtual std::vector<double> evaluate_at(const std::string& name, int node, int components) const {
    const auto all = evaluate(name);
    const auto first = all.begin() + std::ptrdiff_t{components} * node;
    return {first, first + components};
  }
};

class OutputSource {
 public:
  virtual ~OutputSource() = default;

  virtual std::vector<OutputInfo> outputs() const { return {}; }

  // Returns a view of one state. The source must outlive the view, the state need not. Different views may be used
  // concurrently.
  virtual std::unique_ptr<StateView> view(const State& state) const;

  // Evaluates a single output of a state.
  std::vector<double> evaluate(const std::string& name, const State& state) const {
    return view(state)->evaluate(name);
  }

  virtual Geometry geometry() const { return {}; }
};

// A state with its view, created at first use and shared by all observers of the state. Use it from one thread at a
// time.
class ObservedState {
 public:
  // Both arguments must outlive this object.
  ObservedState(const OutputSource& source, const State& state) : source_(source), state_(state) {}
  ObservedState(const OutputSource& source, State&& state) = delete;

  double t() const { return state_.t; }
  const State& state() const { return state_; }

  // Makes evaluate() return known values of an output. `values` must outlive this object.
  void share(const std::string& name, std::span<const double> values) const { shared_[name] = values; }

  // As StateView::evaluate() and evaluate_at().
  std::vector<double> evaluate(const std::string& name) const {
    if (const auto found = shared_.find(name); found != shared_.end())
      return {found->second.begin(), found->second.end()};
    return view().evaluate(name);
  }
  std::vector<double> evaluate_at(const std::string& name, int node, int components) const {
    if (const auto found = shared_.find(name); found != shared_.end()) {
      const auto own =
          found->second.subspan(static_cast<std::size_t>(components * node), static_cast<std::size_t>(components));
      return {own.begin(), own.end()};
    }
    return view().evaluate_at(name, node, components);
  }

 private:
  const StateView& view() const {
    if (!view_) view_ = source_.view(state_);
    return *view_;
  }

  const OutputSource& source_;
  const State& state_;
  mutable std::unique_ptr<StateView> view_;
  mutable std::map<std::string, std::span<const double>> shared_;
};

}  // namespace orthodyn
