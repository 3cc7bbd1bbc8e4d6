// What a fit says about its parameters: intervals, correlations, combinations that the data do not determine, tests of
// the residuals, and the value of further experiments. All are linearised about the result: with the weighted
// derivatives J = U S V^T the covariance of the coordinates z is V S^-2 V^T. With a loss other than squares, each
// residual has the weight that the loss gives it at the result.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/study/fit/search.h"

namespace orthodyn::study::fit {

// A combination of coordinates, from a singular vector of J.
struct Direction {
  double deviation = 0;     // standard deviation along it; infinite if the data say nothing
  Eigen::VectorXd weights;  // of the coordinates; a unit vector
};

// How well the data determine a parameter. Undetermined: the standard deviation of its coordinate is at least 1, a
// factor e of a logarithmic one. Determined: it is below 0.1 (10 %, or 0.1 rad); of a Poisson's ratio, that of the
// value is below 0.05.
enum class Knowledge { determined, poorly_determined, undetermined };

// Result for one parameter, in SI units.
struct Estimate {
  double value = 0, deviation = 0;  // standard deviation, to first order
  double low = 0, high = 0;         // 95 % interval; of a log coordinate value / f and value * f
  double deviation_z = 0;           // of the coordinate
  Knowledge knowledge = Knowledge::undetermined;
  bool at_bound = false;
};

struct NoiseTest {
  double chi_square = 0;  // of data and priors; beside a field, of the data
  long freedom = 0;       // number of residuals less number of parameters that the data determine
  // Probability of a chi_square this large or larger, if the deviations are right; empty if freedom is 0.
  std::optional<double> probability;
  // Probability of as few or fewer changes of sign between neighbouring residuals (Wald & Wolfowitz 1940); empty for
  // fewer than 10 residuals.
  std::optional<double> runs_probability;
  // Factor by which the deviations were enlarged, sqrt(chi_square / freedom), because the probability is below 1 %.
  double factor = 1;
  // Bayesian information criterion (Schwarz 1978): chi_square + parameters * ln(residuals), for known deviations. NaN
  // beside a field.
  double information_criterion = 0;
};

struct Statistics {
  Eigen::MatrixXd covariance;   // of the coordinates
  Eigen::MatrixXd correlation;  // NaN for a parameter that the data do not determine
  std::vector<Estimate> estimates;
  std::vector<Direction> directions;  // from the worst determined to the best
  NoiseTest noise;
};

Statistics statistics_of(const Problem& problem, const Search& search, Loss loss);

// Change of the parameters by one refinement of the meshes, to first order: the step of Gauss and Newton for the
// changed data. In SI units.
Vector shift_by_refinement(const Problem& problem, const Search& search, Loss loss, const Evaluation& refined);

// A candidate's effect on the covariance, to first order.
struct CandidateValue {
  std::string name;
  std::vector<double> deviations;  // of the parameters after it, SI
  double determinant_gain = 0;     // D-optimality: factor by which the volume of the confidence region shrinks
  double trace_gain = 0;           // A-optimality: factor by which the sum of the variances of z shrinks
};

// `at`: the data of all candidates at the result.
std::vector<CandidateValue> values_of_candidates(const Problem& problem, const Search& search, Loss loss,
                                                 const Statistics& statistics, const Evaluation& at);

}  // namespace orthodyn::study::fit
