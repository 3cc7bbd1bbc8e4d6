#include "tools/bench/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "lib/core/errors.h"
#include "lib/linear/blas.h"
#include "lib/simulation/run/machine.h"

namespace orthodyn::bench {

namespace {

constexpr double kSlower = 1.1;  // ratio to the baseline above which a result is marked

Json context() {
  Json out{{"machine", machine_json()}, {"versions", versions_json()}, {"time", utc_now()}};
  out["compiler"] = fmt::format("{} {}", ORTHODYN_COMPILER, ORTHODYN_FLAGS);
  out["blas"] = blas_name();
  out["clock"] = "real";
  return out;
}

}  // namespace

void Collector::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration) continue;
    const std::string name = run.run_name.function_name;  // without the suffix of Google Benchmark
    const double nanoseconds = 1e9 / run.counters.at("items_per_second").value;
    const auto found = std::find_if(results_.begin(), results_.end(), [&](const Result& r) { return r.name == name; });
    if (found != results_.end()) {
      found->nanoseconds = std::min(found->nanoseconds, nanoseconds);
      continue;
    }
    const auto counted = [&](const char* what) {
      const auto counter = run.counters.find(what);
      return counter == run.counters.end() ? 0 : counter->second.value;
    };
    results_.push_back({name, nanoseconds, counted("elements"), counted("unknowns"), counted("bytes")});
    fmt::print(stderr, "{}\n", name);
  }
}

Json to_json(const std::vector<Result>& results) {
  Json out = context();
  out["results"] = Json::array();
  for (const Result& r : results)
    out["results"].push_back({{"name", r.name},
                              {"nanoseconds_per_element", r.nanoseconds},
                              {"elements", r.elements},
                              {"unknowns", r.unknowns},
                              {"bytes", r.bytes}});
  return out;
}

Baseline read_baseline(const std::filesystem::path& file) {
  std::ifstream in(file);
  Baseline before{Json::parse(in, nullptr, false), {}};
  try {
    for (const auto& r : before.context.at("results"))
      before.nanoseconds[r.at("name")] = r.at("nanoseconds_per_element");
  } catch (const Json::exception&) {
    throw ConfigError(fmt::format("{}: not a file of orthodyn_bench --json", file.string()));
  }
  if (before.context.value("clock", "") != "real")
    throw ConfigError(
        fmt::format("{}: contains processor times of an earlier version; measure again for real times", file.string()));
  return before;
}

int print(const std::vector<Result>& results, const std::optional<Baseline>& baseline) {
  const Json at = context();
  fmt::print("{}\n{}\n{}\n{}\n\n", at["machine"].dump(), at["versions"].dump(), at["compiler"].get<std::string>(),
             at["blas"].get<std::string>());
  fmt::print("{:40} {:>12}{}\n", "one thread, or several", "ns/element", baseline ? "     before   ratio" : "");
  int slower = 0;
  auto left = baseline ? baseline->nanoseconds : std::map<std::string, double>();
  for (const Result& r : results) {
    std::string compared;
    if (const auto old = left.find(r.name); old != left.end()) {
      const double ratio = r.nanoseconds / old->second;
      compared = fmt::format("{:>11.4g} {:>7.2f}{}", old->second, ratio, ratio > kSlower ? "  slower" : "");
      if (ratio > kSlower) ++slower;
      left.erase(old);
    } else if (baseline) {
      compared = "          -       -  not measured before";
    }
    fmt::print("{:40} {:>12.4g}{}\n", r.name, r.nanoseconds, compared);
  }
  for (const auto& [name, nanoseconds] : left)
    fmt::print("{:40} {:>12}{:>11.4g}       -  not measured now\n", name, "-", nanoseconds);
  if (!baseline) return slower;
  for (const char* what : {"machine", "compiler", "blas"}) {
    const Json then = baseline->context.value(what, Json());
    if (then != at[what])
      fmt::print("the earlier measurement used another {}, which affects the ratios: {}\n", what, then.dump());
  }
  return slower;
}

}  // namespace orthodyn::bench
