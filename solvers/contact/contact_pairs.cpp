#include "contact/contact_pairs.hpp"

#include <algorithm>

#include "contact/tet_overlap.hpp"
#include "contact/touches.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

// A patch wider than this share of a tet's height carries a rigid body on several points.
constexpr double wide_patch = 0.02;
constexpr Index contacts_per_block = 256;

// Both sides at the contact's place, as nodes and bodies are now.
void set_sides(Contact& contact, const ContactScene& scene) {
  for (std::size_t k = 0; k < 2; ++k) {
    ContactSide& side = contact.sides[k];
    const Index tet = contact.tets[k];
    side = {.body = scene.rigid.of_tet(tet)};
    if (side.body != none) continue;
    side.nodes = scene.topology.tet_nodes[at(tet)];
    side.weights = k == 0 ? contact.anchor : coordinates_in(side.nodes, contact.place, scene.x);
  }
}

bool is_wide(const Touch& touch) {
  return touch.carries_body != 0 && (touch.corners[1] - touch.corners[0]).norm() > wide_patch * touch.size;
}

std::size_t num_points(const Touch& touch) {
  if (touch.normal.isZero(0.0)) return 0;
  return is_wide(touch) ? touch.corners.size() : 1;
}

void make_contacts(const ContactState& contact, const ContactScene& scene, const Touch& touch,
                   std::span<Contact> points) {
  const auto& tets = contact.candidates[at(touch.candidate)].tets;
  for (std::size_t k = 0; k < points.size(); ++k) {
    Contact& point = points[k];
    point.tets = tets;
    point.point = static_cast<std::int8_t>(k);
    point.normal = touch.normal;
    point.place = points.size() > 1 ? touch.corners[k] : touch.centre;
    point.anchor =
        points.size() > 1 ? coordinates_in(scene.topology.tet_nodes[at(tets[0])], point.place, scene.x) : touch.weights;
    set_sides(point, scene);
  }
}

// Of all touches, behind those that are there.
void add_tet_contacts(const ContactState& contact, const ContactScene& scene, std::vector<Contact>& contacts) {
  std::vector<std::size_t> begins{contacts.size()};
  begins.reserve(contact.touches.size() + 1);
  for (const Touch& touch : contact.touches) begins.push_back(begins.back() + num_points(touch));
  contacts.resize(begins.back());
  parallel_for(
      to_index(contact.touches.size()),
      [&](Index i) {
        const std::size_t begin = begins[at(i)];
        make_contacts(contact, scene, contact.touches[at(i)],
                      std::span(contacts).subspan(begin, begins[at(i) + 1] - begin));
      },
      contacts_per_block);
}

// The nodes of a body that may reach the tool in this step, at twice the speed of now, since others may push it.
void add_tool_contacts(const ContactScene& scene, Index body, Index tool, double reach,
                       std::vector<Contact>& contacts) {
  for (const Index node : scene.rigid.nodes_of_body[body]) {
    const Vec3 place = xyz(scene.x[at(node)]);
    const ToolProximity near = proximity(scene.tools[at(tool)], place);
    if (near.gap > reach) continue;
    Contact added;
    added.tets = {key_of_tool(tool), node};
    added.place = place;
    added.normal = near.normal;
    added.gap = std::max(0.0, near.gap);
    added.sides[0].tool = tool;
    added.sides[1].body = body;
    contacts.push_back(added);
  }
}

// Sorted by pair; tools come before all tets.
std::vector<Contact> tool_contacts(const ContactScene& scene) {
  constexpr double steps_ahead = 2.0;
  std::vector<Contact> contacts;
  for (Index b = 0; b < scene.rigid.num_bodies(); ++b) {
    const RigidBody& body = scene.rigid.bodies[at(b)];
    const double reach = steps_ahead * scene.dt * fastest_against_tools(body, scene.tools);
    for (Index k = 0; k < to_index(scene.tools.size()); ++k)
      if (proximity(scene.tools[at(k)], body.centre).gap <= body.radius + reach)
        add_tool_contacts(scene, b, k, reach, contacts);
  }
  std::sort(contacts.begin(), contacts.end(), [](const Contact& a, const Contact& b) { return a.tets < b.tets; });
  return contacts;
}

// The vector turned like the old normal into the new one.
Vec3 turned(const Vec3& vector, const Vec3& old_normal, const Vec3& new_normal) {
  return Eigen::Quaterniond::FromTwoVectors(old_normal, new_normal) * vector;
}

// Each new point of a pair takes the impulse of the nearest old one that no other has taken.
void take_impulses(std::span<const Contact> old, std::span<Contact> now) {
  std::array<bool, 3> taken{};
  for (Contact& contact : now) {
    std::size_t nearest = old.size();
    for (std::size_t k = 0; k < old.size(); ++k) {
      if (taken[k]) continue;
      if (nearest == old.size() ||
          (old[k].place - contact.place).squaredNorm() < (old[nearest].place - contact.place).squaredNorm())
        nearest = k;
    }
    if (nearest == old.size()) return;
    taken[nearest] = true;
    if (old[nearest].impulse.squaredNorm() > 0.0)
      contact.impulse = turned(old[nearest].impulse, old[nearest].normal, contact.normal);
  }
}

std::size_t end_of_pair(std::span<const Contact> contacts, std::size_t begin) {
  std::size_t end = begin;
  while (end < contacts.size() && contacts[end].tets == contacts[begin].tets) ++end;
  return end;
}

// Both lists are sorted by pair.
void keep_impulses(std::span<const Contact> old, std::span<Contact> now) {
  for (std::size_t i = 0, k = 0; i < now.size();) {
    const std::size_t end = end_of_pair(now, i);
    while (k < old.size() && old[k].tets < now[i].tets) ++k;
    if (k < old.size() && old[k].tets == now[i].tets)
      take_impulses(old.subspan(k, end_of_pair(old, k) - k), now.subspan(i, end - i));
    i = end;
  }
}

}  // namespace

double fastest_against_tools(const RigidBody& body, std::span<const Tool> tools) {
  double tool_speed = 0.0;
  for (const Tool& tool : tools)
    tool_speed = std::max(tool_speed, tool.velocity_at(body.centre).norm() + tool.state.spin.norm() * body.radius);
  return tool_speed + body.velocity.norm() + spin(body).norm() * body.radius;
}

void refresh_contacts(ContactState& contact, const ContactScene& scene) {
  refresh_touches(contact, scene);
  std::vector<Contact> contacts = tool_contacts(scene);
  add_tet_contacts(contact, scene, contacts);
  keep_impulses(contact.contacts, contacts);
  contact.contacts = std::move(contacts);
}

void follow_contacts(ContactState& contact, const ContactScene& scene) {
  std::vector<Contact> contacts = tool_contacts(scene);
  const auto is_tools = [](const Contact& c) { return c.is_of_tool(); };
  const auto of_tets = std::find_if_not(contact.contacts.begin(), contact.contacts.end(), is_tools);
  if (of_tets != contact.contacts.begin() || !contacts.empty()) {
    keep_impulses({contact.contacts.begin(), of_tets}, contacts);
    contacts.insert(contacts.end(), of_tets, contact.contacts.end());
    contact.contacts = std::move(contacts);
  }
  parallel_for(
      to_index(contact.contacts.size()),
      [&](Index i) {
        Contact& followed = contact.contacts[at(i)];
        if (followed.is_of_tool()) return;
        followed.rebound.setZero();
        followed.place = place_in(scene.topology.tet_nodes[at(followed.tets[0])], followed.anchor, scene.x);
        set_sides(followed, scene);
      },
      contacts_per_block);
}

}  // namespace knap
