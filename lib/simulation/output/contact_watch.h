// Which contacts have acted in a run.
#pragma once

#include <string>
#include <vector>

#include "lib/simulation/output/observer.h"

namespace orthodyn {

struct ContactRecord {
  std::size_t count = 0;
  std::vector<std::string> untouched = {};  // names of contacts without pressure at the end of any step
};

class ContactWatch : public Observer {
 public:
  explicit ContactWatch(std::vector<std::string> names) : names_(std::move(names)), touched_(names_.size(), 0.0) {}

  void on_start(const ObservedState& observed) override { observe(observed); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override { observe(observed); }
  void save(Archive& archive) override { archive.put("touched", touched_); }
  void restore(const Archive& archive) override { touched_ = archive.numbers("touched", touched_.size()); }

  ContactRecord record() const;

 private:
  void observe(const ObservedState& observed);

  std::vector<std::string> names_;
  std::vector<double> touched_;  // 1: yes; these are not searched again
};

}  // namespace orthodyn
