#include "hi_z/hi_z_coverage.hpp"

#include <fmt/format.h>

#include <array>

namespace halfspace::tb {

HiZCoverage::HiZCoverage(const HiZShape& shape) {
  for (const char* function : {"LESS", "EQUAL", "LEQUAL", "GREATER", "GEQUAL"}) {
    for (const char* outcome : {"all", "some", "none"}) {
      bins_.add(fmt::format("block of {}, {} of its tiles rejected", function, outcome));
    }
  }
  for (const char* function : {"NEVER", "EQUAL"}) {
    bins_.add(fmt::format("block of {}, none of its tiles sure", function));
  }
  for (const char* function : {"LESS", "LEQUAL", "GREATER", "GEQUAL", "NOTEQUAL"}) {
    for (const char* outcome : {"all", "some", "none"}) {
      if (shape.accept || std::string(outcome) == "none") {
        bins_.add(fmt::format("block of {}, {} of its tiles sure", function, outcome));
      }
    }
  }
  bins_.add(fmt::format("block of ALWAYS, {} of its tiles sure", shape.accept ? "all" : "none"));
  bins_.add("block of NEVER, all of its tiles rejected");
  bins_.add("block of NOTEQUAL, none of its tiles rejected");
  bins_.add("block of ALWAYS, none of its tiles rejected");
  bins_.add("block without a test");
  for (const char* word : {"unknown", "cleared", "stored"}) {
    for (const char* outcome : {"all", "some", "none"}) {
      // Nothing but NEVER is rejected of a word that is unknown, and some of a cleared one only by the plane.
      if (std::string(word) != "unknown" || std::string(outcome) != "some") {
        bins_.add(fmt::format("block of a word {}, {} of its tiles rejected", word, outcome));
      }
    }
    bins_.add(fmt::format("job on a word {}", word));
  }
  for (const int format : {1, 2, 4}) {
    for (const char* plane : {"with a", "without a"}) {
      for (const char* outcome : {"all", "some", "none"}) {
        bins_.add(
            fmt::format("block of format {}, {} plane, {} of its tiles rejected", format, plane, outcome));
      }
    }
  }
  for (int before = 1; before <= 3; ++before) {
    bins_.add(fmt::format("block taken {} after a job of the same block", before));
  }
  for (int before = 1; before <= 4; ++before) {
    bins_.add(fmt::format("block {} after itself", before));
  }
  for (int before = 1; before <= 4; ++before) {
    bins_.add(fmt::format("job {} after one of the same block", before));
  }
  for (int before = 0; before <= 3; ++before) {
    bins_.add(fmt::format("job {} after the same block", before));
  }
  for (const char* which : {"none", "raise", "lower", "both"}) {
    bins_.add(fmt::format("jobs in flight in the same block: {}", which));
  }
  for (const char* change : {"moves", "stays", "grows", "shrinks"}) {
    const bool shifts = std::string(change) == "grows" || std::string(change) == "shrinks";
    if (!shifts || shape.bits < 24) {
      bins_.add(fmt::format("range {}", change));
    }
  }
  for (int parts = 1; parts <= shape.widths.ZParts; ++parts) {
    bins_.add(fmt::format("job of {} parts", parts));
  }
  for (const char* name : {"triangle of which nothing is left",
                           "triangle of which several blocks leave",
                           "triangle whose first block is rejected, and a later one leaves",
                           "last slot",
                           "job without bounds",
                           "waits for updates",
                           "waits for a slot",
                           "waits for updates and a slot",
                           "taken after a wait",
                           "clear with jobs to apply",
                           "clear with all jobs applied",
                           "clear of one block",
                           "clear of several blocks",
                           "clear after a block that was rejected",
                           "end of a frame with jobs not applied",
                           "end of a frame",
                           "reset with a block under way",
                           "reset without a block under way",
                           "reset with jobs not applied",
                           "reset with all jobs applied"}) {
    bins_.add(name);
  }
}

}  // namespace halfspace::tb
