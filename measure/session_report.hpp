// A session in figures: `triptych measure session`.
#pragma once

#include "measure/comparison.hpp"
#include "measure/session_records.hpp"

#include <nlohmann/json.hpp>

namespace triptych {

struct SessionMeasurement {
  std::vector<FrameRequest> requests;
  std::vector<RoleRecord> roles;         ///< render node, switch node 0, switch node 1
  Comparison session, fallback;          ///< of the session's frames, and of the same path in one process
  std::vector<FrameRecord> one_process;  ///< the fallback's, stages timed one at a time with all cores
};

/// Every key that docs/using.md lists for `measure session`.
nlohmann::json session_report(const Pack& pack, const SessionMeasurement& measurement);

/// A row of `batches`: what packets of this many ids cost, and how soon pictures are ready.
nlohmann::json batch_json(size_t packet_ids, const std::vector<RoleRecord>& roles);

/// The key `delta`: what sending changes saves. roles[0] is the render node, whose frames are used.
nlohmann::json delta_json(const std::vector<RoleRecord>& roles);

/// The paper's bandwidth for n node ids per frame at f frames per second, in bit/s: 8nf + nhf/b + 216f + 3hf
/// bytes with headers of h = 50 bytes and b = 100 ids per packet (interactive-display-2003 §4.5).
double formula_bits_per_second(double ids_per_frame, double frames_per_second);

}  // namespace triptych
