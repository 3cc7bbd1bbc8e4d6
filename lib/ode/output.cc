#include "lib/ode/output.h"

#include <stdexcept>

namespace orthodyn {

namespace {

class NoOutputs : public StateView {
 public:
  std::vector<double> evaluate(const std::string& name) const override {
    throw std::logic_error("no output named " + name);
  }
};

}  // namespace

std::unique_ptr<StateView> OutputSource::view(const State&) const { return std::make_unique<NoOutputs>(); }

}  // namespace orthodyn
