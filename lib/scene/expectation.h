// An entry of the list `expect`: a reference value of a metric of a quantity (over time or in equilibrium), of a
// natural frequency, or of a critical load factor. A scene with expectations is a test case for `orthodyn verify`.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "lib/config/quantity_value.h"
#include "lib/config/spec.h"

namespace orthodyn {

// The metric that is taken of a quantity's history.
enum class TimeReduction { end, max, min, time_of_max, time_of_min, mean, frequency, drift, gain, onset };

template <>
struct EnumNames<TimeReduction> {
  static constexpr std::array<std::pair<TimeReduction, const char*>, 10> list{
      {{TimeReduction::end, "end"},
       {TimeReduction::max, "max"},
       {TimeReduction::min, "min"},
       {TimeReduction::time_of_max, "time_of_max"},
       {TimeReduction::time_of_min, "time_of_min"},
       {TimeReduction::mean, "mean"},
       {TimeReduction::frequency, "frequency"},
       {TimeReduction::drift, "drift"},
       {TimeReduction::gain, "gain"},
       {TimeReduction::onset, "onset"}}};
};

// The metric that is taken of a quantity's response in a harmonic analysis: amplitude and phase at a frequency, the
// largest amplitude in the range of frequencies, or the frequency of the latter.
enum class ResponseMetric { amplitude, phase, peak, peak_frequency };

template <>
struct EnumNames<ResponseMetric> {
  static constexpr std::array<std::pair<ResponseMetric, const char*>, 4> list{
      {{ResponseMetric::amplitude, "amplitude"},
       {ResponseMetric::phase, "phase"},
       {ResponseMetric::peak, "peak"},
       {ResponseMetric::peak_frequency, "peak_frequency"}}};
};

// amplitude with a frequency, else peak
ResponseMetric default_response(const std::optional<double>& frequency);

// Throws ConfigError at `config` unless `frequency` is given for amplitude and phase only.
void check_response_metric(ResponseMetric response, const std::optional<double>& frequency, const Config& config);

// SI unit of a metric of a response with the given unit.
std::string metric_unit(ResponseMetric response, const std::string& quantity_unit);

// "amplitude of tip.displacement.z at 120 Hz"
std::string response_title(ResponseMetric response, const std::string& quantity,
                           const std::optional<double>& frequency);

// Documentation of the keys `response` and `frequency`.
inline constexpr const char* kResponseSentence =
    "In a harmonic analysis, instead of `take`: amplitude or phase of the quantity at `frequency`, its largest "
    "amplitude "
    "in the range (peak), or the frequency of that peak; default amplitude with `frequency`, else peak.";
inline constexpr const char* kFrequencySentence = "Frequency at which amplitude or phase are taken.";

// Throws ConfigError at `config` if `take` is not compatible with the keys `at` and `of`.
void check_take(TimeReduction take, const std::optional<double>& at, const std::optional<double>& of,
                const Config& config);

// SI unit of a metric of a quantity with the given unit; "" if dimensionless.
std::string metric_unit(TimeReduction take, const std::string& quantity_unit);

// Documentation of the keys `take` and `of`.
inline constexpr const char* kTakeSentence =
    "Metric of the quantity's history. drift is the largest change from the start, gain the largest rise above it, "
    "both relative to `of`; default the initial size, for energy.balance the largest energy. onset is the time at "
    "which its size first exceeds `of`.";
inline constexpr const char* kOfSentence = "Reference value of a drift or gain; threshold of an onset.";

// Has exactly one of quantity, mode, buckling.
struct Expectation {
  std::string quantity;         // "tip.displacement.z", "energy.balance", "momentum.angular.magnitude"
  std::optional<int> mode;      // number from 1, without rigid modes; value: frequency about the rest shape, Hz
  std::optional<int> buckling;  // number from 1; value: critical load factor
  TimeReduction take = TimeReduction::end;
  std::optional<double> at;                // s, instead of `take`
  std::optional<ResponseMetric> response;  // in a harmonic analysis, instead of `take`
  std::optional<double> frequency;         // of the response, Hz
  QuantityValue value;                     // in the quantity's unit
  std::string source;                      // source of the value
  std::optional<double> relative;          // tolerance relative to `value`
  std::optional<QuantityValue> absolute;   // tolerance; exactly one of the two
  std::optional<QuantityValue> of;         // reference of a drift or gain, threshold of an onset
  std::string reason;                      // reason for the tolerance
  double degraded = 10;  // `orthodyn stability`: up to this multiple of the tolerance counts as degraded
  SourceLocation origin;
  static const Spec<Expectation>& spec();

  // Whether the value is an eigenvalue, which needs neither a motion nor an equilibrium.
  bool is_eigenvalue() const { return mode || buckling; }

  // `response`, or its default.
  ResponseMetric response_metric() const;

  // Throws ConfigError if a value has a unit of another dimension than the quantity's SI unit.
  void require_units(const std::string& quantity_unit) const;
  // Likewise for the response of a quantity in a harmonic analysis.
  void require_response_units(const std::string& quantity_unit) const;

  // Tolerance: the largest |computed - value| that passes.
  double limit() const;
  // "max of tip.displacement.z", "frequency of mode 4", "critical load factor 1"
  std::string title() const;

 private:
  void require_unit(const std::string& unit) const;
};

}  // namespace orthodyn
