// Precompiled headers. Each source still includes what it uses; to build without this file:
//   cmake --preset release -D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/registry.h"
#include "lib/config/spec.h"
#include "lib/core/types.h"
