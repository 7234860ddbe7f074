#include "contact/contact_impulses.hpp"

#include <cmath>

namespace knap {
namespace {

Vec3 relative(const Contact& c, const std::vector<Vec4>& field) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 7; ++i) sum += c.weights[i] * xyz(field[at(c.nodes[i])]);
  return sum;
}

double effective_mass(const Contact& c, const NodalState& nodes) {
  double inverse = 0.0;
  for (std::size_t i = 0; i < 7; ++i) inverse += c.weights[i] * c.weights[i] / nodes.mass[at(c.nodes[i])];
  return 1.0 / inverse;
}

void add_impulse(const Contact& c, const Vec3& impulse, NodalState& nodes) {
  for (std::size_t i = 0; i < 7; ++i) {
    if (c.weights[i] == 0.0) continue;
    xyz(nodes.v[at(c.nodes[i])]) += c.weights[i] / nodes.mass[at(c.nodes[i])] * impulse;
  }
}

// The impulse nearest to `trial` in the Coulomb cone about the normal.
Vec3 in_cone(const Vec3& trial, const Vec3& normal, double friction) {
  const double push = std::max(0.0, trial.dot(normal));
  Vec3 tangential = trial - trial.dot(normal) * normal;
  const double size = tangential.norm();
  if (size > friction * push) tangential *= friction * push / size;
  return push * normal + tangential;
}

}  // namespace

void apply_contact_impulses(ContactState& contact, NodalState& nodes, const ContactOptions& options) {
  std::vector<double> mass;
  mass.reserve(contact.contacts.size());
  for (Contact& c : contact.contacts) {
    mass.push_back(effective_mass(c, nodes));
    c.impulse = in_cone(c.impulse, c.normal, options.friction);
    add_impulse(c, c.impulse, nodes);
  }
  for (int sweep = 0; sweep < options.sweeps; ++sweep)
    for (std::size_t i = 0; i < contact.contacts.size(); ++i) {
      Contact& c = contact.contacts[i];
      const Vec3 impulse = in_cone(c.impulse - mass[i] * relative(c, nodes.v), c.normal, options.friction);
      add_impulse(c, impulse - c.impulse, nodes);
      c.impulse = impulse;
    }
}

void book_contact_losses(ContactState& contact, const NodalState& nodes) {
  for (const Contact& c : contact.contacts)
    contact.dissipated -= 0.5 * c.impulse.dot(relative(c, nodes.v) + relative(c, nodes.v_before));
}

}  // namespace knap
