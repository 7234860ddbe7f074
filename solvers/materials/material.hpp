#pragma once
#include <concepts>
#include <variant>

#include "materials/neo_hookean.hpp"
#include "materials/viscoelastic_branch.hpp"

namespace knap {

/// What a bulk law must offer. The vector kernels further use that P = mu F + volumetric_slope(J) cof F: the family of
/// neo-Hookean laws, which differ in their volumetric part.
template <class Law>
concept BulkLawModel = requires(const Law& law, const Mat3& F, double J) {
  { law.mu } -> std::convertible_to<double>;
  { law.volumetric_slope(J) } -> std::convertible_to<double>;
  { law.volumetric_curvature(J) } -> std::convertible_to<double>;
  { law.small_strain() } -> std::same_as<Lame>;
  { energy_density(law, F) } -> std::convertible_to<double>;
  { first_piola(law, F) } -> std::convertible_to<Mat3>;
  { cauchy_stress(law, F) } -> std::convertible_to<Mat3>;
};
static_assert(BulkLawModel<NeoHookean>);

using BulkLaw = std::variant<NeoHookean>;

/// The solid of the particle.
struct Material {
  BulkLaw law;
  double density = 0.0;  ///< [kg/m3]
  ViscoelasticBranch branch;

  /// Long-term constants of small strain [Pa].
  Lame small_strain() const {
    return std::visit([](const auto& l) { return l.small_strain(); }, law);
  }
  /// Instantaneous over long-term stiffness [-].
  double stiffness_ratio() const { return 1.0 + branch.ratio; }
};

/// Neo-Hookean material from Young's modulus [Pa], Poisson's ratio [-] and density [kg/m3].
inline Material make_material(double young_modulus, double poisson_ratio, double density,
                              ViscoelasticBranch branch = {}) {
  const Lame l = lame(young_modulus, poisson_ratio);
  return {NeoHookean{l.lambda, l.mu}, density, branch};
}

}  // namespace knap
