// The result of a fit as CSV tables and as text for a terminal.
#include <fmt/format.h>

#include <cmath>

#include "lib/study/fit/result.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::fit {

namespace {

// "profile 10.2 to 11.6 GPa"; beyond an open end, chi-square stays below the limit up to the bound.
std::string profile_text(const Json& parameter) {
  const auto text = [&](const char* key) {
    const Json& end = parameter.at("profile").at(key);
    return end.at("value").is_null()
               ? std::string("unknown")
               : fmt::format("{:.5g}{}", end.at("value").get<double>(), end.at("open").get<bool>() ? " (bound)" : "");
  };
  return fmt::format("profile {} to {} {}", text("low"), text("high"), parameter.at("unit").get<std::string>());
}

}  // namespace

std::string parameters_csv(const Json& table) {
  std::string out = "parameter,unit,value,deviation,low,high,start,knowledge,shift,profile_low,profile_high\n";
  for (const Json& p : table.at("parameters")) {
    std::string row;
    for (const char* key : {"name", "unit", "value", "deviation", "low", "high", "start", "knowledge", "shift"})
      row += (row.empty() ? "" : ",") + csv_cell(p.at(key));
    for (const char* end : {"low", "high"})
      row += "," + (p.at("profile").is_null() ? "" : csv_cell(p.at("profile").at(end).at("value")));
    out += row + "\n";
  }
  return out;
}

std::string data_csv(const Json& table) {
  std::string out = "experiment,datum,unit,over,measured,deviation,computed,residual,mode,mac\n";
  for (const Json& d : table.at("data")) {
    std::string row;
    for (const char* key :
         {"experiment", "title", "unit", "over", "measured", "deviation", "computed", "residual", "mode", "mac"})
      row += (row.empty() ? "" : ",") + csv_cell(d.at(key));
    out += row + "\n";
  }
  return out;
}

std::string fit_text(const Json& table) {
  std::string out;
  if (!table.at("parameters").empty())
    out = fmt::format("  {:16} {:>14} {:>30}   {}\n", "parameter", "value", "95 % interval", "");
  for (const Json& p : table.at("parameters")) {
    const std::string unit = p.at("unit");
    const double low = number_or_nan(p.at("low")), high = number_or_nan(p.at("high"));
    const std::string interval = std::isfinite(low) && std::isfinite(high)
                                     ? fmt::format("{:.5g} to {:.5g} {}", low, high, unit)
                                     : std::string("unknown");
    out += fmt::format("  {:16} {:>14} {:>30}   {}\n", p.at("name").get<std::string>(),
                       fmt::format("{:.5g} {}", number_or_nan(p.at("value")), unit), interval,
                       p.at("knowledge").get<std::string>());
    if (!p.at("profile").is_null()) out += fmt::format("  {:16} {:>14} {:>30}\n", "", "", profile_text(p));
  }
  const Json& noise = table.at("noise");
  const long freedom = noise.at("freedom").get<long>();
  out += fmt::format("chi-square {:.4g} with {} degree{} of freedom", number_or_nan(noise.at("chi_square")), freedom,
                     freedom == 1 ? "" : "s");
  if (!noise.at("probability").is_null())
    out += fmt::format(", probability {:.2g}", number_or_nan(noise.at("probability")));
  if (!noise.at("bic").is_null()) out += fmt::format(", BIC {:.4g}", number_or_nan(noise.at("bic")));
  out += "\n";
  for (const Json& sentence : table.at("findings")) out += sentence.get<std::string>() + "\n";
  return out;
}

}  // namespace orthodyn::study::fit
