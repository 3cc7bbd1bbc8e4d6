// The subcommands of `orthodyn`. Each returns the exit code: 0, 1 an expectation was missed, 2 bad
// input, 3 could not go on, 130 interrupted.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace orthodyn {

struct RunArguments {
  std::string scene;
  std::optional<std::string> out;
  std::vector<std::string> set;
  std::optional<std::string> integrator;
  bool quiet = false, force = false, resume = false, estimate_error = false;
};

struct VerifyArguments {
  std::vector<std::string> places;  // files and folders
  std::vector<std::string> set;
  std::optional<std::string> integrator, junit;
};

struct CompareArguments {
  std::string comparison;
  std::optional<std::string> out;
  bool quiet = false, no_report = false;
};

int run_command(const RunArguments& arguments);
int check_command(const RunArguments& arguments);
int list_command(const std::string& what);
int compare_command(const CompareArguments& arguments);
int measure_command(const std::string& folder);  // one point of a comparison, in its own process
int verify_command(const VerifyArguments& arguments);

}  // namespace orthodyn
