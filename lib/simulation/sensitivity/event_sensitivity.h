// sensitivities_of_events.csv of a motion: derivatives of the times of events.
//
// At the time t of an event a quantity g has a given value: g(t, p) = value. Hence dt/dp = -(dg/dp) / (dg/dt), with
// dg/dp at fixed t (implicit function theorem). dg/dt is a difference on the interpolation of the step.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/simulation/output/curves.h"
#include "lib/simulation/sensitivity/motion_slopes.h"

namespace orthodyn {

inline constexpr const char* kEventSensitivities = "sensitivities_of_events.csv";

class EventSensitivityWriter : public TableWriter {
 public:
  // All arguments must outlive the writer. `slopes`: of the motion of `scene`.
  EventSensitivityWriter(const std::filesystem::path& path, const Scene& scene, const FemModel& model,
                         MotionSlopes& slopes);
  void on_start(const ObservedState& observed) override;
  void on_resume(const ObservedState& observed) override;
  void on_event(const Crossing& crossing) override { crossings_.push_back(crossing); }
  // Writes a row for each event of the step.
  void on_step(const StepInfo& info, const ObservedState& observed, const Integrator& integrator) override;

 private:
  struct Row {
    std::vector<double> derivatives = {};  // empty if there are none
    std::string remark = {};               // why
  };
  void begin_at(double t);
  Row row_of(const Crossing& crossing, double end, const Integrator& integrator) const;
  // The quantity of the event; "" if several events agree in name, threshold and direction, but not in their quantity.
  std::string quantity_of(const Event& event) const;

  const Scene& scene_;
  const FemModel& model_;
  MotionSlopes& slopes_;
  std::vector<Crossing> crossings_;  // in this step
  double begin_ = 0;                 // of the step, s
};

}  // namespace orthodyn
