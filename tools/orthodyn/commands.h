// The subcommands of `orthodyn`. Each returns the exit code: 0, 1 an expectation was missed, 2 bad
// input, 3 could not go on, or computed no point of a comparison or sweep, 130 interrupted.
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
  bool axes = false;  // of check: write the material axes
};

struct ModesArguments {
  std::string scene;
  std::vector<std::string> set;
  std::optional<std::string> out;
  int count = 20;
  bool equilibrium = false, quiet = false, force = false;
};

struct VerifyArguments {
  std::vector<std::string> places;  // files and folders
  std::vector<std::string> set;
  std::optional<std::string> integrator, junit;
};

// What all studies know.
struct StudyArguments {
  std::string file;
  std::optional<std::string> out;
  int jobs = 0;  // 0: as many as there are processors
  bool retry = false, quiet = false, no_report = false;
};

struct CompareArguments : StudyArguments {};

struct SweepArguments : StudyArguments {
  std::optional<std::string> task;    // "3/20": this part of the points only
  std::optional<std::string> slurm;   // "print" or "submit"
  std::optional<std::size_t> tasks;   // of the array
  bool collect = false;
};

struct StabilityArguments : StudyArguments {};

struct ConvertArguments {
  std::string in, out;
  double scale = 1;
  bool force = false;
};

int run_command(const RunArguments& arguments);
int check_command(const RunArguments& arguments);
int modes_command(const ModesArguments& arguments);
int list_command(const std::string& what, bool markdown);
void print_reference_page();
int compare_command(const CompareArguments& arguments);
int measure_command(const std::string& folder);  // one point of a comparison, in its own process
int sweep_command(const SweepArguments& arguments);
int evaluate_command(const std::string& folder);  // one point of a sweep, in its own process
int stability_command(const StabilityArguments& arguments);
int assess_command(const std::string& folder);  // one trial of a matrix, in its own process
int convert_command(const ConvertArguments& arguments);
int verify_command(const VerifyArguments& arguments);
int schema_command(const std::string& kind);  // of all kinds, if empty
int init_command(const std::string& kind, const std::optional<std::string>& file);

}  // namespace orthodyn
