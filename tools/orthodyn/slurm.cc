#include "tools/orthodyn/slurm.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "lib/core/errors.h"
#include "lib/simulation/output/files.h"
#include "tools/orthodyn/plugins.h"

namespace orthodyn {

std::string shell_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

const std::string& one_line(const std::string& text) {
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 127; };
  if (const auto at = std::find_if(text.begin(), text.end(), is_control); at != text.end())
    throw ConfigError("'" + std::string(text.begin(), at) +
                      "...': a line break or another control character follows, which would end a line of the script "
                      "for SLURM; rename the file, or give the results another name with --out");
  return text;
}

std::string sbatch_quoted(const std::string& text) {
  one_line(text);
  std::string out = "\"";
  for (const char c : text) out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
  return out + "\"";
}

std::string log_beside(const std::filesystem::path& folder) {
  std::string out;
  for (const char c : folder.string() + ".log") out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

std::string exported_plugins() {
  const char* plugins = std::getenv(kPluginsVariable);
  return plugins ? std::string("export ") + kPluginsVariable + "=" + shell_quoted(plugins) + "\n" : "";
}

std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return "";
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  return pclose(pipe) == 0 ? output.substr(0, output.find_first_of(";\n")) : "";
}

std::string submit_script(const std::filesystem::path& folder, const std::string& script) {
  const std::string file = folder.string() + ".sbatch";
  write_file(file, {script});
  const std::string job = output_of("sbatch --parsable " + shell_quoted(file));
  if (job.empty()) throw RunError("sbatch did not accept the job; its script is " + file);
  return job;
}

}  // namespace orthodyn
