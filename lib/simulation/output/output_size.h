// How much a run of a scene writes: frames, rows of its tables, checkpoint. Bytes are estimates, good to some tens of
// per cent: each frame has the mesh, numbers of tables have some 20 characters.
#pragma once

#include <string>
#include <vector>

#include "lib/simulation/run/setup.h"

namespace orthodyn {

// More frames, rows, load steps or points of a study than this are hardly meant: they ask for --yes.
constexpr double kMostUnasked = 1e6;

struct OutputSize {
  double frames = 0;       // in statics the fewest load steps
  double frame_bytes = 0;  // of one
  double rows = 0;       // of energy.csv, momentum.csv and probes.csv each; 0: one each step, their number is not known
  double row_bytes = 0;  // of the three together
  double checkpoint_bytes = 0;
  double bytes() const { return frames * frame_bytes + rows * row_bytes + checkpoint_bytes; }
};

// Where none is cut back: doubled from the first one on, up to the largest.
double fewest_load_steps(const Statics& statics);

OutputSize output_size_of(const Setup& setup);

// Throws ConfigError for a million frames, rows or load steps: how many they are, what they take on the disk, what to
// change, and that --yes has them written all the same.
void require_usual_output_size(const Setup& setup);

// The same as a sentence, for `orthodyn check`; "" where there are fewer.
std::string unusual_output_size(const Setup& setup);

// "1.2 GB".
std::string shown_bytes(double bytes);

}  // namespace orthodyn
