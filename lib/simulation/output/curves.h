// CSV tables of a run: energies, momenta and probes at the times of the history, steps, and events. The first line
// names the columns with their units. Files are created when a run starts.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/scene/gauge.h"
#include "lib/simulation/output/balance.h"
#include "lib/simulation/output/event_finder.h"
#include "lib/simulation/output/files.h"

namespace orthodyn {

// Base of observers that write one table.
class TableWriter : public Observer {
 public:
  void on_start(const ObservedState&) override { file_.begin(); }
  void on_resume(const ObservedState&) override { file_.reopen(); }
  void save(Archive& archive) override { file_.save(archive); }
  void restore(const Archive& archive) override { file_.restore(archive); }

 protected:
  TableWriter(const std::filesystem::path& path, const std::vector<std::string>& header) : file_(path, header) {}

  CsvFile file_;
};

// Writes the values of a meter: at the start, and at each time of the history.
template <class Meter>
class MeterWriter : public Meter {
 public:
  template <class... Arguments>
  explicit MeterWriter(const std::filesystem::path& path, Arguments&&... meter)
      : Meter(std::forward<Arguments>(meter)...), file_(path, Meter::columns()) {}

  void on_start(const ObservedState& observed) override {
    Meter::on_start(observed);
    file_.begin();
    file_.row(Meter::row(observed.t()));
  }
  void on_resume(const ObservedState&) override { file_.reopen(); }
  void on_output(const ObservedState&) override {}
  void on_history(const ObservedState& observed) override {
    Meter::on_output(observed);
    file_.row(Meter::row(observed.t()));
  }
  void save(Archive& archive) override {
    Meter::save(archive);
    file_.save(archive);
  }
  void restore(const Archive& archive) override {
    Meter::restore(archive);
    file_.restore(archive);
  }

 private:
  CsvFile file_;
};

using EnergyWriter = MeterWriter<EnergyMeter>;      // energy.csv
using MomentumWriter = MeterWriter<MomentumMeter>;  // momentum.csv

// steps.csv: time, step size, order, Newton iterations and rejected steps of each step.
class StepWriter : public TableWriter {
 public:
  explicit StepWriter(const std::filesystem::path& path);
  void on_step(const StepInfo& info, const ObservedState& observed, const Integrator& integrator) override;

 private:
  Statistics before_;  // of this process, at the previous step
};

// A column group of probes.csv.
struct ProbeColumn {
  std::string name;                       // "tip"; empty for an output of the whole body
  int node;                               // 0 for an output of the whole body, and for a gauge
  std::string field;                      // a nodal output such as "displacement", or "reaction.clamp_1"
  std::optional<PlacedGauge> gauge = {};  // length and strain of a gauge; `field` is empty then
  int components = 0;                     // number of the field's components; set by ProbeColumns
  bool at_node = false;                   // whether it is a nodal output; set by ProbeColumns
};

// The columns with their numbers of components, and the name and unit of each component: "tip.displacement.x", "m".
class ProbeColumns {
 public:
  ProbeColumns(const Model& model, std::vector<ProbeColumn> columns);
  const std::vector<std::pair<std::string, std::string>>& names_and_units() const { return names_and_units_; }
  std::vector<double> values(const ObservedState& observed) const;
  // The same in a model whose nodes may have other places. Probes stay at their nodes.
  std::vector<double> values_on(const Mesh& mesh, const ObservedState& observed) const;

 private:
  std::vector<double> values(const ObservedState& observed, const Mesh* mesh) const;

  std::vector<ProbeColumn> columns_;
  std::vector<std::pair<std::string, std::string>> names_and_units_;
};

class ProbeWriter : public TableWriter {
 public:
  // `axis`: header of the first column, which contains State::t.
  ProbeWriter(const std::filesystem::path& path, const Model& model, std::vector<ProbeColumn> columns,
              const std::string& axis = "t [s]");
  void on_start(const ObservedState& observed) override;
  void on_history(const ObservedState& observed) override;

 private:
  ProbeWriter(const std::filesystem::path& path, ProbeColumns columns, const std::string& axis);
  ProbeColumns columns_;
};

// events.csv: time, name, value and direction of each event.
class EventWriter : public TableWriter {
 public:
  // Also saves the state of the finder in checkpoints. `finder` must outlive the writer.
  EventWriter(const std::filesystem::path& path, EventFinder& finder);
  void on_event(const Crossing& crossing) override;
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

 private:
  EventFinder& finder_;
};

}  // namespace orthodyn
