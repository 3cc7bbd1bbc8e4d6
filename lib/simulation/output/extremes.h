// Records the largest or smallest value of quantities over a run (output.extremes), with its time and node. Quantities
// are evaluated at the times of the history.
#pragma once

#include <string>
#include <vector>

#include "lib/scene/quantity.h"
#include "lib/simulation/output/observer.h"

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
};

// "in body.ply_2, ", or "" if there is only one region.
std::string in_region(const RecordedExtreme& extreme);

// True for a failure criterion (max_stress, tsai_wu, hashin) of a node, a region or the body. Failure occurs at 1.
bool is_failure_criterion(const std::string& quantity);

// One sentence for each failure criterion above 1.
std::vector<std::string> exceeded_strengths(const std::vector<RecordedExtreme>& extremes, bool is_static);

class ExtremeRecorder : public Observer {
 public:
  // `quantities`: see find_extreme(). The model must outlive the recorder. Throws ConfigError at `origin` if one of
  // them is not an extreme of a stress or strain field.
  ExtremeRecorder(const std::vector<std::string>& quantities, const FemModel& model, const SourceLocation& origin);

  void on_start(const ObservedState& observed) override { observe(observed); }
  void on_history(const ObservedState& observed) override { observe(observed); }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  const std::vector<RecordedExtreme>& found() const { return found_; }

 private:
  void observe(const ObservedState& observed);
  void locate(RecordedExtreme& found) const;  // sets place and region from node and term

  const FemModel& model_;
  std::vector<FindExtreme> find_;
  std::vector<RecordedExtreme> found_;
};

}  // namespace orthodyn
