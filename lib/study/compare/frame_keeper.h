// Frames of a run that is measured, for the 3D view of the report.
#pragma once

#include <cstddef>
#include <filesystem>

#include "lib/simulation/output/frames.h"
#include "lib/simulation/output/setup_file.h"

namespace orthodyn::study::compare {

// Writes the initial state and `output.frames` of the `samples` outputs, evenly spaced, the last among them, with
// `output.fields`; and where the body is held and loaded.
class FrameKeeper : public Observer {
 public:
  // `setup` must outlive it.
  FrameKeeper(const std::filesystem::path& folder, const Setup& setup, std::size_t samples)
      : frames_(folder, *setup.built.model, setup.scene.output.fields, &setup.built.model->parts().mesh),
        setup_(folder, setup),
        count_(static_cast<std::size_t>(setup.scene.output.frames.value_or(0))),
        samples_(samples) {}

  void on_start(const ObservedState& observed) override {
    setup_.on_start(observed);
    frames_.on_start(observed);
  }
  void on_output(const ObservedState& observed) override {
    const std::size_t before = seen_ * count_ / samples_, now = ++seen_ * count_ / samples_;
    if (now > before) frames_.on_output(observed);
  }

 private:
  FrameWriter frames_;
  SetupWriter setup_;
  std::size_t count_, samples_, seen_ = 0;
};

}  // namespace orthodyn::study::compare
