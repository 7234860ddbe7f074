#pragma once
// Fragments that have come loose and stopped breaking are frozen: carried as rigid bodies in the shape they have at
// that moment. Strain and cohesive energy stay stored, and come back when the body becomes deformable again (the bulk
// law does not feel rotations); the vibration is lost and booked; momenta are kept. The branch of a viscoelastic solid
// is taken to relax fully while a fragment is frozen, so its energy is lost with the vibration. The alternative,
// letting go of the strain as well, would need the rest shape and would jump at the contacts of the fragment.
#include "simulation/simulation.hpp"

namespace knap {

/// Freezes the fragments that are quiet, see RigidFragmentOptions; at the end of a step that has looked for fragments,
/// before the drift.
void freeze_quiet_fragments(Simulation& s);

/// Makes those bodies deformable again that the contacts just found, or their loads so far, could break, and those that
/// a triangulated tool is about to touch: it acts on nodes alone, other tools meet bodies as fragments do. At the start
/// of a step, before the bulk forces. Returns whether any has woken: the contacts must then be found anew.
bool wake_loaded_bodies(Simulation& s);

/// Takes this step's contact impulses into the loads of the bodies.
void average_loads(Simulation& s);

/// Energy stored in the tets of all bodies [J].
double frozen_strain_energy(const RigidBodies& rigid);

}  // namespace knap
