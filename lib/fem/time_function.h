// A factor in time for loads. One kind per file section, chosen by `type`.
#pragma once

#include <memory>
#include <vector>

#include "lib/core/registry.h"

namespace orthodyn {

class TimeFunction {
 public:
  virtual ~TimeFunction() = default;
  virtual double value(double t) const = 0;
  virtual bool constant() const { return false; }
  virtual std::vector<double> kinks() const { return {}; }  // where it is not smooth
  virtual double peak() const = 0;                          // the largest magnitude it reaches
};

}  // namespace orthodyn
