#pragma once
#include <span>

#include "contact/contact_state.hpp"

namespace knap {

/// Updates contact.contacts: the candidates whose point is inside its tet now. Only those are looked at that may have
/// met by contact.travel. A contact that goes on keeps its impulse and the face it went in by.
void refresh_contacts(ContactState& contact, const Topology& topology, std::span<const Vec4> x);

}  // namespace knap
