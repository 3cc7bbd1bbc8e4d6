// Where a body is held and loaded, as a file for ParaView and `orthodyn view`.
#pragma once

#include <filesystem>

#include "lib/simulation/output/observer.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

inline constexpr const char* kSetupFile = "setup.vtu";

// Writes <folder>/setup.vtu when a run begins: the rest shape with, at each node, `held`, 1 for each coordinate that is
// clamped or moved, else 0; and `load`, N: what loads other than gravity exert in the initial state at the peak of
// their factors. Springs, dashpots and contact are no loads. Throws RunError.
class SetupWriter : public Observer {
 public:
  // `setup` must outlive it.
  SetupWriter(const std::filesystem::path& folder, const Setup& setup) : file_(folder / kSetupFile), setup_(setup) {}
  void on_start(const ObservedState& observed) override;

 private:
  std::filesystem::path file_;
  const Setup& setup_;
};

}  // namespace orthodyn
