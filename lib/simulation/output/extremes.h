// Records the largest or smallest value of quantities over a run (output.extremes), with its time and node.
//
// Extremes of stress and strain fields over the nodes are evaluated at the times of the history. Extremes of a probe's
// component are found on the interpolation of all steps of a motion (time_extreme.h). Of these, the derivative with
// respect to a parameter p is that at the fixed time t* of the extreme (envelope theorem): dq/dp (t*), because either
// dq/dt = 0 there, or t* is an end of the run.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/scene/quantity.h"
#include "lib/simulation/output/observer.h"
#include "lib/simulation/output/time_extreme.h"
#include "lib/simulation/sensitivity/motion_slopes.h"

namespace orthodyn {

struct RecordedExtreme {
  std::string quantity, unit;
  double value = 0;
  double time = 0;            // s; load factor in a static analysis
  int node = -1;              // mesh node; -1 if there is no value
  Vec3 place = Vec3::Zero();  // rest position of the node, m
  int term = -1;              // as in Extreme
  std::string region = {};    // the region or ply; "" if there is only one
  long states = 0;            // number of states evaluated
  bool between_rows = false;  // true: extremes between the rows of the history count too
  // By the path of the parameter, per its SI unit; empty without `sensitivities`, and if `remark` says so.
  std::vector<std::pair<std::string, double>> derivatives = {};
  std::string remark = {};  // on the derivatives; "" if there is none
};

// "in body.ply_2, ", or "" if there is only one region.
std::string in_region(const RecordedExtreme& extreme);

// True for a failure criterion (max_stress, tsai_wu, hashin) of a node, a region or the body. Failure occurs at 1.
bool is_failure_criterion(const std::string& quantity);

// One sentence for each failure criterion above 1.
std::vector<std::string> exceeded_strengths(const std::vector<RecordedExtreme>& extremes, bool is_static);

class ExtremeRecorder : public Observer {
 public:
  // Of scene.output.extremes: see find_extreme(), or PROBE.FIELD.COMPONENT.largest. Both must outlive the recorder.
  // Throws ConfigError at scene.output.origin if one of them is neither.
  ExtremeRecorder(const Scene& scene, const FemModel& model);

  // Also computes derivatives of the extremes at probes, in a motion. `slopes` must outlive the recorder.
  void differentiate(MotionSlopes& slopes) { slopes_ = &slopes; }

  void on_start(const ObservedState& observed) override;
  void on_resume(const ObservedState& observed) override { begin_at(observed.t()); }
  void on_history(const ObservedState& observed) override { observe(observed); }
  void on_step(const StepInfo& info, const ObservedState& end, const Integrator& integrator) override;
  void on_event(const Crossing& crossing) override { stopped_ = stopped_ || crossing.event->stops; }
  void on_end() noexcept override;
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  std::vector<RecordedExtreme> found() const;

 private:
  // An extreme at a probe, in a motion.
  struct Tracked {
    std::size_t index;  // of found_
    Quantity quantity;
    double sign;  // 1 for the largest, -1 for the smallest value
    TimeExtreme search = {};
    // Derivatives of the extreme at this time, if any.
    std::optional<double> differentiated_at = {};
    std::vector<double> slopes = {};
    std::string failure = {};  // why there are none
  };

  void add_probe(const std::string& name, const std::string& probe);
  std::string probe_of(const std::string& name) const;
  bool is_tracked(std::size_t index) const;
  void begin_at(double t);
  void observe(const ObservedState& observed);
  double signed_value(const Tracked& tracked, const ObservedState& observed) const;
  void update_derivatives(Tracked& tracked, const State& state) const;
  void copy_to(RecordedExtreme& found, const Tracked& tracked) const;
  std::string remark_on(const Tracked& tracked) const;
  void locate(RecordedExtreme& found) const;  // sets place and region from node and term

  const Scene& scene_;
  const FemModel& model_;
  MotionSlopes* slopes_ = nullptr;
  std::vector<FindExtreme> find_;
  std::vector<RecordedExtreme> found_;
  std::vector<Tracked> tracked_;
  State last_;            // at the end of the last step
  bool stopped_ = false;  // by an event
};

}  // namespace orthodyn
