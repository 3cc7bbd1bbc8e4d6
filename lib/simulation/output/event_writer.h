// events.csv: when which event happened, at which value and in which direction.
#pragma once

#include <filesystem>

#include "lib/simulation/output/event_finder.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

class EventWriter : public Observer {
 public:
  // Keeps the finder's memory in checkpoints, too. `finder` must outlive it.
  EventWriter(const std::filesystem::path& path, EventFinder& finder);

  void on_start(const ObservedState&) override { file_.begin(); }
  void on_resume(const ObservedState&) override { file_.go_on(); }
  void on_event(const Crossing& crossing) override;
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

 private:
  EventFinder& finder_;
  GrowingFile file_;
};

}  // namespace orthodyn
