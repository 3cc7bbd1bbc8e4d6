#include "lib/simulation/output/event_writer.h"

#include <fmt/format.h>

namespace orthodyn {

EventWriter::EventWriter(const std::filesystem::path& path, EventFinder& finder)
    : finder_(finder), file_(path, "t [s],event,value,direction\n", "") {}

void EventWriter::on_event(const Crossing& crossing) {
  file_.append(fmt::format("{},{},{},{}\n", crossing.state.t, crossing.event->name, crossing.event->value,
                           crossing.upward ? "up" : "down"));
}

void EventWriter::save(Archive& archive) {
  file_.save(archive);
  finder_.save(archive);
}

void EventWriter::restore(const Archive& archive) {
  file_.restore(archive);
  finder_.restore(archive);
}

}  // namespace orthodyn
