// One metric of a quantity's course over time, as an expectation names it.
#pragma once

#include <vector>

#include "lib/scene/expectation.h"
#include "lib/study/quantities/series.h"

namespace orthodyn {

// Of the recorder's quantity; NaN where its course has no such metric.
double metric(const Expectation& wanted, const SeriesRecorder& recorder, std::size_t quantity);

// Output times that the run must have, ascending.
std::vector<double> times_asked_for(const std::vector<Expectation>& wanted, double start);

}  // namespace orthodyn
