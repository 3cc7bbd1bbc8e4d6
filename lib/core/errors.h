// The three ways in which orthodyn says no.
#pragma once

#include <stdexcept>
#include <string>

namespace orthodyn {

// The user's input is at fault. what() reads "file:line:column: key: found, allowed, remedy".
// The command line exits with 2 and has written nothing.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The computation could not go on: what() says how far it came, why, and what to try.
// What was computed so far is kept; the command line exits with 3.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The model cannot be evaluated at this state, but may be at one closer to the last good one.
// Integrators answer with a smaller step; it never reaches the user as such.
class RecoverableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace orthodyn
