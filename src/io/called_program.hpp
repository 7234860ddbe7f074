#pragma once
#include <chrono>
#include <string>
#include <vector>

namespace knap {

/// How another program ended and what it said.
struct ProgramEnd {
  int exit_code = 0;  ///< 127: there is no such program; 128 + n where signal n ended it
  std::string out, err;
};

/// Calls a program, looked for in PATH, with its arguments, and waits for its end; past the timeout it is killed.
/// Throws RuntimeFailure if no process can be made.
ProgramEnd call_program(std::vector<std::string> words, std::chrono::seconds timeout);

}  // namespace knap
