// Gamma-alumina of 1.09 mm: the contact radius at 15 m/s, 86 um, is what is shortest.
#include "validation/problems.hpp"
#include "validation/support/contact_crushing.hpp"

namespace knap {

void show_contact_crushing_alumina(Evidence& evidence) {
  show_contact_crushing(
      evidence,
      {.granule = {.preset = "gamma_alumina", .diameter = 1.09e-3, .contact_extent = 0.22e-3, .end_time = 10e-6},
       .resolved_length = 86e-6,
       .far_size = 84e-6});
}

}  // namespace knap
