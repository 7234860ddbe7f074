// Threads that wait for each other are told to spin only for a moment before they sleep: with the OpenMP runtime's
// default of milliseconds, a run on cores that other programs use too takes several times longer. The runtime reads
// this when it is loaded, before main, so the program starts itself once more with it.
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "app/command_line.hpp"

namespace {

void restart_with_short_waits(int argc, char** argv) {
  const bool runs = argc > 1 && std::string_view(argv[1]) == "run";
  if (!runs || std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
  if (::setenv("GOMP_SPINCOUNT", "3000", 1) == 0) ::execv("/proc/self/exe", argv);
}  // where that fails the run is only slower

}  // namespace

int main(int argc, char** argv) {
  restart_with_short_waits(argc, argv);
  return knap::run_command_line(argc, argv);
}
