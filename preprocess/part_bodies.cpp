#include "preprocess/part_bodies.hpp"

namespace triptych {

ClosedSurfaces closed_surfaces_of(const Parts& parts, std::span<const PartLevels> levels, size_t chunks) {
  ClosedSurfaces closed;
  std::vector<std::vector<ClosedRun>> runs(parts.bodies);
  closed.bodies.resize(parts.bodies);
  for (size_t i = 0; i < parts.parts.size(); ++i) {
    if (parts.parts[i].variant_of != no_id) continue;  // it has the other's finest chunk
    const uint32_t chunk = levels[i].levels.front().chunk;
    uint32_t first = 0;
    for (const PartRun& run : parts.parts[i].runs) {
      if (run.body == no_id) {
        closed.in_chunks.resize(chunks, 0);
        closed.in_chunks[chunk] = run.triangles;
      } else {
        runs[run.body].push_back({chunk, first, run.triangles, run.body});
        closed.bodies[run.body].box.extend(run.box);
      }
      first += run.triangles;
    }
  }
  for (uint32_t body = 0; body < runs.size(); ++body) {  // chunks ascend as parts do
    closed.bodies[body].first_run = static_cast<uint32_t>(closed.runs.size());
    closed.bodies[body].run_count = static_cast<uint32_t>(runs[body].size());
    closed.runs.insert(closed.runs.end(), runs[body].begin(), runs[body].end());
  }
  return closed;
}

}  // namespace triptych
