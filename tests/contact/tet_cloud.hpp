#pragma once
#include <random>

#include "contact/broad_phase.hpp"
#include "contact/contact_impulses.hpp"
#include "contact/contact_pairs.hpp"
#include "contact/free_faces.hpp"

namespace knap {

/// Tets of about unit size that overlap here and there, each a fragment of its own.
inline TetMesh tet_cloud_mesh(Index count, double extent, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, extent), shape(-0.6, 0.6);
  TetMesh mesh;
  while (mesh.num_tets() < count) {
    const Vec3 centre(place(random), place(random), place(random));
    std::array<Vec3, 4> corners;
    for (Vec3& corner : corners) corner = centre + Vec3(shape(random), shape(random), shape(random));
    const double volume = tet_volume(corners[0], corners[1], corners[2], corners[3]);
    if (std::abs(volume) < 0.01) continue;
    if (volume < 0.0) std::swap(corners[0], corners[1]);
    const Index first = mesh.num_vertices();
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    mesh.tets.push_back({first, first + 1, first + 2, first + 3});
  }
  return mesh;
}

/// Fragments and their contact without a simulation around them.
struct Cloud {
  Topology topology;
  NodalState nodes;
  ContactState contact;
  RigidBodies rigid;

  void rebuild(double dt) { rebuild_candidates(contact, {topology, nodes, rigid, {}, 48.0 * dt}); }
  void refresh() { refresh_contacts(contact, {topology, nodes.x, rigid}); }
};

/// From a mesh and the fragment of each of its tets; every node has the same mass and no velocity.
inline Cloud make_cloud(const TetMesh& mesh, const std::vector<Index>& fragment_of_tet, double mass = 1.0) {
  Cloud cloud{make_topology(mesh), {}, {}, {}};
  for (const Vec3& x : mesh.vertices) cloud.nodes.x.push_back(padded(x));
  cloud.nodes.v.assign(mesh.vertices.size(), Vec4::Zero());
  cloud.nodes.f = cloud.nodes.v_before = cloud.nodes.v;
  cloud.nodes.mass.assign(mesh.vertices.size(), mass);
  cloud.contact.fragment_of_tet = fragment_of_tet;
  cloud.contact.fragments = *std::max_element(fragment_of_tet.begin(), fragment_of_tet.end()) + 1;
  cloud.contact.skin = 0.2;
  return cloud;
}

/// Random velocities and masses.
inline Cloud make_tet_cloud(Index count, double extent, unsigned seed) {
  std::vector<Index> fragments;
  for (Index t = 0; t < count; ++t) fragments.push_back(t);
  Cloud cloud = make_cloud(tet_cloud_mesh(count, extent, seed), fragments);
  std::mt19937 random(seed + 1);
  std::uniform_real_distribution<double> speed(-1.0, 1.0), mass(0.5, 2.0);
  for (Index i = 0; i < cloud.nodes.size(); ++i) {
    cloud.nodes.v[at(i)] = padded({speed(random), speed(random), speed(random)});
    cloud.nodes.mass[at(i)] = mass(random);
  }
  cloud.nodes.v_before = cloud.nodes.v;
  return cloud;
}

}  // namespace knap
