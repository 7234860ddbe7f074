#include "validation/problems.hpp"

#include <array>

namespace knap {

std::span<const Problem> problems() {
  static const std::array list{
      // Elastic
      Problem{"patch_test", "elastic", "the law at a homogeneous deformation: exact", show_patch_test},
      Problem{"bar_waves", "elastic", "d'Alembert's waves of speed sqrt(E/rho): exact", show_bar_waves},
      Problem{"rigid_spin", "elastic", "a rigid body, and the mean stress of its centrifugal load (virial): exact",
              show_rigid_spin},
      Problem{"free_sphere_modes", "elastic",
              "frequencies of the free sphere (Lamb 1882, Proc. London Math. Soc. 13, 189; physics.md section 3)",
              show_free_sphere_modes},
      Problem{"hertz", "elastic",
              "Hertz's law (Johnson 1985, Contact Mechanics, 11.4), and an axisymmetric solution of the same impact",
              show_hertz},
      Problem{"chung_ooi", "elastic", "two glass spheres: Chung & Ooi 2011, Granular Matter 13, 643, benchmark 1",
              show_chung_ooi},
      Problem{"hiramatsu_oka", "elastic",
              "sphere under two polar caps: series of Hiramatsu & Oka 1966, Int. J. Rock Mech. 3, 89",
              show_hiramatsu_oka},
      Problem{"energy_conservation", "elastic", "energy of leapfrog: its exact oscillation (w dt)^2/4, no drift",
              show_energy_conservation},
      // Fracture
      Problem{"intrinsic_extrinsic", "fracture",
              "the same impact with intrinsic cohesive elements (Xu & Needleman 1994)", show_intrinsic_extrinsic,
              false},
      Problem{"interface_opening", "fracture", "exact opening between two half-bars with linear softening",
              show_interface_opening},
      Problem{"work_of_separation", "fracture", "G_c in every mode, nothing on reloading: exact",
              show_work_of_separation},
      Problem{"mixed_mode", "fracture", "effective-opening law, Camacho & Ortiz 1996, Ortiz & Pandolfi 1999",
              show_mixed_mode},
      Problem{"spall", "fracture", "place of the first crack under square and triangular pulses: one-dimensional waves",
              show_spall},
      Problem{"expanding_bar", "fracture",
              "mean fragment length: fit of Zhou, Molinari & Ramesh 2006; Rayleigh's distribution", show_expanding_bar,
              false},
      Problem{"crack_speed", "fracture", "mode I crack below the Rayleigh speed, Freund 1990", show_crack_speed},
      Problem{"kalthoff_winkler", "fracture", "crack at about 70 deg to the notch, Kalthoff & Winkler 1987",
              show_kalthoff_winkler},
      Problem{"dcb", "fracture",
              "double cantilever beam: J = G_c (Paris & Paris 1988), compliance (physics.md section 3)", show_dcb,
              false},
      Problem{"senb", "fracture", "notched beam in three-point bending: K of ASTM E399", show_senb},
      Problem{"enf", "fracture", "end-notched flexure, mode II: corrected beam theory (Wang & Williams 1992)", show_enf,
              false},
      // Contact
      Problem{"incline", "contact", "Coulomb: sticks iff tan <= mu, slides at g (sin - mu cos): exact", show_incline},
      Problem{"sliding_block", "contact", "Coulomb: stops after v^2/(2 mu g): exact", show_sliding_block},
      Problem{"oblique_rebound", "contact",
              "oblique elastic rebound: Maw, Barber & Fawcett 1976, Wear 38, 101 (physics.md section 3)",
              show_oblique_rebound},
      Problem{"two_sphere_rebound", "contact",
              "the same without coupling: maw_sphere.csv over all psi1 (physics.md section 3)",
              show_two_sphere_rebound},
      Problem{"bouncing_block", "contact", "flights of 2 v/g, energy kept: exact", show_bouncing_block},
      Problem{"collision_momenta", "contact", "momenta and the two-body formula: exact", show_collision_momenta},
      // Particle
      Problem{"scale_similarity", "particle", "dimensional analysis: exact", show_scale_similarity},
      Problem{"frictionless_oblique", "particle", "Galilean invariance: exact", show_frictionless_oblique},
      Problem{"impact_speeds", "particle", "observations on granules (Antonyuk et al. 2006; physics.md section 1)",
              show_impact_speeds},
      Problem{"cone_crack", "particle", "cone crack first, then secondary cracks (Antonyuk et al. 2006)",
              show_cone_crack},
      Problem{"diametral_compression", "particle", "0.9 F/d^2 (Hiramatsu & Oka 1966), meridional splitting",
              show_diametral_compression},
      Problem{"size_effect", "particle",
              "exponent of size from 0 to 0.42 (dimensional analysis of strength and energy)", show_size_effect, false},
      Problem{"mesh_study", "particle", "finer and other meshes: critical speed and dissipation within 10 %",
              show_mesh_study, false},
      // Convergence
      Problem{"contact_crushing_zeolite", "convergence", "the same granule on the finest mesh",
              show_contact_crushing_zeolite, false},
      Problem{"contact_crushing_alumina", "convergence", "the same granule on the finest mesh",
              show_contact_crushing_alumina, false},
      // Sensitivity
      Problem{"sensitivity", "sensitivity", "the solver's options change nothing; signs of method.md section 6",
              show_sensitivity, false},
  };
  return list;
}

}  // namespace knap
