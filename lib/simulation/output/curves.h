// Curves over time as CSV: energies, momenta and probes by the history, steps. Headers name the units. Files are made
// when a run starts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/simulation/output/balance.h"
#include "lib/simulation/output/files.h"

namespace orthodyn {

// energy.csv, its balance relative to the start (zero when exact); also the figures of the summary.
class EnergyWriter : public EnergyMeter {
 public:
  EnergyWriter(const std::filesystem::path& path, const Model& model, const Integrator& integrator, EnergyTimes times);
  void on_start(const ObservedState& observed) override;
  void on_resume(const ObservedState&) override { file_.go_on(); }
  void on_output(const ObservedState&) override {}
  void on_history(const ObservedState& observed) override;
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

 private:
  void write(double t);
  CsvFile file_;
};

// momentum.csv.
class MomentumWriter : public MomentumMeter {
 public:
  explicit MomentumWriter(const std::filesystem::path& path);
  void on_start(const ObservedState& observed) override;
  void on_resume(const ObservedState&) override { file_.go_on(); }
  void on_output(const ObservedState&) override {}
  void on_history(const ObservedState& observed) override;
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

 private:
  void write(double t);
  CsvFile file_;
};

// steps.csv: t, h, order, Newton iterations and rejections of each step.
class StepWriter : public Observer {
 public:
  explicit StepWriter(const std::filesystem::path& path);
  void on_start(const ObservedState&) override { file_.begin(); }
  void on_resume(const ObservedState&) override { file_.go_on(); }
  void save(Archive& archive) override { file_.save(archive); }
  void restore(const Archive& archive) override { file_.restore(archive); }
  void on_step(const StepInfo& info, const ObservedState& observed, const Integrator& integrator) override;

 private:
  CsvFile file_;
  Statistics before_;  // of this process, as the integrator's own
};

// probes.csv: fields at named nodes.
struct ProbeColumn {
  std::string name;    // "tip"; empty for an output of the whole body
  int node;            // then 0
  std::string field;   // a node output: "displacement"; or "reaction.clamp_1"
  int components = 0;  // of the field; filled in
};

class ProbeWriter : public Observer {
 public:
  // `axis` heads the column of State::t.
  ProbeWriter(const std::filesystem::path& path, const Model& model, std::vector<ProbeColumn> columns,
              const std::string& axis = "t [s]");
  void on_start(const ObservedState& observed) override;
  void on_resume(const ObservedState&) override { file_.go_on(); }
  void on_history(const ObservedState& observed) override { record(observed); }
  void save(Archive& archive) override { file_.save(archive); }
  void restore(const Archive& archive) override { file_.restore(archive); }

 private:
  void record(const ObservedState& observed);
  std::vector<ProbeColumn> columns_;
  CsvFile file_;
};

}  // namespace orthodyn
