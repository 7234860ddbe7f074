#pragma once
#include "contact/contact_scene.hpp"
#include "contact/contact_state.hpp"

namespace knap {

/// Brings contact.touches up to date: the candidates that overlap now, with their patches, places and normals. Only
/// those candidates are looked at whose fragments may have met by their travel.
void refresh_touches(ContactState& contact, const ContactScene& scene);

}  // namespace knap
