// How the three roles find each other: role r listens for the roles above it and dials those below it.
#pragma once

#include "protocol/listener.hpp"
#include "protocol/mailbox.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace triptych {

/// Two roles that cannot belong to one session: another protocol version, session or pack, or an address
/// where somebody else listens. It does not help to try again.
class PeerDiffers : public Error {
 public:
  using Error::Error;
};

/// Peers that did not come in time.
class PeersMissing : public Error {
 public:
  PeersMissing(const std::string& place, const std::string& what, std::vector<Role> who)
      : Error(place, what), roles(std::move(who)) {}
  std::vector<Role> roles;
};

/// Connects one role with both of its peers, each by two sockets, and checks that they speak the same
/// protocol version and belong to the same session and pack; whether their OpenGLs agree the caller sees in
/// Mailbox::peer_hello.
///
/// `own` says what this role is; its channel does not matter. `listener` is needed by all but the last role;
/// `dial` names every role below this one. Dialling is tried again until the timeout, also where a peer goes
/// before all have met. Callers who do not belong here are turned away and do not disturb: what speaks no
/// protocol, who differs, who is connected already, who stays silent.
///
/// Nothing where `stop`, asked several times a second, says so, or where a peer says that the session is
/// over. PeerDiffers where a role that was called differs; PeersMissing after the timeout, with what is known
/// of those who did not come; Error where a peer leaves and says why.
std::unique_ptr<Mailbox> connect_session(const Hello& own, const Listener* listener,
                                         const std::map<Role, Address>& dial,
                                         std::chrono::milliseconds timeout,
                                         const std::function<bool()>& stop = {});

}  // namespace triptych
