// How a role finds its peers, as often as it has to.
#pragma once

#include "protocol/connect.hpp"
#include "protocol/recording.hpp"
#include "render/context.hpp"
#include "session/role_command.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace triptych {

/// Verdict of the raster certificate, of the context that is current when it is first asked for.
const std::string& raster_verdict();

/// Connects the role with both of its peers, epoch by epoch, with what its flags say: addresses, key,
/// recording.
class SessionConnector {
 public:
  /// Error for an address beyond this machine without a key, unless the command insists, and for key files
  /// that do not serve.
  SessionConnector(const RoleCommand& command, const Pack& pack, const DeviceNames& gl);

  /// The first time, or after the epoch before is over. Nothing where `stop` or a peer says so. Error where
  /// it does not come about.
  std::unique_ptr<Mailbox> connect(const std::function<bool()>& stop) const;

  /// After a loss: tries again as long as the render node is there. Error where a peer differs.
  std::unique_ptr<Mailbox> connect_again(const std::function<bool()>& stop) const;

  /// Takes down a frame that the render node drew alone: a camera that it sent to itself.
  void record_fallback(const FrameRequest& frame) const;

 private:
  ConnectOutcome attempt(const std::function<bool()>& stop) const;
  /// What every mailbox of this role gets: the recording, faults.
  std::unique_ptr<Mailbox> equip(std::unique_ptr<Mailbox> mailbox) const;
  void compare_opengl(const Mailbox& mailbox) const;

  Hello own_;
  std::optional<Listener> listener_;
  std::map<Role, Address> dial_;
  std::optional<SharedKey> key_;
  std::chrono::milliseconds timeout_;
  std::unique_ptr<RecordingWriter> recording_;
};

}  // namespace triptych
