// Declares a command's options. Each option has a variable, in which parsing stores the option's value; the variable
// must live until the command line is parsed. A declaration that names an unknown option (in `excludes` or `needs`)
// throws when the program starts.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace orthodyn {

// Further properties of a declared option.
class CommandOption {
 public:
  CommandOption(CLI::App& command, CLI::Option& option) : command_(command), option_(option) {}

  CommandOption& required();
  // Placeholder of the value in `--help`: "FILE.yaml". Default "TEXT", "INT" or "FLOAT".
  CommandOption& type(const std::string& name);
  // excludes() forbids this option together with `other`, needs() forbids it without `other`. `other`: name of an
  // option declared before.
  CommandOption& excludes(const std::string& other);
  CommandOption& needs(const std::string& other);
  CommandOption& range(int least, int most);
  // Allowed values; the first is used if the option is given without a value.
  CommandOption& choice(const std::vector<std::string>& words);
  // `--help` shows the variable's present value as the default.
  CommandOption& show_default();
  // For repeated(): takes one value each time the option is given.
  CommandOption& one_each();

 private:
  CLI::App& command_;
  CLI::Option& option_;
};

class CommandOptions {
 public:
  explicit CommandOptions(CLI::App& command) : command_(command) {}

  // A name without dashes declares a positional argument. Value: std::string, int, double, or std::optional of
  // std::string, int or std::size_t.
  template <class Value>
  CommandOption value(const std::string& name, Value& value, const std::string& sentence = "");
  // May be given several times: --set A --set B.
  CommandOption repeated(const std::string& name, std::vector<std::string>& values, const std::string& sentence);
  // Any number of positional arguments.
  CommandOption list(const std::string& name, std::vector<std::string>& values, const std::string& sentence);
  CommandOption flag(const std::string& name, bool& value, const std::string& sentence);

 private:
  CLI::App& command_;
};

}  // namespace orthodyn
