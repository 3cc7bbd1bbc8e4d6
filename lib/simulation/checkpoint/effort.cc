#include "lib/simulation/checkpoint/effort.h"

#include <utility>

namespace orthodyn {

namespace {

// Each figure once: (name, member).
constexpr std::pair<const char*, long Statistics::*> kCounts[] = {
    {"steps", &Statistics::steps},
    {"rejected_steps", &Statistics::rejected_steps},
    {"error_test_failures", &Statistics::error_test_failures},
    {"convergence_failures", &Statistics::convergence_failures},
    {"newton_iterations", &Statistics::newton_iterations},
    {"gauss_newton_fallbacks", &Statistics::gauss_newton_fallbacks}};
constexpr std::pair<const char*, Cost Statistics::*> kCosts[] = {
    {"force", &Statistics::force}, {"tangent", &Statistics::tangent}, {"factorization", &Statistics::factorization},
    {"solve", &Statistics::solve}, {"modes", &Statistics::modes},     {"observation", &Statistics::observation}};

}  // namespace

Archive Effort::archive() const {
  Archive out;
  for (const auto& [name, count] : kCounts) out.put(name, static_cast<double>(statistics.*count));
  for (const auto& [name, cost] : kCosts)
    out.put(name, {static_cast<double>((statistics.*cost).count), (statistics.*cost).seconds});
  out.put("seconds", {wall_seconds, cpu_seconds});
  return out;
}

Effort Effort::from(const Archive& archive) {
  Effort out;
  for (const auto& [name, count] : kCounts) out.statistics.*count = static_cast<long>(archive.count(name));
  for (const auto& [name, cost] : kCosts) {
    const auto& values = archive.numbers(name, 2);
    out.statistics.*cost = {static_cast<long>(values[0]), values[1]};
  }
  const auto& seconds = archive.numbers("seconds", 2);
  out.wall_seconds = seconds[0];
  out.cpu_seconds = seconds[1];
  return out;
}

Effort operator+(const Effort& a, const Effort& b) {
  Effort sum = a;
  for (const auto& [name, count] : kCounts) sum.statistics.*count += b.statistics.*count;
  for (const auto& [name, cost] : kCosts) {
    (sum.statistics.*cost).count += (b.statistics.*cost).count;
    (sum.statistics.*cost).seconds += (b.statistics.*cost).seconds;
  }
  sum.wall_seconds += b.wall_seconds;
  sum.cpu_seconds += b.cpu_seconds;
  return sum;
}

}  // namespace orthodyn
