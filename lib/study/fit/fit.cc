#include "lib/study/fit/fit.h"

#include <fmt/format.h>

#include "lib/simulation/run/scene_file.h"

namespace orthodyn {

using study::fit::Parameter;

ValueSchema Value<Parameter>::schema() {
  const ValueSchema section{
      .kind = ValueSchema::Kind::section, .title = "Parameter", .keys = [] { return Parameter::spec().keys(); }};
  return {.kind = ValueSchema::Kind::either, .items = {Value<std::string>::schema(), section}};
}

Parameter Value<Parameter>::read(const Config& c, const Rule&) {
  if (c.is_map()) return Parameter::spec().read(c);
  Parameter out;
  out.path = c.text();
  out.origin.where = c.where();
  return out;
}

}  // namespace orthodyn

namespace orthodyn::study::fit {

namespace {

// Keys of natural frequencies: how they are matched with computed modes.
void check_matching(const Measurement& m, const Config& config) {
  const auto require = [&](bool is_right, bool is_given, const char* key, const char* reason) {
    if (is_given && !is_right) config.at(key).fail(std::string("is not used ") + reason + "; remove it");
  };
  const bool has_list = !m.frequencies.empty();
  const char* const only = "without 'frequencies': a single 'mode' is matched by its number";
  require(has_list, m.match.has_value(), "match", only);
  require(has_list, m.shapes.has_value(), "shapes", only);
  require(m.shapes.has_value(), m.direction.has_value(), "direction", "without 'shapes'");
  require(m.match_by() == MatchBy::nearest, m.band.has_value(), "band", "without 'match: nearest'");
  if (m.shapes && m.match_by() != MatchBy::shape)
    config.at("match").fail("'shapes' match modes by shape; remove 'match', or remove 'shapes'");
  if (m.match_by() == MatchBy::shape && !m.shapes)
    config.at("match").fail("matching by shape needs 'shapes', a CSV file with measured amplitudes");
  if (m.shapes && !m.direction)
    config.fail("key 'direction' is missing: the direction along which 'shapes' are measured, such as [0, 0, 1]");
  if (m.direction && !(m.direction->norm() > 0)) config.at("direction").fail("is zero; give a direction");
}

void check_measurement(const Measurement& m, const Config& config) {
  const int kinds = !m.quantity.empty() + m.mode.has_value() + !m.frequencies.empty();
  if (kinds != 1) config.fail("give exactly one of: quantity, mode, frequencies");
  if (m.deviation.has_value() + m.relative.has_value() + !m.deviation_column.empty() + !m.deviations.empty() != 1)
    config.fail(
        "give the standard deviation of the measurement by one of: 'deviation' in its unit; 'relative' (0.01 for 1 %); "
        "'deviation_column' of a table; 'deviations', one for each of 'frequencies'");
  const auto refuse = [&](bool is_given, const char* key, const char* reason) {
    if (is_given) config.at(key).fail(std::string("is not used ") + reason + "; remove it");
  };
  refuse(!m.deviation_column.empty() && !m.table, "deviation_column", "without 'table'");
  if (!m.deviations.empty() && m.deviations.size() != m.frequencies.size())
    config.at("deviations")
        .fail(fmt::format("has {} entries, and 'frequencies' has {}: give one for each", m.deviations.size(),
                          m.frequencies.size()));
  if (!m.frequencies.empty()) {
    refuse(m.value.has_value(), "value", "with 'frequencies', which are values themselves");
    refuse(m.table.has_value(), "table", "with 'frequencies', which are values themselves");
  }
  if (m.quantity.empty()) {
    refuse(m.at.has_value(), "at", "for natural frequencies");
    refuse(m.response.has_value(), "response", "for natural frequencies");
    refuse(m.frequency.has_value(), "frequency", "for natural frequencies");
  }
  if (m.mode) refuse(m.table.has_value(), "table", "for one natural frequency");
  check_matching(m, config);
  if (m.table) {
    refuse(m.value.has_value(), "value", "with 'table', which has the values");
    refuse(m.at.has_value(), "at", "with 'table', whose column 'over' has the times");
    refuse(m.frequency.has_value(), "frequency", "with 'table', whose column 'over' has the frequencies");
    if (m.column.empty()) config.fail("key 'column' is missing: the column of the table that has the values");
  } else {
    refuse(!m.column.empty(), "column", "without 'table'");
    refuse(!m.over.empty(), "over", "without 'table'");
    refuse(!m.unit.empty(), "unit", "without 'table'; write the unit after the value");
    refuse(m.time_offset.has_value(), "time_offset", "without 'table'");
  }
}

void check_values(const Named<Experiment>& experiments, const Config& config, bool wants_values) {
  for (const auto& [name, experiment] : experiments) {
    if (experiment.measured.empty()) config.at(name).at("measured").fail("is empty; name at least one measured value");
    for (std::size_t i = 0; i < experiment.measured.size(); ++i) {
      const Measurement& m = experiment.measured[i];
      const Config at = config.at(name).at("measured").at(i);
      const bool has_values = m.value || m.table || !m.frequencies.empty();
      if (wants_values && !has_values) at.fail("has no measured 'value' (or 'table')");
      if (!wants_values && (m.gain || m.offset || m.time_offset))
        at.fail("a candidate has no gain, offset or time_offset: they are estimated from measured values");
      if (!wants_values && has_values)
        at.fail("a candidate has no measured values: give quantity or mode and the deviation that you expect");
    }
  }
}

void check_fit(const Fit& fit, const Config& config) {
  if (fit.experiments.empty()) config.at("experiments").fail("is empty");
  if (fit.parameters.empty()) config.at("parameters").fail("is empty; name at least one number of the scenes");
  check_values(fit.experiments, config.at("experiments"), true);
  if (!fit.candidates.empty()) check_values(fit.candidates, config.at("candidates"), false);
}

}  // namespace

const Spec<Nuisance>& Nuisance::spec() {
  static const auto s =
      Spec<Nuisance>()
          .key("start", &Nuisance::start, "Expected value; default 1 for a gain, else 0.")
          .key("deviation", &Nuisance::deviation,
               "Standard deviation of `start`, which then counts as one more measured value. Default: nothing is known "
               "of it.")
          .key("name", &Nuisance::name,
               "Name in results; default EXPERIMENT.N.gain, with the number N of the entry from 1. Entries with the "
               "same "
               "name share one value, as those of one amplifier.");
  return s;
}

const Spec<Measurement>& Measurement::spec() {
  static const auto s =
      Spec<Measurement>()
          .key("quantity", &Measurement::quantity,
               "A probe's field and component (tip.displacement.z) or a scalar of the whole body (energy.elastic), as "
               "in the `expect` list of a scene.")
          .key("mode", &Measurement::mode, "A natural frequency by its number, not counting rigid modes.",
               {.unit = "", .range = {1, 1000}})
          .key("frequencies", &Measurement::frequencies,
               "The lowest natural frequencies in ascending order (with `shapes` in any order), without rigid modes: "
               "[51.2 Hz, 80 Hz]; null for one that was not measured.")
          .key("match", &Measurement::match,
               "How `frequencies` find their computed modes. order: by number. nearest: the nearest frequencies in "
               "ascending order within `band`; computed modes may be left out, for lists that lack a mode. shape: by "
               "`shapes`. Default: shape if there are shapes, else order.")
          .key("band", &Measurement::band,
               "Of `match: nearest`: largest relative difference between a measured and its computed frequency; "
               "default 0.2.",
               {.range = {0, 1, true, true}})
          .key("shapes", &Measurement::shapes,
               "CSV file with measured shapes: columns x, y and z of the points in the rest shape, with a unit as in x "
               "[mm], and for each of `frequencies` a column (mode 1, mode 2, ...) with the amplitude along "
               "`direction`, in any unit and with its sign. Empty entries are amplitudes that were not measured.")
          .key("direction", &Measurement::direction,
               "Direction along which all amplitudes of `shapes` were measured, such as [0, 0, 1]; of any length.")
          .key("at", &Measurement::at, "Time of the measured value; default the end.", {.unit = "s"})
          .key("response", &Measurement::response, kResponseSentence)
          .key("frequency", &Measurement::frequency, kFrequencySentence, {.unit = "Hz", .range = kPositive})
          .key("value", &Measurement::value, "The measured value.", {.unit = kUnitOfQuantity})
          .key("table", &Measurement::table,
               "Instead of `value`: a CSV file with the measured values over time, in a harmonic analysis over "
               "frequency. The first line names the columns. Empty entries are values that were not measured.")
          .key("column", &Measurement::column, "Column of the table with the measured values.")
          .key("over", &Measurement::over, "Column of the table with times or frequencies; default its first column.")
          .key("unit", &Measurement::unit,
               "Unit of the column's values; default the one in brackets in its name (z [mm]), otherwise SI.")
          .key("deviation", &Measurement::deviation, "Standard deviation of each measured value, or `relative`.",
               {.unit = kUnitOfQuantity, .range = kPositive})
          .key("relative", &Measurement::relative,
               "Standard deviation as a fraction of each measured value; of a candidate, of its computed value.",
               {.range = kPositive})
          .key("deviation_column", &Measurement::deviation_column,
               "Column of the table with the standard deviation of each value, in the unit of the values unless its "
               "name has one in brackets.")
          .key("deviations", &Measurement::deviations,
               "Standard deviations of `frequencies`, one for each: [0.3 Hz, 0.5 Hz]; null where it was not measured.")
          .key("gain", &Measurement::gain,
               "The instrument reads gain * quantity + offset, and the gain is estimated with the parameters: {start, "
               "deviation}, such as {deviation: 0.02} for a gauge whose factor is known to 2 %.")
          .key("offset", &Measurement::offset,
               "The instrument's zero, likewise: {start, deviation} in the unit of the quantity.")
          .key("time_offset", &Measurement::time_offset,
               "Of a table over time: its time t is the scene's time t + time_offset, because the recorder started at "
               "an "
               "unknown moment. {start, deviation}; it stays within five deviations, without one within a tenth of the "
               "table's span.")
          .check(check_measurement);
  return s;
}

const Spec<Experiment>& Experiment::spec() {
  static const auto s =
      Spec<Experiment>()
          .key("scene", &Experiment::scene, "The scene of the experiment: a file, or {file, set}.", {.required = true})
          .key("measured", &Experiment::measured, "The measured values.", {.required = true});
  return s;
}

const Spec<Prior>& Prior::spec() {
  static const auto s = Spec<Prior>()
                            .key("value", &Prior::value, "Expected value.", {.required = true})
                            .key("deviation", &Prior::deviation, "Standard deviation.", {.required = true});
  return s;
}

const Spec<Parameter>& Parameter::spec() {
  static const auto s =
      Spec<Parameter>()
          .key("path", &Parameter::path,
               "A number of the scenes by its path, such as materials.spruce.young.0. Scenes without this key are left "
               "as they are.",
               {.required = true})
          .key("also", &Parameter::also, "Further paths that get the same value.")
          .key("start", &Parameter::start, "First value of the search; default that of the first scene.")
          .key("lower", &Parameter::lower, "Smallest allowed value.")
          .key("upper", &Parameter::upper, "Largest allowed value.")
          .key("prior", &Parameter::prior,
               "What is known without the measurements: {value, deviation}. It counts as one more measured value.")
          .key("scale", &Parameter::scale,
               "log: the search changes the value by factors. linear: by differences. Default: log for positive "
               "numbers; linear for angles and negative numbers. Poisson's ratios have their own coordinates, in which "
               "every material is stable.")
          .key(
              "smoothness", &Parameter::smoothness,
              "For the path of a region's stiffness_factors, which stands for the factors of all cells of its grid, at "
              "most 2000: standard deviation of the logarithm of the ratio of neighbouring factors, 0.1 for 10 %.",
              {.range = kPositive});
  return s;
}

const Spec<Fit>& Fit::spec() {
  static const auto s =
      Spec<Fit>()
          .key("title", &Fit::title, "Heading of the report; default the file's name.")
          .key("description", &Fit::description, "One or two sentences for the report.")
          .key("experiments", &Fit::experiments, "Scenes with their measured values, by name.", {.required = true})
          .key("parameters", &Fit::parameters,
               "Numbers of the scenes that are to be found, by name: a path or a section.", {.required = true})
          .key("candidates", &Fit::candidates,
               "Experiments that could be done next, by name: `measured` names quantity or mode and the deviation that "
               "you expect. The report tells by how much each would shrink the intervals of the parameters.")
          .key(
              "loss", &Fit::loss,
              "squares: least squares. huber, cauchy: residuals above one standard deviation count less, for data with "
              "outliers.")
          .key(
              "intervals", &Fit::intervals,
              "linear: from the linearised covariance. profile: also by profile likelihood, the values at which "
              "chi-square, minimised over the other parameters, rises by 3.84. Takes a few searches per parameter; for "
              "intervals that are wide or at the edge of the stable range.")
          .key("starts", &Fit::starts, "Number of searches, each from another start. The best result is kept.",
               {.range = {1, 1000}})
          .key("seed", &Fit::seed, "Seed of the further starts.")
          .key("spread", &Fit::spread, "Further starts are between start / spread and start * spread, or the bounds.",
               {.range = {1, 1e6, true, false}})
          .key("iterations", &Fit::iterations, "Largest number of iterations of a search.", {.range = {1, 10000}})
          .key("tolerance", &Fit::tolerance, "Relative change of the parameters at which a search ends.",
               {.range = {1e-14, 0.1}})
          .key("refine", &Fit::refine,
               "Also compute the experiments once with refined meshes and time steps, and tell by how much these move "
               "the "
               "parameters.")
          .key("limits", &Fit::limits, "Wall time and memory limits of each run.")
          .check(check_fit);
  return s;
}

Fit read_fit(const Config& config) {
  refuse_other_kinds(config, InputFile::fit);
  Fit fit = Fit::spec().read(config);
  fit.name = stem(config.file());
  if (fit.title.empty()) fit.title = fit.name;
  return fit;
}

}  // namespace orthodyn::study::fit
