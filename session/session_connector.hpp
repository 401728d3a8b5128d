// How a role connects with its peers, once for each epoch.
#pragma once

#include "protocol/connect.hpp"
#include "protocol/recording.hpp"
#include "session/role_command.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace triptych {

/// The verdict of the raster certificate; for `gl`, for the context that is current at the first call.
const std::string& raster_verdict(const DeviceNames& device);

/// Connects the role with both of its peers, epoch by epoch, as its flags say: addresses, key, recording.
class SessionConnector {
 public:
  /// Error for an address beyond this machine without a key, unless the command allows it, and for key files
  /// that cannot be used.
  SessionConnector(const RoleCommand& command, const Pack& pack, const DeviceNames& device);

  /// Connects for the first epoch. Null where `stop` or the render node ends the session. Error if the peers
  /// are not found in time.
  std::unique_ptr<Mailbox> connect(const std::function<bool()>& stop) const;

  /// Tries for as long as it takes: after a loss, or where the command keeps trying. Why peers are missing is
  /// said on standard error. Error if a peer differs.
  std::unique_ptr<Mailbox> connect_again(const std::function<bool()>& stop) const;

  /// Records what belongs to a frame that the render node drew by itself, as if sent to itself.
  void record_own(const Message& message) const;

 private:
  ConnectOutcome attempt(const std::function<bool()>& stop) const;
  /// Adds the recording and faults to a mailbox of this role.
  std::unique_ptr<Mailbox> equip(std::unique_ptr<Mailbox> mailbox) const;
  void compare_devices(const Mailbox& mailbox) const;

  Hello own_;
  std::optional<Listener> listener_;
  std::map<Role, Address> dial_;
  std::optional<SharedKey> key_;
  std::chrono::milliseconds timeout_;
  std::unique_ptr<RecordingWriter> recording_;
};

}  // namespace triptych
