#include "lib/ode/model.h"

#include <stdexcept>

namespace orthodyn {

std::vector<double> OutputSource::evaluate(const std::string& name, const State&) const {
  throw std::logic_error("no output named " + name);
}

std::vector<double> Model::breakpoints(double, double) const { return {}; }

}  // namespace orthodyn
