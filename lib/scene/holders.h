// What holds each coordinate of a mesh: nothing, a clamp, or one of the motions.
#pragma once

#include <vector>

#include "lib/scene/supports.h"

namespace orthodyn {

class Holders {
 public:
  static constexpr int kNone = 0, kClamp = 1;
  // Index of the motion with this number, in Supports::moved; -1 for a clamp.
  static int motion(int holder) { return holder <= kClamp ? -1 : holder - 2; }

  explicit Holders(const Supports& supports) {
    for (const bool held : supports.held) holders_.push_back(held ? kClamp : kNone);
    for (std::size_t k = 0; k < supports.moved.size(); ++k)
      for (const int node : supports.moved[k].nodes)
        for (std::size_t c = 0; c < 3; ++c)
          if (supports.moved[k].components[c]) holders_[index(node, c)] = static_cast<int>(k) + 2;
  }

  int of(int node, std::size_t component) const { return holders_[index(node, component)]; }

 private:
  static std::size_t index(int node, std::size_t component) { return 3 * static_cast<std::size_t>(node) + component; }

  std::vector<int> holders_;
};

}  // namespace orthodyn
