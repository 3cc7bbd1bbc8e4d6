// The reading of an instrument from the result of a run:
//
//     reading(t) = gain * quantity(t + time offset) + offset.
//
// With a time offset the run has the quantity at the times of a SampledSeries, from which it is interpolated, so that
// another offset needs no other run.
#pragma once

#include <vector>

#include "lib/study/fit/problem.h"

namespace orthodyn::study::fit {

// Adds the metrics that the data of an experiment need.
void add_metrics(const PreparedExperiment& experiment, EvaluationInput& input);

class Readings {
 public:
  // `values`: of all parameters, SI. All must outlive the readings.
  Readings(const PreparedExperiment& experiment, const EvaluationResult& result, const Vector& values)
      : experiment_(experiment), result_(result), values_(values) {}

  // SI. NaN if the run has no such value. Throws Failed if the run lacks the metric.
  double reading(std::size_t datum) const;
  // Derivative of the reading with respect to the quantity.
  double gain(std::size_t datum) const;
  // Derivatives of the quantity by each path of the experiment's parameters. Precondition: Datum::has_derivatives.
  std::vector<double> derivatives(std::size_t datum) const;
  // The computed mode of a measured frequency; empty for other data.
  std::optional<ModeMatch> match(std::size_t datum) const;
  // Adds the derivatives of the reading with respect to gain, offset and time offset to `row`, which has an entry per
  // parameter value.
  void add_derivatives(std::size_t datum, Eigen::RowVectorXd& row) const;

 private:
  double quantity(std::size_t datum) const;
  double rate(std::size_t datum) const;  // time derivative of the quantity
  double time(const Datum& datum) const;
  double value(std::optional<std::size_t> parameter, double otherwise) const;

  const PreparedExperiment& experiment_;
  const EvaluationResult& result_;
  const Vector& values_;
};

}  // namespace orthodyn::study::fit
