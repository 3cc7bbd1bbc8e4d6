// What a run was and did: run.json and the summary on the terminal.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "lib/simulation/checkpoint.h"
#include "lib/simulation/curves.h"
#include "lib/simulation/run.h"
#include "lib/simulation/errors/error_estimate.h"
#include "lib/simulation/json.h"
#include "tools/orthodyn/run_arguments.h"
#include "tools/orthodyn/setup.h"

namespace orthodyn {

struct RunReport {
  const RunArguments& arguments;
  const Setup& setup;
  const Outcome& outcome;
  const Effort& effort;  // over all restarts
  const InversionWatch& inversion;
  const EnergyWriter* energy;      // null if not written
  const MomentumWriter* momentum;  // likewise
  std::optional<ErrorEstimate> error = std::nullopt;  // if it was asked for
};

// What the model consists of, in words.
Json terms_json(const FemModel& model);

int exit_code(Outcome::Status status);

// `report` null: the run has begun.
std::string run_json(const RunArguments& arguments, const std::vector<Restart>& restarts, const RunReport* report);

// What the estimate says about the run, as a table and in a sentence.
void print_error(const ErrorEstimate& error);

void print_summary(const RunReport& report, const std::filesystem::path& folder);

}  // namespace orthodyn
