// Registers commands and parses the command line with CLI11. Only this file includes CLI11, which takes seconds to
// compile.
#include "tools/orthodyn/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <sstream>

#include "lib/core/spelling.h"
#include "lib/core/versions.h"
#include "tools/orthodyn/command.h"

namespace orthodyn {

namespace {

// Constructed at first use, because the order of static initialisation between files is not defined.
std::vector<Command>& registered() {
  static std::vector<Command> all;
  return all;
}

constexpr const char* kExamples = R"(
Examples:
  orthodyn run configs/scenes/cantilever.yaml
  orthodyn run configs/scenes/free_flight.yaml --set elasticity.corotation=warped --out out/warped
  orthodyn run configs/scenes/laminate.yaml --set checkpoint={} --resume
  orthodyn check configs/scenes/laminate.yaml
  orthodyn modes configs/scenes/tuning_fork.yaml -n 8
  orthodyn init scene my.yaml
  orthodyn list materials
  orthodyn compare configs/comparisons/damped_beam.yaml
  orthodyn sweep configs/sweeps/grain_angle.yaml
  orthodyn stability configs/stability/hard_cases.yaml
  orthodyn verify configs/cases

Exit codes: 0 done, 1 an expectation was missed, 2 input error (nothing was written), 3 the run failed (results so far
are kept) or all points of a study failed, 130 interrupted (results so far are kept).)";

std::function<int()> add_command(CLI::App& program, const Command& command) {
  auto* app = program.add_subcommand(command.text.name, command.text.sentence)->fallthrough();  // for --plugin
  if (command.text.hidden) app->group("");
  if (!command.text.examples.empty()) app->footer("\nExamples:" + command.text.examples);
  CommandOptions options(*app);
  return command.declare(options);
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Command& command : commands())
    if (!command.text.hidden) names.push_back(command.text.name);
  return names;
}

// The first word, if it is not a command.
std::optional<std::string> unknown_command(const CLI::App& program) {
  if (!program.get_subcommands().empty()) return {};
  for (const std::string& word : program.remaining())
    if (!word.starts_with("-")) return word;
  return {};
}

// A suggestion for an unknown option, such as "-n" for "--n".
std::string nearest_option(const std::string& word, const CLI::App& command) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_snames())
      if (word == "--" + name) return fmt::format("; did you mean '-{}'?", name);
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  return did_you_mean(word, known, ".");
}

// The message for the first unknown option, if any.
std::optional<std::string> unknown_option(const CLI::App& program) {
  if (program.get_subcommands().empty()) return {};
  const CLI::App& command = *program.get_subcommands().front();
  for (const std::string& word : program.remaining(true))
    if (word.starts_with("-") && word.size() > 1)
      return fmt::format("error: {} has no option '{}'{} See orthodyn {} --help.\n", command.get_name(), word,
                         nearest_option(word.substr(0, word.find('=')), command), command.get_name());
  return {};
}

Answer answer_of(const CLI::App& program, const CLI::ParseError& e) {
  std::ostringstream out, err;
  const int code = program.exit(e, out, err) == 0 ? 0 : 2;
  return {code, out.str(), err.str()};
}

}  // namespace

std::vector<Command> commands() {
  auto all = registered();
  std::sort(all.begin(), all.end(), [](const Command& a, const Command& b) { return a.text.order < b.text.order; });
  return all;
}

void CommandRegistration::add(Command command) { registered().push_back(std::move(command)); }

CommandOption& CommandOption::required() { return option_.required(), *this; }

CommandOption& CommandOption::type(const std::string& name) { return option_.type_name(name), *this; }

CommandOption& CommandOption::excludes(const std::string& other) {
  return option_.excludes(command_.get_option(other)), *this;
}

CommandOption& CommandOption::needs(const std::string& other) {
  return option_.needs(command_.get_option(other)), *this;
}

CommandOption& CommandOption::range(int least, int most) { return option_.check(CLI::Range(least, most)), *this; }

CommandOption& CommandOption::choice(const std::vector<std::string>& words) {
  option_.check(CLI::IsMember(words))->expected(0, 1)->default_str(words.front());
  return *this;
}

CommandOption& CommandOption::one_each() { return option_.allow_extra_args(false), *this; }

CommandOption& CommandOption::show_default() { return option_.capture_default_str(), *this; }

template <class Value>
CommandOption CommandOptions::value(const std::string& name, Value& value, const std::string& sentence) {
  return {command_, *command_.add_option(name, value, sentence)};
}

template CommandOption CommandOptions::value(const std::string&, std::string&, const std::string&);
template CommandOption CommandOptions::value(const std::string&, int&, const std::string&);
template CommandOption CommandOptions::value(const std::string&, double&, const std::string&);
template CommandOption CommandOptions::value(const std::string&, std::optional<std::string>&, const std::string&);
template CommandOption CommandOptions::value(const std::string&, std::optional<int>&, const std::string&);
template CommandOption CommandOptions::value(const std::string&, std::optional<std::size_t>&, const std::string&);

CommandOption CommandOptions::repeated(const std::string& name, std::vector<std::string>& values,
                                       const std::string& sentence) {
  return {command_, *command_.add_option(name, values, sentence)->expected(1)->take_all()};
}

CommandOption CommandOptions::list(const std::string& name, std::vector<std::string>& values,
                                   const std::string& sentence) {
  return {command_, *command_.add_option(name, values, sentence)};
}

CommandOption CommandOptions::flag(const std::string& name, bool& value, const std::string& sentence) {
  return {command_, *command_.add_flag(name, value, sentence)};
}

CommandLine parse_command_line(int argc, char** argv) {
  CommandLine out;
  CLI::App program("Dynamics of large-deformation orthotropic solids, driven by SUNDIALS.");
  program.footer(kExamples);
  program.require_subcommand(1);
  program.set_version_flag("--version", orthodyn_version());
  CommandOptions(program)
      .repeated("--plugin", out.plugins,
                "Load a shared library with your own materials, terms, integrators or meshes (docs/extend.md).")
      .type("FILE.so")
      .one_each();
  std::map<std::string, std::function<int()>> runs;
  for (const Command& command : commands()) runs[command.text.name] = add_command(program, command);
  try {
    program.parse(argc, argv);
    out.name = program.get_subcommands().front()->get_name();
    out.run = runs.at(out.name);
    for (const Command& command : commands())
      if (command.text.name == out.name) out.on_ranks = command.text.on_ranks;
  } catch (const CLI::ParseError& e) {
    if (const auto word = unknown_command(program))
      out.answer = {2, "",
                    fmt::format("error: unknown command '{}'{} Known: {}.\n", *word,
                                did_you_mean(*word, command_names(), "."), join(command_names()))};
    else if (const auto sentence = unknown_option(program)) out.answer = {2, "", *sentence};
    else out.answer = answer_of(program, e);
  }
  return out;
}

}  // namespace orthodyn
