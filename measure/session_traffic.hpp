// What a session sent, socket by socket and receiver by receiver, beside the paper's formula.
#pragma once

#include "measure/session_records.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace triptych {

/// The bytes of one frame by the paper's formula, 8n + nh/b + 3(72 + h) with headers of h = 50 bytes and b =
/// 100 ids per packet (interactive-display-2003 §4.5), in its parts.
struct FormulaBytes {
  explicit FormulaBytes(double ids_per_frame);
  double ids_to_one_receiver = 0;  ///< 4n + nh/2b, to OR and to the render node each
  double camera = 0;               ///< 72 + h, to each of three
  double total() const { return 2 * ids_to_one_receiver + 3 * camera; }
};

/// The key `traffic` of `measure session`. roles: render node, switch node 0, switch node 1; the render
/// node's frames are used. Means of bytes per frame: ours are headers and bodies, handshakes and Byes
/// included; the kernel's are TCP's payload, retransmitted bytes included.
nlohmann::json traffic_json(const std::vector<RoleRecord>& roles);

}  // namespace triptych
