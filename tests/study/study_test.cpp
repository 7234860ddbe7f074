// Studies of campaigns that were made up: runs that follow known laws, of which the study must find the constants.
#include "study/write_study.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/breakage_functions.hpp"
#include "analysis/equivalent_velocity.hpp"
#include "core/errors.hpp"
#include "io/csv_line.hpp"
#include "study/mean_curve.hpp"
#include "study/study_runs.hpp"
#include "study/summary_table.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180.0, diameter = 1.5e-3;

class StudyTest : public TemporaryFolder {
 protected:
  struct Row {
    double speed = 0.0, angle = 90.0, friction = 0.3, chipping = 0.0;
    int seed = 1;
    std::string mesh = "0.0001";
    std::string hash = "0123456789abcdef";
    std::vector<double> later{};  // chipping ratios of further impacts
  };

  // A run's folder and line; half of what is lost is a big chip of 0.3 d, the rest chips of 0.05 d.
  void add(const Row& row) {
    const std::string name = fmt::format("run_{}", ++number_);
    const fs::path run = campaign() / "runs" / name;
    fs::create_directories(run);
    std::ofstream(run / "effective.toml") << fmt::format(
        "[particle]\ndiameter = {}\n[material]\npreset = \"zeolite_4ak\"\n[impact]\nspeed = {}\nangle = "
        "{}\nwall_friction = {}\n",
        diameter, row.speed, row.angle * degree, row.friction);
    std::ofstream sizes(run / "size_distribution.csv");
    sizes << "sieve_size [m],finer_mass_fraction [-],finer_count [-]\n";
    sizes << fmt::format("{},{},9\n{},{},10\n{},1,11\n", 0.05 * diameter, 0.5 * row.chipping, 0.3 * diameter,
                         row.chipping, diameter * (row.chipping < 0.5 ? 1.0 : 0.7));
    std::ofstream(run / "fragments.csv")
        << "id,mass [kg],sphericity [-],elongation [-],flatness [-],convexity [-],resolved\n"
           "0,1e-6,0.9,0.9,0.9,0.9,1\n1,3e-8,0.6,0.7,0.5,0.8,1\n2,1e-8,0.8,0.5,0.9,0.4,1\n3,1e-9,0.1,0.1,0.1,0.1,0\n";
    if (!row.later.empty()) {  // the pieces of the first impact lie in a folder of their own
      fs::create_directories(run / "impact_1");
      for (const char* file : {"size_distribution.csv", "fragments.csv"}) {
        sizes.close();
        fs::rename(run / file, run / "impact_1" / file);
      }
      std::ofstream impacts(run / "impacts.csv");
      impacts << "impact,mass_before [kg],chipping_ratio [-],incident_energy [J]\n";
      const double energy = 0.5 * row.speed * row.speed;
      impacts << fmt::format("1,1,{},{}\n", row.chipping, energy);
      for (const double chipping : row.later) impacts << fmt::format("2,1,{},{}\n", chipping, energy);
    }
    const char* breakage_class = row.chipping < 1e-3 ? "intact" : row.chipping < 0.25 ? "chipped" : "split";
    lines_ += fmt::format("{},done,,{},{},{},{},{},end time,{},{},1.5e-3,1e-4,{},{},{},,{}\n", name, row.mesh,
                          row.speed, row.angle * degree, row.friction, row.seed, row.hash, row.chipping, breakage_class,
                          0.5 * row.chipping, 0.5 * row.chipping, 1e-4);
  }
  void write() {
    std::ofstream(campaign() / "results.csv")
        << "run,state,reason,mesh.element_size [m],impact.speed [m/s],impact.angle [rad],impact.wall_friction "
           "[-],run.seed,"
           "stop_reason,state_hash,breakage.chipping_ratio,sanity.diameter,mesh.edge_mean,breakage.class,breakage.t10,"
           "breakage.t4,"
           "breakage.t25,energy.closure_error\n"
        << lines_;
  }
  // All angles and speeds, on a curve over the equivalent velocity.
  void add_oblique(double a_mu, double friction = 0.3, double step = 2.0) {
    for (const double angle : {30.0, 45.0, 60.0, 75.0, 90.0})
      for (double speed = 8.0; speed <= 30.0; speed += step)
        for (int seed = 1; seed <= 2; ++seed)
          for (const char* mesh : {"0.0001", "0.00008"}) {
            const double v = equivalent_velocity(speed, angle * degree, a_mu);
            const double noise = 0.01 * std::sin(12.9898 * number_);
            add({speed, angle, friction, std::max(0.0, BreakageCurve{0.7, 22.0, 6.0}(v) + (v > 12.0 ? noise : 0.0)),
                 seed, mesh});
          }
  }
  nlohmann::json studied(const StudyOptions& options = {.title = "made up", .collapse_samples = 30}) {
    write();
    const std::array folders{campaign()};
    outcome = write_study(folders, folder / "analysis", folder / "report.html", options);
    return nlohmann::json::parse(read_text(folder / "analysis" / "analysis.json"));
  }
  fs::path campaign() const { return folder / "campaign"; }

