#pragma once

namespace knap {

/// The program: parses the command line, runs the command, turns errors into messages and exit codes.
int run_command_line(int argc, char** argv);

}  // namespace knap
