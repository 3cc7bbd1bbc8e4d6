// The samples of a table with a time offset.
#pragma once

#include "lib/scene/scene.h"
#include "lib/study/fit/data.h"

namespace orthodyn::study::fit {

// A number of a nuisance in SI units. Throws ConfigError.
double number_of(const YamlText& value, const std::string& si);

// Samples of `metric` at evenly spaced times that cover the measured ones, shifted by any allowed offset: twice as
// dense as the measured ones, and at least 200. Throws ConfigError if the start of the offset lets the table exceed the
// scene's time span.
SampledSeries sampled_series(const Nuisance& offset, const WantedMetric& metric, std::vector<double> measured,
                             const TimeSpan& span);

}  // namespace orthodyn::study::fit