  StudyOutcome outcome;

 private:
  int number_ = 0;
  std::string lines_;
};

TEST_F(StudyTest, FindsTheEquivalentVelocityThatTheRunsFollow) {
  add_oblique(0.8);
  const auto json = studied();
  const auto& found = json["velocity"][0]["equivalent_velocity"]["chipping_ratio"];
  EXPECT_NEAR(found["model"]["a_mu"].get<double>(), 0.8, 0.05);
  EXPECT_NEAR(found["model"]["a_with_known_friction"].get<double>(), 0.8 / 0.3, 0.2);
  EXPECT_LT(found["model"]["left_out_rms"].get<double>(), 0.5 * found["null"]["left_out_rms"].get<double>());
  EXPECT_THAT(found["verdict"].get<std::string>(), HasSubstr("beats the normal component"));
  EXPECT_THAT(outcome.verdicts, testing::Contains(HasSubstr("beats the normal component")));
  EXPECT_EQ(outcome.runs, 240U);
  // With more tangential velocity more breaks, where v sin th alone would do nothing.
  int checked = 0;
  for (const auto& effect : json["velocity"][0]["tangential_effect"])
    if (effect["normal_speed"] == 14.0) {
      ++checked;
      EXPECT_GT(effect["slope_interval"][0].get<double>(), 0.0);
      EXPECT_THAT(effect["verdict"].get<std::string>(), HasSubstr("rises"));
    }
  // 5 % at 90 deg: 0.7 (1 - exp(-(v/22)^6)) = 0.05 at 22 (0.0741)^(1/6); between speeds 2 m/s apart.
  for (const auto& threshold : json["velocity"][0]["thresholds"])
    if (threshold["measure"] == "chipping_ratio" && threshold["level"] == 0.05) {
      ++checked;
      EXPECT_NEAR(threshold["speed"].get<double>(), 22.0 * std::pow(-std::log(1.0 - 0.05 / 0.7), 1.0 / 6.0), 0.3);
      EXPECT_LT(threshold["interval"][0].get<double>(), threshold["speed"].get<double>());
    }
  EXPECT_EQ(checked, 3);
  // Speed by speed as well: as much is lost straight on at v_eq.
  const auto& equal_loss = json["velocity"][0]["equal_loss"];
  EXPECT_GT(equal_loss["conditions"].size(), 20U);
  for (const auto& one : equal_loss["conditions"])
    if (one["loss"] > 0.1) {  // there the scatter of 0.01 moves a speed by 0.01/(6 0.1) at most, on each side
      EXPECT_NEAR(one["ratio"].get<double>(),
                  std::sqrt(1.0 + std::pow(0.8 * std::cos(one["angle_deg"].get<double>() * degree), 2)), 0.05)
          << one;
    }
  for (const auto& band : equal_loss["bands"]) {
    EXPECT_NEAR(band["a_mu"].get<double>(), 0.8, 0.1) << band;
    EXPECT_LE(band["interval"][0].get<double>(), band["a_mu"].get<double>()) << band;
    EXPECT_GE(band["interval"][1].get<double>(), band["a_mu"].get<double>()) << band;
  }
  EXPECT_EQ(equal_loss["bands"].size(), 3U);
}

