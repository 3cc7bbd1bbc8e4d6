// The three kinds of failure: of the input, of a computation, of one state.
#pragma once

#include <stdexcept>
#include <string>

namespace orthodyn {

// What is wrong with the input: its form (an unknown key, a text where a number is expected), which no other value of a
// varied key mends, or a value.
enum class InputFault { value, form };

// The user's input is at fault. what() is "place: message", or the message alone where there is no place, as for
// options of the command line. The command line exits with 2 and has written nothing.
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

// Why a computation could not go on, in one word for a table.
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
  switch (reason) {
    case Reason::other: break;
    case Reason::diverged: return "diverged";
    case Reason::step_too_small: return "step too small";
    case Reason::too_many_steps: return "too many steps";
    case Reason::newton: return "newton";
    case Reason::critical_point: return "critical point";
    case Reason::error_test: return "error test";
    case Reason::force: return "force";
    case Reason::out_of_memory: return "out of memory";
    case Reason::disk: return "disk";
  }
  return "other";
}

// The computation could not go on: what() says how far it came, why, and what to try.
// What was computed so far is kept; the command line exits with 3.
class RunError : public std::runtime_error {
 public:
  explicit RunError(const std::string& message, Reason reason = Reason::other)
      : std::runtime_error(message), reason_(reason) {}
  Reason reason() const { return reason_; }

 private:
  Reason reason_;
};

// The model cannot be evaluated at this state, but may be at one closer to the last good one.
// Integrators answer with a smaller step; it never reaches the user as such.
class RecoverableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace orthodyn
