// sample_page FOLDER: writes the page of the sample campaign, FOLDER/report.html, for the test in a browser.
#include <cstdio>
#include <exception>

#include "tests/report/sample_campaign.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    knap::write_campaign_page(folder / "report.html", knap::sample_campaign(folder));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
