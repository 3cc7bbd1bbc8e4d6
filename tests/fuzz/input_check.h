// What `orthodyn check` does with an input, in this process, and whether it ended as it may: the input is accepted, or
// refused with an error of our own that names a place. Studies are read and their points expanded.
#pragma once

#include <string>
#include <vector>

namespace orthodyn {

// A YAML file by its path in this tree, from which the files that it names are found.
struct InputFileText {
  std::string path;  // "configs/scenes/stem.yaml"
  std::string text;
};

// Every scene, case, comparison, sweep and matrix of configs/.
std::vector<InputFileText> shipped_inputs();

// A process does not get more memory than this by the mesh of a scene: a mesh that needs more is refused.
void limit_memory_of_meshes();

enum class Verdict { accepted, refused, bug };

struct InputVerdict {
  Verdict verdict = Verdict::accepted;
  std::string message;  // of the exception
};

InputVerdict judge(const InputFileText& input);

}  // namespace orthodyn
