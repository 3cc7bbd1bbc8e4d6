// Which computed mode is a measured one: by the shape, or by the nearest frequency. One-to-one.
//
// By shape: the assignment with the largest sum of the modal assurance criterion (Allemang & Brown 1982, Proc. 1st
// IMAC, 110) of the amplitudes a, measured, and b, computed, at the measured points:
//
//     MAC = (a . b)^2 / ((a . a) (b . b)),
//
// which does not depend on their scale and sign. Computed shapes are interpolated with the shape functions of the
// element at each point. MACs that differ by less than about 0.01 are decided by the frequency.
//
// By frequency: the ascending assignment with the smallest sum of squared relative differences, all within a band.
// Computed modes may be left out.
//
// Limit: of modes with equal frequencies any combination is a mode. Its MAC with a measured shape is arbitrary.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "lib/analysis/modes.h"

namespace orthodyn {

class FemModel;

// The measured modes of one list.
struct ModeMatching {
  std::vector<double> frequencies;  // Hz, ascending; NaN for one that was not measured
  double band = 0;                  // largest relative difference of frequencies; not used with shapes
  // Empty for matching by frequency: coordinates x, y, z (m) of each point in the rest shape; unit vector along which
  // it is measured; for each frequency the amplitude of each point, in any unit, NaN for one that was not measured.
  std::vector<double> points, direction;
  std::vector<std::vector<double>> shapes;

  bool is_by_shape() const { return !shapes.empty(); }
  // Number of elastic modes among which shapes are sought.
  int searched() const { return 2 * static_cast<int>(frequencies.size()) + 10; }
  // Frequency (Hz) up to which modes are sought by frequency.
  double highest() const;
};

// The computed mode of a measured one. Numbers are from 1 and leave out rigid modes.
struct ModeMatch {
  int mode = 0;  // 0: none
  double mac = std::numeric_limits<double>::quiet_NaN();
  int next = 0;  // beside `mode`, the one with the largest MAC whose frequency is within a factor of two; 0: none
  double next_mac = std::numeric_limits<double>::quiet_NaN();
  std::string failure = {};  // why there is none
};

// MAC of the entries that are not NaN in `measured`; 0 if either is zero there.
double modal_assurance(const std::vector<double>& measured, const Eigen::VectorXd& computed);

// MAC of each measured mode (row) with each computed one (column). `at_points`: a column per computed mode; those
// below 1e-6 of the mode's `largest` displacement count as zero.
Eigen::MatrixXd modal_assurances(const ModeMatching& measured, const Eigen::MatrixXd& at_points,
                                 const std::vector<double>& largest);

// By the modal assurances; NaN rows of `measured.frequencies` have no match. `computed`: frequencies, Hz.
std::vector<ModeMatch> match_by_shape(const ModeMatching& measured, const std::vector<double>& computed,
                                      const Eigen::MatrixXd& assurances);
std::vector<ModeMatch> match_by_frequency(const ModeMatching& measured, const std::vector<double>& computed);

// By the computed modes of a model; the first `modes.zeros` are left out.
std::vector<ModeMatch> match_modes(const ModeMatching& measured, const Modes& modes, const FemModel& model,
                                   const State& about);

// The distance of each point from the body (m), and the distance up to which a point is accepted: 2 % of the diagonal
// of the body's bounding box.
std::vector<double> distances_from_body(const ModeMatching& measured, const FemModel& model);
double accepted_distance(const FemModel& model);

}  // namespace orthodyn
