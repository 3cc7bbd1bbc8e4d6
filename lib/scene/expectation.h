// A metric that is known from elsewhere: of a quantity over time or in equilibrium, a natural frequency, or a critical
// load factor. A scene with expectations is a test case for `orthodyn verify`.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "lib/config/measured.h"
#include "lib/config/spec.h"

namespace orthodyn {

// How one metric is taken from a quantity's course over time.
enum class Take { end, max, min, time_of_max, time_of_min, mean, frequency, drift, gain, onset };

template <>
struct EnumNames<Take> {
  static constexpr std::array<std::pair<Take, const char*>, 10> list{{{Take::end, "end"},
                                                                      {Take::max, "max"},
                                                                      {Take::min, "min"},
                                                                      {Take::time_of_max, "time_of_max"},
                                                                      {Take::time_of_min, "time_of_min"},
                                                                      {Take::mean, "mean"},
                                                                      {Take::frequency, "frequency"},
                                                                      {Take::drift, "drift"},
                                                                      {Take::gain, "gain"},
                                                                      {Take::onset, "onset"}}};
};

// Throws ConfigError at `config` for a `take` that does not go with the keys `at` and `of`.
void check_take(Take take, const std::optional<double>& at, const std::optional<double>& of, const Config& config);

// The SI unit of a metric of a quantity that has the given one; "" for a plain number.
std::string metric_unit(Take take, const std::string& quantity_unit);

// What the key `take` means, for those who read the input.
inline constexpr const char* kTakeSentence =
    "Which metric of its history. drift is the largest change from the start, gain the largest rise above it, "
    "both relative to `of`; default the initial size, for energy.balance the largest energy. onset is the time at "
    "which its size first passes `of`.";
inline constexpr const char* kOfSentence = "What a drift or gain is relative to; the size that an onset passes.";

// Of exactly one of: quantity, mode, buckling.
struct Expectation {
  std::string quantity;         // "tip.displacement.z", "energy.balance", "momentum.angular.magnitude"
  std::optional<int> mode;      // from 1, rigid modes not counted: its frequency in Hz, about the shape at rest
  std::optional<int> buckling;  // from 1: the critical load factor
  Take take = Take::end;
  std::optional<double> at;          // s, in place of `take`
  Measured value;                    // in the quantity's unit
  std::string source;                // where the value is known from
  std::optional<double> relative;    // the tolerance: this
  std::optional<Measured> absolute;  // or this
  std::optional<Measured> of;        // of a drift or gain: what it is relative to; of an onset: the size that is passed
  std::string reason;                // why the tolerance is what it is
  double degraded = 10;  // times the tolerance: up to there `orthodyn stability` calls it degraded, not failed
  SourceLocation origin;
  static const Spec<Expectation>& spec();

  // Known without a motion or an equilibrium.
  bool is_eigenvalue() const { return mode || buckling; }

  // Throws ConfigError for a unit that is none of the quantity's; its own is SI.
  void require_units(const std::string& quantity_unit) const;

  // The largest |computed - value| that passes.
  double limit() const;
  // "max of tip.displacement.z", "frequency of mode 4", "critical load factor 1"
  std::string title() const;
};

}  // namespace orthodyn
