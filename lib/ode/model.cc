#include "lib/ode/model.h"

#include <stdexcept>

namespace orthodyn {

std::vector<double> OutputSource::evaluate(const std::string& name, const State&) const {
  throw std::logic_error("no output named " + name);
}

std::unique_ptr<Model> Model::only(const std::vector<std::string>&) const {
  throw std::logic_error("the model's force has no parts");
}

std::vector<double> Model::breakpoints(double, double) const { return {}; }

}  // namespace orthodyn
