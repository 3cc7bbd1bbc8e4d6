// Estimates the disk space of a run before it starts: frames, rows of tables and checkpoint. Accurate to about 10 %.
// Each frame contains the mesh; a number in a table takes about 20 characters.
#pragma once

#include <string>

#include "lib/simulation/run/setup.h"

namespace orthodyn {

// From this number of frames, table rows, load steps or study points on, a run needs --yes: such a number is probably a
// typing error.
constexpr double kConfirmationThreshold = 1e6;

struct OutputSize {
  double frames = 0;       // number of frames; in statics at least one per load step, in buckling one per shape
  double frame_bytes = 0;  // of each frame
  double rows = 0;         // in each of energy.csv, momentum.csv and probes.csv; 0: one per step, number unknown
  double row_bytes = 0;    // of the three tables together
  double checkpoint_bytes = 0;
  double bytes() const { return frames * frame_bytes + rows * row_bytes + checkpoint_bytes; }
};

// Number of load steps if none is rejected. The step size doubles from the first one up to max_step.
double fewest_load_steps(const Statics& statics);

OutputSize output_size_of(const Setup& setup);

// Throws ConfigError for a million or more frames, rows or load steps. The message gives their number and size, the key
// to change, and --yes, which permits them.
void require_allowed_output_size(const Setup& setup);

// The message of this error, for `orthodyn check`; "" if there is none.
std::string output_size_error(const Setup& setup);

// "1.2 GB".
std::string shown_bytes(double bytes);

}  // namespace orthodyn
