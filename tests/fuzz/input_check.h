// Runs the checks of `orthodyn check` on an input, in this process. An input must be accepted, or refused with a
// ConfigError that names a place; anything else is a bug. Studies are read and their points expanded.
#pragma once

#include <string>
#include <vector>

namespace orthodyn {

// A YAML text in place of the file at `path`. Files named in the text are searched relative to this path.
struct InputFileText {
  std::string path;  // relative to the source tree, such as "configs/scenes/stem.yaml"
  std::string text;
};

// All YAML files below configs/, sorted by path.
std::vector<InputFileText> shipped_inputs();

// Sets RLIMIT_RSS of this process to 10 MB, so that scenes with larger meshes are refused.
void limit_memory_of_meshes();

enum class Verdict { accepted, refused, bug };

struct InputVerdict {
  Verdict verdict = Verdict::accepted;
  std::string message;  // of the exception; empty if accepted
};

InputVerdict judge(const InputFileText& input);

}  // namespace orthodyn
