// Files for ParaView that show a scene before it runs: supports and loads (also for `orthodyn view`), and material
// axes.
#pragma once

#include <filesystem>

#include "lib/simulation/output/observer.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

inline constexpr const char* kSetupFile = "setup.vtu";

// Writes <folder>/setup.vtu at the start of a run: the rest shape with the nodal fields `held` (1 for each clamped or
// moved coordinate, else 0) and `load` (N): the forces other than gravity in the initial state, each at the largest
// value of its time function. Springs, dashpots and contact are not loads. Throws RunError.
class SetupWriter : public Observer {
 public:
  // `setup` must outlive the writer.
  SetupWriter(const std::filesystem::path& folder, const Setup& setup) : file_(folder / kSetupFile), setup_(setup) {}
  void on_start(const ObservedState& observed) override;

 private:
  std::filesystem::path file_;
  const Setup& setup_;
};

// Writes the cell fields axis_1, axis_2, axis_3 (in the rest shape) and region. Throws RunError.
void write_axes(const std::filesystem::path& file, const FemModel& model);

}  // namespace orthodyn
