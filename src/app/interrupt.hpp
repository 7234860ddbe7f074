#pragma once
#include <atomic>

namespace knap {

/// Makes SIGINT and SIGTERM ask for an orderly end; a second one ends the program at once with ExitCode::Interrupted.
void catch_interrupts();
/// True once an orderly end was asked for.
const std::atomic<bool>& interrupt_requested();

}  // namespace knap
