#pragma once
#include "simulation/simulation.hpp"

namespace knap {

enum class StepStatus { Ok, EnergyNotClosed, NotFinite };

/// A closure error above this ends the run.
inline constexpr double energy_stop = 0.05;
/// A closure error above this is a warning.
inline constexpr double energy_warning = 0.01;

/// One step of the clock: forces and impulses at the positions of the whole step, then new velocities and positions.
StepStatus step(Simulation& s);

/// Of gravity on particle and guided tools, `ahead` [s] after the positions [J].
double gravity_potential(const Simulation& s, double ahead);

/// Brings the terms of the ledger up to date; the velocities must be those of the half step after nodes.x, with nodes.f
/// of nodes.x.
void update_ledger(Simulation& s);
/// Likewise, and notes how well it closes.
void balance_energies(Simulation& s);

}  // namespace knap
