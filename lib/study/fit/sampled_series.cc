#include "lib/study/fit/sampled_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace orthodyn::study::fit {

double number_of(const YamlText& value, const std::string& si) {
  try {
    return read_number(parsed(value), {.unit = si});
  } catch (const ConfigError& e) {
    throw ConfigError(value.origin.where, e.what());
  }
}

SampledSeries sampled_series(const Nuisance& offset, const WantedMetric& metric, std::vector<double> measured,
                             const TimeSpan& span) {
  constexpr double kDeviations = 5, kShareOfSpan = 0.1;
  constexpr int kLeast = 200, kDensity = 2;
  std::ranges::sort(measured);
  const double first = measured.front(), last = measured.back();
  SampledSeries out{metric, {}};
  out.metric.at.reset();
  if (offset.start) out.start = number_of(*offset.start, "s");
  if (offset.deviation) out.deviation = number_of(*offset.deviation, "s");
  const double reach = out.deviation ? kDeviations * *out.deviation : kShareOfSpan * (last - first);
  if (!(reach > 0))
    offset.origin.fail(out.deviation ? "the deviation must be positive" : "a table with one time needs a 'deviation'");
  const double slack = 1e-9 * (span.end - span.start);
  out.low = std::max(out.start - reach, span.start - first);
  out.high = std::min(out.start + reach, span.end - last);
  if (out.low > out.start + slack || out.high < out.start - slack || !(out.low < out.high))
    offset.origin.fail(fmt::format(
        "the table, which goes from {:.6g} to {:.6g} s with the start of its time offset, leaves no room for "
        "an offset within the time of the scene, {:.6g} to {:.6g} s: give another start, a later time.end of "
        "the scene, or a table without its first or last values",
        first + out.start, last + out.start, span.start, span.end));
  out.start = std::clamp(out.start, out.low, out.high);
  const double begin = first + out.low, end = last + out.high;
  const auto dense = kDensity * (end - begin) / std::max(last - first, reach) * static_cast<double>(measured.size());
  const int count = std::max(kLeast, static_cast<int>(std::ceil(dense)));
  for (int k = 0; k <= count; ++k) out.times.push_back(k == count ? end : begin + (end - begin) * k / count);
  return out;
}

}  // namespace orthodyn::study::fit
