#include "lib/simulation/output/time_extreme.h"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>

namespace orthodyn {

namespace {

constexpr int kParts = 4;           // of a step
constexpr double kSameTime = 1e-6;  // of a step
constexpr double kJump = 1e-3;      // change between two steps, of the range, that counts as a jump

}  // namespace

void TimeExtreme::start(double t, double value) {
  last_ = {t, sample(value)};
  end_value_ = value;
}

void TimeExtreme::advance(double begin, double end, const Function& f) {
  const double h = end - begin;
  std::array<double, kParts + 1> t, s;
  for (int k = 0; k <= kParts; ++k) {
    const auto i = static_cast<std::size_t>(k);
    t[i] = k == kParts ? end : begin + h * k / kParts;
    s[i] = sample(f(t[i]));
  }
  Maximum first{begin, s[0]};  // the maximum near the begin, if the function falls after it
  if (s[0] > s[1] && is_relevant(s[0], s[0] - s[1])) first = search(t[0], t[1], f);
  const bool rises_first = first.t - begin > kSameTime * h && first.value > s[0];
  pass_joint(begin, s[0], s[0] > s[1] && !rises_first);
  end_value_ = s[kParts];
  if (rises_first) complete(first);
  for (std::size_t k = 1; k < kParts; ++k)
    if (s[k] >= s[k - 1] && s[k] > s[k + 1] && is_relevant(s[k], s[k] - std::min(s[k - 1], s[k + 1])))
      complete(search(t[k - 1], t[k + 1], f));
  if (s[kParts] > s[kParts - 1]) {
    last_ = {end, s[kParts]};
    if (!is_relevant(s[kParts], s[kParts] - s[kParts - 1])) return;
    const Maximum found = search(t[kParts - 1], end, f);
    last_.jumps = found.jumps;
    if (end - found.t > kSameTime * h && found.value > s[kParts]) complete(found), last_ = {};
  } else if (s[kParts] == s[kParts - 1]) {
    last_ = {end, s[kParts]};  // the function is constant: it has its maximum at every time
  }
}

// Completes the rise to the end of the last step, if the function falls after it, or jumps there.
void TimeExtreme::pass_joint(double t, double value, bool falls) {
  const bool jumps = std::abs(value - end_value_) > kJump * range();
  const bool rose = last_.exists();
  const Maximum joint{t, std::max(value, end_value_), jumps || last_.jumps};
  last_ = {};
  if ((rose && (falls || (jumps && value < end_value_))) || (jumps && value > end_value_ && falls)) complete(joint);
}

double TimeExtreme::sample(double value) {
  ++samples_;
  high_ = std::max(high_, value);
  low_ = std::min(low_, value);
  return value;
}

bool TimeExtreme::is_relevant(double value, double rise) const { return !(value + rise < next_.value); }

void TimeExtreme::complete(const Maximum& maximum) {
  if (!(maximum.value <= largest_.value)) next_ = largest_, largest_ = maximum;
  else if (!(maximum.value <= next_.value)) next_ = maximum;
}

TimeExtreme::Maximum TimeExtreme::search(double a, double b, const Function& f) {
  constexpr int kBits = std::numeric_limits<double>::digits / 2;
  std::uintmax_t evaluations = 50;
  // Times relative to a: the method stops at a share of the time.
  const auto [after, value] =
      boost::math::tools::brent_find_minima([&](double s) { return -f(a + s); }, 0.0, b - a, kBits, evaluations);
  samples_ += static_cast<long>(evaluations);
  high_ = std::max(high_, -value);
  const auto changes_to = [&](double time) { return std::abs(-value - f(std::clamp(time, a, b))) > kJump * range(); };
  const double t = a + after, little = kSameTime * (b - a);
  return {t, -value, changes_to(t - little) || changes_to(t + little)};
}

void TimeExtreme::save(const std::string& name, Archive& archive) const {
  std::vector<double> all;
  for (const Maximum& m : {largest_, next_, last_}) all.insert(all.end(), {m.t, m.value, m.jumps ? 1.0 : 0.0});
  all.insert(all.end(), {end_value_, high_, low_, static_cast<double>(samples_)});
  archive.put(name, std::move(all));
}

void TimeExtreme::restore(const std::string& name, const Archive& archive) {
  const auto& all = archive.numbers(name, 13);
  std::size_t next = 0;
  for (Maximum* m : {&largest_, &next_, &last_}) {
    *m = {all[next], all[next + 1], all[next + 2] != 0};
    next += 3;
  }
  end_value_ = all[9];
  high_ = all[10];
  low_ = all[11];
  samples_ = static_cast<long>(all[12]);
}

}  // namespace orthodyn
