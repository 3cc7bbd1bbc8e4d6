// What scripts for SLURM have in common.
#pragma once

#include <filesystem>
#include <string>

namespace orthodyn {

// The text itself, for a comment of a script. Throws ConfigError for control characters: what follows a line break
// would be a command.
const std::string& one_line(const std::string& text);

// For a shell; for a line #SBATCH, which throws as one_line() does.
std::string shell_quoted(const std::string& text);
std::string sbatch_quoted(const std::string& text);

// The log beside the folder; SLURM takes a single '%' in it for a pattern.
std::string log_beside(const std::filesystem::path& folder);

// A line that has the job load the plugins that are loaded here; empty without any.
std::string exported_plugins();

// What a command says; nothing if it fails.
std::string output_of(const std::string& command);

// Writes the script beside the folder and hands it to sbatch; the job's number. Throws RunError if it is not accepted.
std::string submit_script(const std::filesystem::path& folder, const std::string& script);

}  // namespace orthodyn
