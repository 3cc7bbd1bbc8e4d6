// Which contacts have acted in a run.
#pragma once

#include <string>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

struct ContactRecord {
  std::size_t count = 0;
  std::vector<std::string> untouched = {};  // names of contacts whose force was zero whenever it was computed
};

// Costs nothing during the run: contacts note that they act. All functions are collective.
class ContactWatch : public Observer {
 public:
  // `model` must outlive this object.
  explicit ContactWatch(const FemModel& model) : model_(model), before_(model.parts().contacts.size(), 0.0) {}

  void save(Archive& archive) override { archive.put("acted", acted()); }
  void restore(const Archive& archive) override { before_ = archive.numbers("acted", before_.size()); }

  ContactRecord record() const;

 private:
  std::vector<double> acted() const;  // 1: yes, of each contact

  const FemModel& model_;
  std::vector<double> before_;  // of the part of the run before it was resumed
};

}  // namespace orthodyn
