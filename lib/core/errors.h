// The three kinds of failure: of the input, of a computation, of one state.
#pragma once

#include <iterator>
#include <stdexcept>
#include <string>

namespace orthodyn {

// The kind of an input error. form: the text is malformed, such as an unknown key or a word in place of a number.
// value: a well-formed value that is not allowed; a study may skip it.
enum class InputFault { value, form };

// An error in the user's input. what() is "place: message", or only the message if there is no place, as for options of
// the command line. The program then exits with status 2 and has written nothing.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::string& message) : ConfigError("", message) {}
  ConfigError(const std::string& place, const std::string& message, InputFault fault = InputFault::value)
      : std::runtime_error(place.empty() ? message : place + ": " + message),
        place_(place),
        message_(message),
        fault_(fault) {}

  const std::string& place() const { return place_; }      // "file:line:column: path of the key", or ""
  const std::string& message() const { return message_; }  // what was found, what is allowed, what to do
  InputFault fault() const { return fault_; }

 private:
  std::string place_, message_;
  InputFault fault_;
};

// Why a computation stopped, for tables.
enum class Reason {
  other,
  diverged,
  step_too_small,
  too_many_steps,
  newton,
  critical_point,
  error_test,
  force,
  out_of_memory,
  disk
};

inline const char* reason_name(Reason reason) {
  constexpr const char* kNames[] = {"other",          "diverged",   "step too small", "too many steps", "newton",
                                    "critical point", "error test", "force",          "out of memory",  "disk"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(Reason::disk) + 1);
  return kNames[static_cast<int>(reason)];
}

// A computation that cannot continue: what() gives the point reached, the cause and a remedy. Results up to that point
// are kept; the program exits with status 3.
class RunError : public std::runtime_error {
 public:
  explicit RunError(const std::string& message, Reason reason = Reason::other)
      : std::runtime_error(message), reason_(reason) {}
  Reason reason() const { return reason_; }

 private:
  Reason reason_;
};

// The model cannot be evaluated at this state, but perhaps at one closer to the last good state. Integrators then
// reduce the step.
class RecoverableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace orthodyn
