// How the three roles find each other: role r listens for the roles above it and dials those below it.
#pragma once

#include "protocol/listener.hpp"
#include "protocol/mailbox.hpp"

#include <chrono>
#include <map>
#include <memory>

namespace triptych {

/// Connects one role with both of its peers, each by two sockets, and checks that they speak the same
/// protocol version and belong to the same session and pack; whether their OpenGLs agree the caller sees in
/// Mailbox::peer_hello.
///
/// `own` says what this role is; its channel does not matter. `listener` is needed by all but the last role;
/// `dial` names every role below this one. Dialling is tried again until the timeout, and strangers at the
/// listener are turned away: what speaks no protocol, who is connected already, who stays silent. Error for a
/// peer that differs (both sides get it), for one that leaves, and for one that does not come in time.
std::unique_ptr<Mailbox> connect_session(const Hello& own, const Listener* listener,
                                         const std::map<Role, Address>& dial,
                                         std::chrono::milliseconds timeout);

}  // namespace triptych