TEST_F(StudyTest, SaysWhereTheNormalComponentIsEnough) {
  add_oblique(0.0);
  const auto json = studied()["velocity"][0];
  const auto& found = json["equivalent_velocity"]["chipping_ratio"];
  // At 45 deg v_eq is then less than 1 % above v sin th.
  EXPECT_LT(found["model"]["a_mu"].get<double>(), 0.2);
  EXPECT_LT(found["model"]["a_mu_interval"][0].get<double>(), 0.2);
  EXPECT_THAT(found["verdict"].get<std::string>(), testing::Not(HasSubstr("velocity beats")));
  for (const auto& one : json["equal_loss"]["conditions"])
    if (one["loss"] > 0.1) {
      EXPECT_NEAR(one["ratio"].get<double>(), 1.0, 0.05) << one;
    }
}

TEST_F(StudyTest, ClaimsNothingWithoutRepeats) {
  for (const double angle : {30.0, 60.0, 90.0})
    for (double speed = 8.0; speed <= 30.0; speed += 3.0)
      add({.speed = speed,
           .angle = angle,
           .chipping = BreakageCurve{0.7, 20.0, 6.0}(speed * std::sin(angle * degree))});
  const auto json = studied()["velocity"][0];
  const auto& found = json["equivalent_velocity"]["chipping_ratio"];
  EXPECT_THAT(found["verdict"].get<std::string>(), HasSubstr("no verdict without repeats"));
  EXPECT_TRUE(found["model"]["a_mu_interval"][0].is_null());
  for (const auto& threshold : json["thresholds"]) EXPECT_TRUE(threshold["interval"][0].is_null());
  EXPECT_FALSE(json["equal_loss"]["bands"].empty());
  for (const auto& band : json["equal_loss"]["bands"]) EXPECT_TRUE(band["interval"][0].is_null());
  EXPECT_THAT(outcome.verdicts, testing::Not(testing::Contains(HasSubstr("Equal loss"))));
  for (const auto& effect : json["tangential_effect"])
    EXPECT_THAT(effect["verdict"].get<std::string>(),
                testing::Not(testing::AnyOf(HasSubstr("rises"), HasSubstr("falls"))));
}

