#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace knap {

/// Exit codes of the program, part of its interface.
enum class ExitCode : int { Ok = 0, Failure = 1, BadInput = 2, EnergyNotClosed = 3, Interrupted = 130 };

/// A mistake in what the user gave (case file, mesh file, command line); the program ends with ExitCode::BadInput.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Something outside failed (a full disk, a missing display); the program ends with ExitCode::Failure.
class RuntimeFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws InputError with a line for each of the problems, the first twenty of them; nothing if there are none.
void throw_if_any(const std::vector<std::string>& problems);

/// The candidate nearest to `word` in edit distance, or "" when none is close enough to suggest.
std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace knap
