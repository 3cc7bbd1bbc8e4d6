// Frames of a measured run for the report's 3D view.
#pragma once

#include <cstddef>
#include <filesystem>

#include "lib/simulation/output/frames.h"
#include "lib/simulation/output/setup_file.h"

namespace orthodyn::study::compare {

// Writes frames with the fields `output.fields`: the initial state and `output.frames` of the `samples` output states,
// evenly spaced and including the last. Also writes the file of supports and loads.
class FrameKeeper : public Observer {
 public:
  // `setup` must outlive the keeper.
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
