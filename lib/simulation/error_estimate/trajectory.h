// States and quantities at chosen times, for the computation of errors.
#pragma once

#include <filesystem>
#include <vector>

#include "lib/core/types.h"

namespace orthodyn {

struct Trajectory {
  std::vector<double> times;        // s
  Eigen::MatrixXd q, v;             // one column per time
  Eigen::MatrixXd quantities = {};  // one column per time; rows: see FollowedQuantity

  // Write and read a binary file, which is written atomically. Throw RunError.
  void save(const std::filesystem::path& path) const;
  static Trajectory load(const std::filesystem::path& path);

  // True if the file is complete and its content agrees with the fingerprint stored in it.
  static bool is_whole(const std::filesystem::path& path);
};

}  // namespace orthodyn
