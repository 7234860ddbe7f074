// Zeolite 4AK of 1.5 mm: the shear process zone, 144 um, is what is shortest.
#include "validation/problems.hpp"
#include "validation/support/contact_crushing.hpp"

namespace knap {

void show_contact_crushing_zeolite(Evidence& evidence) {
  show_contact_crushing(
      evidence, {.granule = {.preset = "zeolite_4ak", .diameter = 1.5e-3, .contact_extent = 0.3e-3, .end_time = 25e-6},
                 .resolved_length = 144e-6,
                 .far_size = 100e-6});
}

}  // namespace knap
