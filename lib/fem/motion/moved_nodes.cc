#include "lib/fem/motion/moved_nodes.h"

#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {

namespace {

void copy_moved(const MovedNodes::Part& part, const NodalVector& from, NodalVector& to) {
  for (std::size_t i = 0; i < part.nodes.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (part.components[static_cast<std::size_t>(c)]) to(c, part.nodes[i]) = from(c, static_cast<Eigen::Index>(i));
}

}  // namespace

MovedNodes::MovedNodes(std::vector<Part> parts, const NodalVector& rest)
    : parts_(std::move(parts)), num_nodes_(rest.cols()) {
  for (const Part& part : parts_) rest_.push_back(rest(Eigen::all, part.nodes));
}

void MovedNodes::place(double t, NodalVector& u, NodalVector& v) const {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Moved moved = parts_[k].motion->at(t, rest_[k]);
    copy_moved(parts_[k], moved.u, u);
    copy_moved(parts_[k], moved.v, v);
  }
}

NodalVector MovedNodes::accelerations(double t) const {
  NodalVector a = NodalVector::Zero(3, num_nodes_);
  for (std::size_t k = 0; k < parts_.size(); ++k) copy_moved(parts_[k], parts_[k].motion->at(t, rest_[k]).a, a);
  return a;
}

std::size_t MovedNodes::num_coordinates() const {
  std::size_t sum = 0;
  for (const Part& part : parts_)
    for (const bool moved : part.components) sum += moved ? part.nodes.size() : 0;
  return sum;
}

std::vector<double> MovedNodes::breakpoints(double start, double end) const {
  std::vector<double> times;
  for (const Part& part : parts_) {
    const auto more = times_between(part.motion->kinks(), start, end);
    times.insert(times.end(), more.begin(), more.end());
  }
  return times;
}

StepLimits MovedNodes::step_limits(double start, double end) const {
  StepLimits limits;
  for (std::size_t k = 0; k < parts_.size(); ++k) limits.add(parts_[k].motion->step_limits(start, end, rest_[k]));
  return limits;
}

std::size_t MovedNodes::bytes() const {
  std::size_t sum = 0;
  for (const Part& part : parts_) sum += part.nodes.size() * (sizeof(int) + sizeof(Vec3));
  return sum;
}

}  // namespace orthodyn