TEST_F(StudyTest, MeansGoByLogarithmsBetweenSpeeds) {
  for (const auto& [speed, chipping] : {std::pair{10.0, 0.0}, {20.0, 1e-3}, {40.0, 0.064}, {80.0, 0.032}})
    add({.speed = speed, .chipping = chipping});
  write();
  const std::array folders{campaign()};
  const Study study = read_study(folders, 0.0);
  const std::vector<Condition> list = conditions(study);
  const MeanCurve curve(study, list, runs_of(list), "chipping_ratio");
  EXPECT_NEAR(curve.at(20.0 * std::sqrt(2.0)), 8e-3, 1e-12);  // 6th power
  EXPECT_NEAR(curve.speed_of(8e-3), 20.0 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(curve.speed_of(0.064), 40.0, 1e-9);
  EXPECT_EQ(curve.at(20.0), 1e-3);
  EXPECT_EQ(curve.at(10.0), 0.0);
  EXPECT_GT(curve.at(15.0), 0.0);
  EXPECT_LT(curve.at(15.0), 1e-4);
  EXPECT_GT(curve.speed_of(1e-5), 10.0);
  EXPECT_LT(curve.speed_of(1e-5), 20.0);
  EXPECT_EQ(curve.speed_of(0.0), 10.0);
  EXPECT_TRUE(std::isinf(curve.speed_of(0.1)));
  EXPECT_TRUE(std::isnan(curve.at(9.0)));
  EXPECT_TRUE(std::isnan(curve.at(81.0)));
}

TEST_F(StudyTest, LeavesOutRunsThatCannotBeRead) {
  add({.speed = 20.0, .chipping = 0.2});
  add({.speed = 20.0, .chipping = 0.4, .seed = 2});
  add({.speed = 20.0, .chipping = 0.1, .seed = 3});
  std::ofstream(campaign() / "runs/run_1/size_distribution.csv")
      << "sieve_size [m],finer_mass_fraction [-],finer_count [-]\n";
  fs::remove(campaign() / "runs/run_3/fragments.csv");
  studied();
  EXPECT_EQ(outcome.runs, 1U);
  ASSERT_EQ(outcome.unreadable.size(), 2U);
  EXPECT_THAT(outcome.unreadable[0], HasSubstr("run_1: "));
  EXPECT_THAT(outcome.unreadable[1], HasSubstr("run_3: "));
}

TEST_F(StudyTest, TakesHashesAsText) {
  add({.speed = 20.0, .chipping = 0.2, .hash = "5812345678e90123"});
  write();
  const std::array folders{campaign()};
  EXPECT_TRUE(std::isnan(read_study(folders, 0.0).runs[0].number("state_hash")));
}

TEST_F(StudyTest, CampaignsOfOtherCasesAreSeriesOfTheirOwn) {
  add({.speed = 20.0, .chipping = 0.2});
  write();
  fs::copy(campaign(), folder / "other", fs::copy_options::recursive);
  fs::copy(campaign(), folder / "same", fs::copy_options::recursive);
  std::ofstream(folder / "other/runs/run_1/effective.toml", std::ios::app)
      << "[fracture]\nshear_strength_ratio = 2.0\n";
  const std::array different{campaign(), folder / "other"}, alike{campaign(), folder / "same"},
      twice{campaign(), campaign()};
  EXPECT_EQ(series_of(read_study(different, 0.0)).size(), 2U);
  const Study together = read_study(alike, 0.0);
  EXPECT_EQ(series_of(together).size(), 1U);
  EXPECT_EQ(conditions(together)[0].runs.size(), 2U);
  EXPECT_NE(together.runs[0].name, together.runs[1].name);
  EXPECT_THROW(read_study(twice, 0.0), InputError);
}

TEST_F(StudyTest, OldFilesDoNotStay) {
  add({.speed = 20.0, .chipping = 0.2});
  fs::create_directories(folder / "analysis");
  std::ofstream(folder / "analysis/population_balance.json") << "of another analysis";
  EXPECT_THROW(studied(), InputError);  // of whatever: there is no analysis
  EXPECT_TRUE(fs::exists(folder / "analysis/population_balance.json"));
  std::ofstream(folder / "analysis/analysis.json") << "{}";
  studied();
  EXPECT_FALSE(fs::exists(folder / "analysis/population_balance.json"));
  EXPECT_TRUE(fs::exists(folder / "analysis/analysis.json"));
}

TEST_F(StudyTest, ChecksWallsWithoutFriction) {
  for (const double angle : {90.0, 30.0})
    for (int seed = 1; seed <= 3; ++seed)
      for (const double normal : {14.0, 20.0})
        add({normal / std::sin(angle * degree), angle, 0.0, normal == 14.0 ? 0.02 : 0.3 + (angle == 30.0 ? 0.004 : 0.0),
             seed});
  const auto json = studied()["velocity"][0];
  EXPECT_FALSE(json.contains("equivalent_velocity"));
  const auto& slow = json["frictionless_identity"][0];
  const auto& fast = json["frictionless_identity"][1];
  EXPECT_NEAR(slow["normal_speed"].get<double>(), 14.0, 1e-9);
  EXPECT_EQ(slow["pairs"], 3);
  EXPECT_EQ(slow["equal_to_1e-9"], 3);
  EXPECT_EQ(fast["equal_to_1e-9"], 0);
  EXPECT_NEAR(fast["largest_difference"].get<double>(), 0.004, 1e-12);
}

TEST_F(StudyTest, OneAForWallsOfSeveralFrictions) {
  add_oblique(0.3, 0.2, 5.5);  // a = 1.5
  add_oblique(0.75, 0.5, 5.5);
  const auto json = studied();
  EXPECT_NEAR(json["one_a_for_all_frictions"][0]["chipping_ratio"]["a"].get<double>(), 1.5, 0.1);
  EXPECT_EQ(json["velocity"].size(), 2U);
}

TEST_F(StudyTest, FindsTheChippingLawAndTheClasses) {
  for (const double speed : {12.0, 14.0, 16.0, 19.0, 22.0, 26.0, 30.0})
    for (int seed = 1; seed <= 4; ++seed)
      add({.speed = speed,
           .chipping = 4e-3 * std::pow(speed / 12.0, 3.17) * (1.0 + 0.05 * std::sin(7.0 * seed)),
           .seed = seed});
  const auto json = studied()["chipping"][0];
  EXPECT_NEAR(json["chipping_law"][0]["exponent"].get<double>(), 3.17, 0.1);
  for (const auto& published : json["chipping_law"][0]["published"])
    EXPECT_EQ(published["within_interval"].get<bool>(), published["exponent"] == 3.17) << published;
  EXPECT_EQ(json["chipping_law"][1]["slowest"], 16.0);  // 0.4, 0.65 and 1 %
  EXPECT_EQ(json["class_map"].size(), 7U);
  EXPECT_EQ(json["class_map"][0]["class"], "chipped");
}

TEST_F(StudyTest, FindsTheLawOfChipsAmongRunsThatSplit) {
  int splits = 0;
  for (const double speed : {12.0, 14.0, 16.0, 19.0, 22.0})
    for (int seed = 1; seed <= 6; ++seed) {
      const bool is_split = seed < (speed - 12.0) / 2.5;
      splits += is_split ? 1 : 0;
      const double chips = 4e-3 * std::pow(speed / 12.0, 3.17) * (1.0 + 0.05 * std::sin(7.0 * seed));
      add({.speed = speed, .chipping = is_split ? 0.4 : chips, .seed = seed});
    }
  ASSERT_EQ(splits, 1 + 2 + 3);
  const auto laws = studied()["chipping"][0]["chipping_law"];
  EXPECT_GT(laws[0]["exponent"].get<double>(), 5.0);  // of all runs
  EXPECT_THAT(laws[2]["range"].get<std::string>(), HasSubstr("chipped runs alone"));
  EXPECT_NEAR(laws[2]["exponent"].get<double>(), 3.17, 0.15);
  EXPECT_EQ(laws[2]["slowest"], 16.0);
}

TEST_F(StudyTest, FitsBreakageFunctionsAndExportsAPopulationBalance) {
  for (double speed = 10.0; speed <= 28.0; speed += 1.0)
    for (int seed = 0; seed < 20; ++seed) {
      const double probability =
          tavares_probability(0.5 * speed * speed, 180.0, 0.35, std::numeric_limits<double>::infinity());
      add({.speed = speed, .chipping = (seed + 0.5) / 20.0 < probability ? 0.6 : 0.01, .seed = seed});
    }
  const auto json = studied();
  const auto& fits = json["breakage_functions"][0];
  EXPECT_NEAR(fits["tavares"]["parameters"]["E50"]["value"].get<double>(), 180.0, 4.0);
  EXPECT_NEAR(fits["tavares"]["parameters"]["sigma"]["value"].get<double>(), 0.35, 0.03);
  EXPECT_EQ(fits["tavares"]["covariance"].size(), 2U);
  // By another law half of them break at nearly the same speed.
  const auto weibull = fits["weibull_in_speed"]["parameters"];
  const double median =
      weibull["v_s"]["value"].get<double>() * std::pow(std::log(2.0), 1.0 / weibull["m"]["value"].get<double>());
  EXPECT_NEAR(0.5 * median * median, 180.0, 18.0);
  EXPECT_NEAR(fits["f_mat"]["value"].get<double>() * diameter,
              fits["vogel_peukert"]["parameters"]["f_x"]["value"].get<double>(), 1e-12);
  const auto balance = nlohmann::json::parse(read_text(folder / "analysis" / "population_balance.json"));
  const std::size_t n = balance["sizes"].size();
  ASSERT_GT(n, 4U);
  for (std::size_t j = 0; j < n; ++j) {  // what breaks goes somewhere, and nothing grows
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += balance["breakage"][i][j].get<double>();
      if (i < j) {
        EXPECT_EQ(balance["breakage"][i][j], 0.0);
      }
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
  EXPECT_LT(balance["mass_error_of_one_step"].get<double>(), 1e-12);
  for (const char* file : {"selection.csv", "breakage.csv", "breakage_probability.svg", "breakage_probability.png"})
    EXPECT_TRUE(fs::exists(folder / "analysis" / file)) << file;
}

TEST_F(StudyTest, FindsTheDamageOfRepeatedImpacts) {
  // Breakage energies at the ranks of their distribution; broken is what has lost a tenth.
  constexpr double e50 = 100.0, sigma = 0.4, gamma = 5.0;
  constexpr int most = 5;
  for (const double energy : {50.0, 70.0, 100.0, 140.0})
    for (int rank = 0; rank < 40; ++rank) {
      double low = 1.0, high = 1e4;
      for (int i = 0; i < 60; ++i) {
        const double middle = std::sqrt(low * high);
        const double below = tavares_probability(middle, e50, sigma, std::numeric_limits<double>::infinity());
        (below < (rank + 0.5) / 40.0 ? low : high) = middle;
      }
      const int n = impacts_to_break(energy, low, gamma, most);
      Row row{.speed = std::sqrt(2.0 * energy), .chipping = n == 1 ? 0.5 : 0.01, .seed = rank};
      for (int k = 2; k <= most; ++k) row.later.push_back(k >= n ? 0.5 : 0.01);
      add(row);
    }
  const auto fits = studied()["breakage_functions"][0];
  EXPECT_NEAR(fits["tavares"]["parameters"]["E50"]["value"].get<double>(), e50, 4.0);
  const auto found = fits["tavares_damage"]["parameters"]["gamma"];
  EXPECT_NEAR(found["value"].get<double>(), gamma, 3.0 * found["standard_error"].get<double>());
  EXPECT_LT(found["standard_error"].get<double>(), 0.2 * gamma);
}

TEST_F(StudyTest, SpreadsAreOfMeshesAndOfSeeds) {
  add({.speed = 20.0, .chipping = 0.10, .seed = 1, .mesh = "0.0001"});
  add({.speed = 20.0, .chipping = 0.14, .seed = 2, .mesh = "0.0001"});
  add({.speed = 20.0, .chipping = 0.20, .seed = 1, .mesh = "0.00008"});
  add({.speed = 20.0, .chipping = 0.24, .seed = 2, .mesh = "0.00008"});
  studied();
  std::ifstream file(folder / "analysis" / "summary.csv");
  bool found = false;
  for (std::string line; std::getline(file, line);) {
    const auto cells = csv_cells(line);
    if (cells[4] == "t25") {
      EXPECT_EQ(cells[7], "");  // not resolved
    }
    if (cells[4] == "sphericity") {
      EXPECT_NEAR(std::stod(cells[7]), (3.0 * 0.6 + 0.8) / 4.0, 1e-12);  // by mass, resolved
    }
    if (cells[4] != "chipping_ratio") continue;
    found = true;
    EXPECT_EQ(cells[6], "4");
    EXPECT_NEAR(std::stod(cells[7]), 0.17, 1e-12);
    EXPECT_NEAR(std::stod(cells[9]), 0.10 / std::sqrt(2.0), 1e-12);   // of 0.12 and 0.22
    EXPECT_NEAR(std::stod(cells[10]), 0.04 / std::sqrt(2.0), 1e-12);  // of 0.10 and 0.14
    const double half = 3.182 * std::sqrt(0.0116 / 3.0) / 2.0;        // Student's t for three degrees of freedom
    EXPECT_NEAR(std::stod(cells[11]), 0.17 - half, 1e-9);
    EXPECT_NEAR(std::stod(cells[12]), 0.17 + half, 1e-9);
  }
  EXPECT_TRUE(found);
}

TEST_F(StudyTest, IntervalsStayWithinWhatAShareCanBe) {
  for (const double chipping : {0.0, 0.01, 0.2}) add({.speed = 20.0, .chipping = chipping});
  for (const double chipping : {0.99, 0.7, 0.98}) add({.speed = 30.0, .chipping = chipping});
  write();
  const std::array folders{campaign()};
  const Study study = read_study(folders, 0.0);
  const std::vector<Condition> list = conditions(study);
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(spread_of(study, list[0], measure("chipping_ratio")).interval.low, 0.0);
  EXPECT_EQ(spread_of(study, list[1], measure("chipping_ratio")).interval.high, 1.0);
  add({.speed = 40.0, .chipping = 0.5});  // one run has no interval
  write();
  const Study more = read_study(folders, 0.0);
  EXPECT_TRUE(std::isnan(spread_of(more, conditions(more)[2], measure("chipping_ratio")).interval.low));
}

TEST_F(StudyTest, TheSieveDecidesTheBreakageRatio) {
  add({.speed = 20.0, .chipping = 0.2});
  write();
  const std::array folders{campaign()};
  EXPECT_NEAR(read_study(folders, 0.0).runs[0].breakage_ratio, 0.2, 1e-12);
  EXPECT_NEAR(read_study(folders, 0.1 * diameter).runs[0].breakage_ratio, 0.1, 1e-12);
  EXPECT_THROW(read_study(folders, diameter), InputError);
}

TEST_F(StudyTest, ASieveFinerThanTheMeshIsTold) {
  for (const double speed : {20.0, 30.0}) add({.speed = speed, .chipping = 0.2});
  const auto is_told = [&](double sieve) {
    studied({.title = "made up", .sieve = sieve});
    const auto about_it = [](const std::string& verdict) {
      return verdict.find("is finer than the mesh") != std::string::npos;
    };
    return std::any_of(outcome.verdicts.begin(), outcome.verdicts.end(), about_it);
  };
  EXPECT_FALSE(is_told(0.2e-3));
  EXPECT_TRUE(is_told(0.09e-3));  // edges of 0.1 mm
}

TEST_F(StudyTest, ReportIsThere) {
  add({.speed = 20.0, .chipping = 0.2});
  studied();
  const std::string page = read_text(folder / "report.html");
  EXPECT_THAT(page, HasSubstr("made up"));
  EXPECT_THAT(page, HasSubstr("run_1"));
}

TEST_F(StudyTest, RefusesWhatIsNoCampaign) {
  const auto said = [&] {
    const std::array folders{campaign()};
    try {
      read_study(folders, 0.0);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  fs::create_directories(campaign());
  EXPECT_THAT(said(), HasSubstr("holds no results.csv"));
  std::ofstream(campaign() / "results.csv") << "x,y\n1,2\n";
  EXPECT_THAT(said(), HasSubstr("is not a campaign's table"));
  std::ofstream(campaign() / "results.csv") << "run,state,reason\na,waiting,\n";
  EXPECT_THAT(said(), HasSubstr("no run is done yet"));
  std::ofstream(campaign() / "results.csv") << "run,state,reason\na,waiting\n";
  EXPECT_THAT(said(), HasSubstr("results.csv:2: 2 cells, the header has 3"));
}

}  // namespace
}  // namespace knap
