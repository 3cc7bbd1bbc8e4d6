// The largest and smallest values of quantities over a run (output.extremes), each with its time and the node where it
// was. They are looked at when the history is written.
#pragma once

#include <string>
#include <vector>

#include "lib/scene/quantity.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

struct RecordedExtreme {
  std::string quantity, unit;
  double value = 0;
  double time = 0;            // s; of a static analysis the load factor
  int node = -1;              // of the mesh
  Vec3 place = Vec3::Zero();  // its rest position, m
  long states = 0;            // that were looked at
};

// Whether a quantity is an exposure, max_stress, tsai_wu or hashin of a node, a region or the body, of which 1 fails.
bool is_exposure(const std::string& quantity);

// A sentence for each exposure that went beyond 1. Of a static analysis times are load factors.
std::vector<std::string> exceeded_strengths(const std::vector<RecordedExtreme>& extremes, bool is_static);

class ExtremeRecorder : public Observer {
 public:
  // `quantities`: such as find_extreme() takes. The model must outlive it. Throws ConfigError at `origin`.
  ExtremeRecorder(const std::vector<std::string>& quantities, const FemModel& model, const SourceLocation& origin);

  void on_start(const ObservedState& observed) override { look_at(observed); }
  void on_history(const ObservedState& observed) override { look_at(observed); }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  const std::vector<RecordedExtreme>& found() const { return found_; }

 private:
  void look_at(const ObservedState& observed);

  const FemModel& model_;
  std::vector<FindExtreme> find_;
  std::vector<RecordedExtreme> found_;
};

}  // namespace orthodyn
