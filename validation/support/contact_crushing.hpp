#pragma once
#include "validation/evidence.hpp"
#include "validation/support/granule_study.hpp"

namespace knap {

/// Does the crushing under the contact converge? One granule on meshes with more and more elements in what they have to
/// resolve: the shorter of the shear process zone l_ch/beta^2 and of the contact radius at 15 m/s (Hertz).
struct CrushingStudy {
  GranuleCase granule;           ///< preset, diameter, extent of the fine region, time after which nothing breaks
  double resolved_length = 0.0;  ///< that length [m]
  double far_size = 0.0;         ///< largest elements far from the contact [m]
};
void show_contact_crushing(Evidence& evidence, const CrushingStudy& study);

}  // namespace knap
