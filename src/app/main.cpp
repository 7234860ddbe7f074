// Two settings that are read when the program is loaded, before main, so it starts itself once more with them. Threads
// that wait for each other spin only for a moment before they sleep: with the OpenMP runtime's default of milliseconds,
// a run on cores that other programs use too takes several times longer. And memory comes in huge pages where the
// system leaves the choice to the program: sweeps over large meshes are up to a tenth faster.
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "app/command_line.hpp"

namespace {

bool set_unless_given(const char* name, const char* value) {
  return std::getenv(name) == nullptr && ::setenv(name, value, 0) == 0;
}

void restart_with_settings(int argc, char** argv) {
  if (argc < 2 || std::string_view(argv[1]) != "run") return;
  bool changed = set_unless_given("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1");
  if (!std::getenv("OMP_WAIT_POLICY")) changed |= set_unless_given("GOMP_SPINCOUNT", "3000");
  if (changed) ::execv("/proc/self/exe", argv);
}  // where that fails the run is only slower

}  // namespace

int main(int argc, char** argv) {
  restart_with_settings(argc, argv);
  return knap::run_command_line(argc, argv);
}
