#include "observers/history.hpp"

#include <gmock/gmock.h>

#include "tests/observers/breaking_box.hpp"

namespace knap {
namespace {

using HistoryTest = ObserverTest;

void advance_and_look(Simulation& s, Observer& observer, int steps) {
  for (int i = 0; i < steps; ++i) {
    observer.look(s);
    ASSERT_EQ(step(s), StepStatus::Ok);
  }
}

TEST_F(HistoryTest, RowsAreOfFreshBalancesAndAddUp) {
  Simulation s = breaking_box();
  History history(folder / "history.csv", 40, s.options.ledger_interval);
  advance_and_look(s, history, 200);
  history.add_last_row(s);
  const CsvColumns table = read_csv(folder / "history.csv");
  EXPECT_THAT(table.column("step"), testing::ElementsAre(0, 49, 97, 145, 193, 200));
  for (std::size_t row = 0; row < table.column("step").size(); ++row) {
    double sum = 0.0;
    for (std::size_t term = 0; term < num_energy_terms; ++term)
      sum += table.column(std::string(name(static_cast<EnergyTerm>(term))) + " [J]")[row];
    EXPECT_DOUBLE_EQ(sum, table.column("energy_sum [J]")[row]);
  }
}

TEST_F(HistoryTest, WallForceTimesIntervalIsTheImpulse) {
  Simulation s = breaking_box();
  History history(folder / "history.csv", 24, s.options.ledger_interval);
  advance_and_look(s, history, 150);
  const CsvColumns table = read_csv(folder / "history.csv");
  const auto& time = table.column("time [s]");
  const auto& force = table.column("wall_force_z [N]");
  double impulse = 0.0;
  for (std::size_t i = 1; i < time.size(); ++i) impulse += force[i] * (time[i] - time[i - 1]);
  EXPECT_NEAR(impulse, table.column("wall_impulse_z [N s]").back(), 1e-12 * impulse);
}

TEST_F(HistoryTest, EachToolHasItsColumns) {
  Simulation s = breaking_box();
  ToolOptions platen = wall(0.2, Vec3(0, 0, 1.0001e-3), -Vec3::UnitZ());
  platen.name = "upper";
  platen.motion = ConstantVelocity{Vec3(0.0, 0.0, -35.0)};
  s.options.tools.push_back(platen);
  s.tools = make_tools(s.options.tools, s.clock.dt);
  s.tool_edges = make_edge_watch(s.tools, s.reference.mean_edge);
  History history(folder / "history.csv", 24, s.options.ledger_interval);
  advance_and_look(s, history, 150);
  history.add_last_row(s);
  const CsvColumns table = read_csv(folder / "history.csv");
  const auto& time = table.column("time [s]");
  double impulse = 0.0, moment = 0.0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    impulse += table.column("upper_force_z [N]")[i] * (time[i] - time[i - 1]);
    moment += table.column("upper_torque_x [N m]")[i] * (time[i] - time[i - 1]);
    EXPECT_NEAR(table.column("upper_displacement_z [m]")[i], -35.0 * time[i], 1e-12);
  }
  EXPECT_LT(impulse, 0.0);
  EXPECT_NEAR(impulse, s.tools[1].state.impulse.z(), 1e-9 * std::abs(impulse));
  EXPECT_NEAR(moment, s.tools[1].state.moment.x(), 1e-9 * std::abs(moment));
  EXPECT_DOUBLE_EQ(table.column("upper_work [J]").back(), s.tools[1].state.work);
  EXPECT_EQ(std::count(table.header.begin(), table.header.end(), "wall_work [J]"), 0);
}

TEST_F(HistoryTest, ResumedFileIsTheOneOfARunWithoutABreak) {
  Simulation whole = breaking_box();
  History one(folder / "whole.csv", 24, 24);
  advance_and_look(whole, one, 220);

  Simulation s = breaking_box();
  {
    History first(folder / "parts.csv", 24, 24);
    advance_and_look(s, first, 100);
    Simulation beyond = s;  // went on before it was killed, and its last row was cut in the middle
    advance_and_look(beyond, first, 60);
    first.add_last_row(beyond);
  }
  std::filesystem::resize_file(folder / "parts.csv", std::filesystem::file_size(folder / "parts.csv") - 20);
  History second(folder / "parts.csv", 24, 24);
  second.resume(s.clock.step, s.tools.size());
  advance_and_look(s, second, 120);
  const auto a = read_csv(folder / "whole.csv");
  const auto b = read_csv(folder / "parts.csv");
  EXPECT_EQ(a.header, b.header);
  EXPECT_EQ(a.values, b.values);
}

TEST_F(HistoryTest, ResumeWithoutAFileStartsOne) {
  Simulation s = breaking_box();
  History history(folder / "history.csv", 24, 24);
  history.resume(0, s.tools.size());
  history.look(s);
  EXPECT_EQ(read_csv(folder / "history.csv").column("step").size(), 1u);
}

}  // namespace
}  // namespace knap
