// How a command declares its options. Each is bound to a variable, which parsing sets and which must live until then.
// A declaration that does not fit together (an unknown name in `excludes`) throws when the program starts.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace orthodyn {

// What else holds of an option that was declared.
class CommandOption {
 public:
  CommandOption(CLI::App& command, CLI::Option& option) : command_(command), option_(option) {}

  CommandOption& required();
  // What `--help` shows for the value: "FILE.yaml". Without it, "TEXT", "INT" or "FLOAT".
  CommandOption& type(const std::string& name);
  // Not together with, or only together with, an option that was declared before.
  CommandOption& excludes(const std::string& other);
  CommandOption& needs(const std::string& other);
  CommandOption& range(int least, int most);
  // One of these words; the first if the option is given without a value.
  CommandOption& choice(const std::vector<std::string>& words);
  // `--help` shows the value that the variable has now.
  CommandOption& show_default();
  // Of repeated(): what follows the first value is no value of it.
  CommandOption& one_each();

 private:
  CLI::App& command_;
  CLI::Option& option_;
};

class CommandOptions {
 public:
  explicit CommandOptions(CLI::App& command) : command_(command) {}

  // A name without dashes is that of a positional argument. Value: std::string, int, double, or
  // std::optional of std::string or std::size_t.
  template <class Value>
  CommandOption value(const std::string& name, Value& value, const std::string& sentence = "");
  // Several, each after its own `name`.
  CommandOption repeated(const std::string& name, std::vector<std::string>& values, const std::string& sentence);
  // Several in a row, without a name.
  CommandOption list(const std::string& name, std::vector<std::string>& values, const std::string& sentence);
  CommandOption flag(const std::string& name, bool& value, const std::string& sentence);

 private:
  CLI::App& command_;
};

}  // namespace orthodyn
