#pragma once
// The problems, each in the folder of its name: show_<name> in validation/<name>/<name>.cpp.
#include "validation/problem.hpp"

namespace knap {

// Elastic
void show_patch_test(Evidence& evidence);
void show_bar_waves(Evidence& evidence);
void show_rigid_spin(Evidence& evidence);
void show_free_sphere_modes(Evidence& evidence);
void show_hertz(Evidence& evidence);
void show_chung_ooi(Evidence& evidence);
void show_hiramatsu_oka(Evidence& evidence);
void show_energy_conservation(Evidence& evidence);

// Fracture
void show_intrinsic_extrinsic(Evidence& evidence);
void show_interface_opening(Evidence& evidence);
void show_work_of_separation(Evidence& evidence);
void show_mixed_mode(Evidence& evidence);
void show_spall(Evidence& evidence);
void show_expanding_bar(Evidence& evidence);
void show_crack_speed(Evidence& evidence);
void show_kalthoff_winkler(Evidence& evidence);
void show_dcb(Evidence& evidence);
void show_senb(Evidence& evidence);
void show_enf(Evidence& evidence);

// Contact
void show_incline(Evidence& evidence);
void show_sliding_block(Evidence& evidence);
void show_oblique_rebound(Evidence& evidence);
void show_two_sphere_rebound(Evidence& evidence);
void show_bouncing_block(Evidence& evidence);
void show_collision_momenta(Evidence& evidence);

// Particle
void show_scale_similarity(Evidence& evidence);
void show_frictionless_oblique(Evidence& evidence);
void show_impact_speeds(Evidence& evidence);
void show_cone_crack(Evidence& evidence);
void show_diametral_compression(Evidence& evidence);
void show_size_effect(Evidence& evidence);
void show_mesh_study(Evidence& evidence);

// Convergence
void show_contact_crushing_zeolite(Evidence& evidence);
void show_contact_crushing_alumina(Evidence& evidence);

// Sensitivity
void show_sensitivity(Evidence& evidence);

}  // namespace knap
