// The one global of the program: a signal handler can reach nothing else.
#include "app/interrupt.hpp"

#include <unistd.h>

#include <csignal>

#include "core/errors.hpp"

namespace knap {
namespace {

std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int) {
  if (requested.exchange(true)) ::_exit(static_cast<int>(ExitCode::Interrupted));
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& interrupt_requested() { return requested; }

}  // namespace knap
