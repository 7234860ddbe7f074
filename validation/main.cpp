// The validation of Knap: every claim against a reference. Usage: ./dev validate --help
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <thread>

#include "core/errors.hpp"
#include "validation/validate.hpp"

namespace knap {
namespace {

int list_problems() {
  for (const Problem& problem : problems())
    fmt::print("{:24} {:12} {:7} {}\n", problem.name, problem.group, problem.in_short ? "short" : "",
               problem.reference);
  return 0;
}

int run_validation(int argc, char** argv) {
  ValidateOptions options{.sources = KNAP_SOURCE_DIR "/validation"};
  options.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  bool list = false;
  CLI::App app("Compares Knap with what is known without it, problem by problem", "validate");
  app.add_flag("--short", options.is_short, "Only what takes little time; results go to out/validation");
  app.add_flag("--keep", options.keeps_runs, "Studies of many runs go on from those of an earlier session");
  app.add_option("--only", options.only, "Names of problems")->delimiter(',');
  app.add_option("--out", options.out, "Folder of the results; default: validation")->type_name("DIR");
  app.add_option("--jobs", options.jobs, "Problems at a time, one thread each")->check(CLI::Range(1, 1024));
  app.add_flag("--list", list, "Name the problems and what they are compared with");
  CLI11_PARSE(app, argc, argv);
  if (list) return list_problems();
  if (options.out.empty()) options.out = options.is_short ? "out/validation" : "validation";
  return validate(problems(), options);
}

}  // namespace
}  // namespace knap

int main(int argc, char** argv) {
  try {
    return knap::run_validation(argc, argv);
  } catch (const knap::InputError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return static_cast<int>(knap::ExitCode::BadInput);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return static_cast<int>(knap::ExitCode::Failure);
  }
}
