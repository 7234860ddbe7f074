#pragma once
// A campaign: a base case and what is varied around it.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "config/case_document.hpp"
#include "config/schema.hpp"

namespace knap {

/// Keys that are varied together, and the values they take one after the other. Every value of an axis is combined with
/// every value of the others.
struct CampaignAxis {
  std::vector<std::string> keys;                 ///< "impact.speed"
  std::vector<std::vector<std::string>> values;  ///< [value][key], as --set takes it
  std::string place{};                           ///< of the values, "study.campaign.toml:12:1"
};

/// A key whose values are drawn by Latin hypercube, in the unit both ends were given in.
struct SampledKey {
  std::string key;
  double low = 0.0, high = 0.0;
  std::string unit;  ///< behind the number; "" = SI
  bool is_logarithmic = false;
  bool is_integer = false;
  std::string place{};  ///< of its table
};

struct CampaignConfig {
  std::filesystem::path base;     ///< case file
  std::vector<Setting> settings;  ///< of all runs
  std::vector<CampaignAxis> axes;
  std::vector<SampledKey> sampled;
  int samples = 0;  ///< of the Latin hypercube, each combined with all values of the axes; 0 = none
  std::int64_t sample_seed = 0;
};

/// One run of a campaign.
struct CampaignRun {
  std::string name;                 ///< of its folder: "speed_8mps-angle_45deg-seed_0"
  std::vector<std::string> values;  ///< by campaign_keys, as --set takes it
};

/// Reads a campaign file. Throws InputError with one line for each mistake, as load_config does; what the values mean
/// is only known with the base case.
CampaignConfig load_campaign(const std::filesystem::path& file);
/// The same from text; `file` is named in messages, and its folder is where the base's path starts.
CampaignConfig campaign_from_text(std::string_view text, const std::filesystem::path& file);

/// The keys that vary, in order: those of the axes, then the sampled ones.
std::vector<std::string> campaign_keys(const CampaignConfig& campaign);
/// All runs, the last axis fastest. Names do not depend on which other values an axis has, so that a campaign can grow.
std::vector<CampaignRun> campaign_runs(const CampaignConfig& campaign);
/// What a run sets of its case: the campaign's settings, then its own.
std::vector<Setting> settings_of(const CampaignConfig& campaign, const CampaignRun& run);

/// "impact.speed [m/s]": a key as a column of a table.
std::string column_of(const std::string& key);
/// A key's value in SI, a word or a number. Throws InputError if it does not fit the key.
Value value_of(const std::string& key, const std::string& text);

}  // namespace knap
