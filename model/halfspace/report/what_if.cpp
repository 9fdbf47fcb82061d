#include "halfspace/report/what_if.hpp"

#include "halfspace/report/stats.hpp"

namespace halfspace {

Work work_of(const Frame& frame, const RunResult& result) {
  const FrameResult& counted = result.frame;
  Work work{.triangles = counted.counters.front_end.triangles,
            .fragments = counted.counters.quad_generator.fragments,
            .read = memory_bytes_read(counted),
            .written = memory_bytes_written(counted),
            .cycles = {}};
  for (const DrawStats& draw : counted.draws) {
    if (whatif::shades(frame.commands[draw.command])) {
      work.shaded += draw.counters.early_z.survivors;
    }
  }
  if (result.cycles) {
    work.cycles = result.cycles->cycles;
  }
  return work;
}

std::optional<double> WhatIfRow::ratio() const {
  if (without == 0) {
    return std::nullopt;
  }
  return static_cast<double>(with) / static_cast<double>(without);
}

std::vector<WhatIfRow> rows(const WhatIfReport& report) {
  const Work& without = report.without;
  const Work& with = report.with;
  std::vector<WhatIfRow> rows{
      {"triangles", "taken by the front end", without.triangles, with.triangles},
      {"fragments", "covered samples", without.fragments, with.fragments},
      {"shaded", "fragments that pass the depth test in draws that shade", without.shaded, with.shaded},
      {"depth_read", "bytes", without.read, with.read},
      {"depth_written", "bytes", without.written, with.written}};
  if (without.cycles && with.cycles) {
    rows.push_back({"cycles", "of this machine, without shading", *without.cycles, *with.cycles});
  }
  return rows;
}

}  // namespace halfspace
